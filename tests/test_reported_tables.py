import base64

import pytest
from small_run import result_frame

from morphoskel.errors import InputError
from morphoskel.reporting.matrix import Line
from morphoskel.reporting.page.reported_tables import ShownCell, read_reported_table, shown_cells
from morphoskel.reporting.table import write_table


@pytest.fixture
def path(tmp_path):
    write_table(result_frame(), tmp_path / "skeleton_prior", "Caption, 5 *.", ["A note."])
    return tmp_path / "skeleton_prior.csv"


def test_a_table_is_read_with_what_its_reader_must_know(path):
    table = read_reported_table(path)
    assert (table.name, table.title) == ("skeleton_prior", "Skeleton prior")
    assert (table.caption, table.footnotes) == ("Caption, 5 *.", ("A note.",))
    assert [matrix.metric.name for matrix in table.matrices] == ["cd_recon", "cd_mat", "oa"]
    assert base64.b64decode(table.address.partition(",")[2]) == path.read_bytes()


def test_cells_are_counted_without_those_that_stand_behind_others(path):
    assert read_reported_table(path).counts == {"computed": 6, "failed": 1, "not run": 2}


def test_cells_say_what_they_are():
    line = Line("ours", ("0.5 ± 0.1", None, "not run", "failed", "-0.2 (-0.3 to 0.1)"), (True, *[False] * 4))
    assert shown_cells(line) == [
        ShownCell("0.5 ± 0.1", "best"), ShownCell("–", "absent"), ShownCell("not run", "not-run"),
        ShownCell("failed", "failed"), ShownCell("−0.2 (−0.3 to 0.1)", ""),
    ]  # fmt: skip


def test_both_files_are_needed(path):
    path.with_suffix(".md").unlink()
    with pytest.raises(InputError, match=r"skeleton_prior\.md: no such file"):
        read_reported_table(path)
    path.unlink()
    with pytest.raises(InputError, match=r"skeleton_prior\.csv: no such file"):
        read_reported_table(path)
