import pytest

from morphoskel.run_progress.earlier_durations import (
    REFERENCE,
    earlier_durations,
    record_reference,
    reference_durations,
)

HEADER = "s\th:m:s\tmax_rss\n"


def put(path, seconds):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{HEADER}{seconds}\t0:00:01\t-\n")


def test_a_rule_takes_the_mean_of_its_files(tmp_path):
    put(tmp_path / "demo/benchmarks/udf/synthetic/test/00000.tsv", 2.0)
    put(tmp_path / "demo/benchmarks/udf/synthetic/train/00000.tsv", 4.0)
    put(tmp_path / "demo/benchmarks/train_point2skeleton.tsv", 70.5)
    assert earlier_durations(tmp_path, "demo") == {"udf": 3.0, "train_point2skeleton": 70.5}


def test_other_runs_count_only_where_the_run_has_nothing(tmp_path):
    put(tmp_path / "demo/benchmarks/udf/a.tsv", 2.0)
    put(tmp_path / "paper/benchmarks/udf/a.tsv", 200.0)
    put(tmp_path / "paper/benchmarks/dilation/a.tsv", 30.0)
    put(tmp_path / "k30/benchmarks/dilation/a.tsv", 10.0)
    assert earlier_durations(tmp_path, "demo") == {"udf": 2.0, "dilation": 20.0}
    assert earlier_durations(tmp_path, "new")["udf"] == pytest.approx(101.0)


@pytest.mark.parametrize("text", ["", HEADER, "s\nmuch\n", "h:m:s\n0:00:01\n", "max_rss\ts\n12\n"])
def test_damaged_files_are_passed_over(tmp_path, text):
    put(tmp_path / "demo/benchmarks/udf/a.tsv", 2.0)
    (tmp_path / "demo/benchmarks/udf/b.tsv").write_text(text)
    (tmp_path / "demo/benchmarks/dilation.tsv").write_text(text)
    assert earlier_durations(tmp_path, "demo") == {"udf": 2.0}


def test_no_earlier_run(tmp_path):
    assert earlier_durations(tmp_path / "results", "demo") == {}


def test_a_run_can_be_recorded_for_the_first_runs_of_others(tmp_path):
    put(tmp_path / "demo/benchmarks/udf/a.tsv", 2.0)
    put(tmp_path / "demo/benchmarks/train_point2skeleton.tsv", 70.5)
    (tmp_path / "reference").mkdir()
    record_reference(tmp_path, "demo")
    assert reference_durations(tmp_path) == {"udf": 2.0, "train_point2skeleton": 70.5}
    assert earlier_durations(tmp_path, "new") == {"udf": 2.0, "train_point2skeleton": 70.5}  # of the demo itself


@pytest.mark.parametrize("text", [None, "", "rule,seconds\nudf\n", "rule,seconds\nudf,much\n"])
def test_without_a_record_nothing_is_known(tmp_path, text):
    if text is not None:
        (tmp_path / "reference").mkdir()
        (tmp_path / REFERENCE).write_text(text)
    assert reference_durations(tmp_path) == {}
