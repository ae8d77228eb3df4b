import pytest
from measured_run import BYTES, SECONDS, SHAPES, write_measured_run

from morphoskel.errors import InputError
from morphoskel.planning.measurements import measure_run, read_measurements, write_measurements


@pytest.fixture
def run(tmp_path):
    return write_measured_run(tmp_path / "small")


def test_jobs_of_a_rule_are_added(run):
    measured = {each.rule: each for each in measure_run(run)}
    assert set(measured) == set(SECONDS)
    for rule, each in measured.items():
        assert (each.jobs, each.shapes, each.files, each.source) == (
            2,
            SHAPES,
            SHAPES + 4,
            "small",
        )  # status and checksums in each folder
        assert each.held == pytest.approx(2 * 2 * SECONDS[rule])  # two jobs that held two cores
        assert each.worked == pytest.approx(SECONDS[rule])
        assert each.size > SHAPES * BYTES
    assert measured["reconstruct"].kind == "poisson"
    assert measured["reconstruct"].amount == SHAPES
    assert measured["udf"].amount == SHAPES * 1000


def test_the_file_of_measurements_gives_them_back(run, tmp_path):
    measured = measure_run(run)
    write_measurements(tmp_path / "times.csv", measured)
    assert read_measurements(tmp_path / "times.csv") == measured


def test_another_folder_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"no config\.yaml and benchmarks"):
        measure_run(tmp_path)


def test_another_file_is_refused(tmp_path):
    (tmp_path / "times.csv").write_text("a,b\n1,2\n")
    with pytest.raises(InputError, match=r"times\.csv: expected measurements"):
        read_measurements(tmp_path / "times.csv")


def test_what_was_removed_has_no_size(run):
    for path in (path for path in (run / "udf").rglob("*") if path.is_file()):
        path.unlink()
    udf = next(each for each in measure_run(run) if each.rule == "udf")
    assert (udf.files, udf.shapes, udf.written_amount) == (0, 0, 0)
    assert udf.held > 0
