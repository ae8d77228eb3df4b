import dataclasses

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from morphoskel.chain.status import Status, read_status, write_status
from morphoskel.checksums import LIST, intact, write_checksums
from morphoskel.errors import InputError, StorageError

TEXT = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)
THOUSANDTHS = st.integers(0, 10**9).map(lambda number: number / 1000)


def test_rows_come_back_sorted_with_awkward_reasons(tmp_path):
    rows = [
        Status("b", "Mug", "failed", "udf", 'a "quoted", reason\nin two lines', 2, 1.25, 7.5, "", "logs/udf.log"),
        Status("a", "Chair", "ok", "udf", "", 1, 0.5, 0.5, "inside=3;largest=0.1"),
    ]
    write_status(tmp_path, rows)
    assert read_status(tmp_path) == rows[::-1]


def test_a_failure_is_told_with_stage_reason_and_log():
    row = Status("a", "Mug", "failed", "udf", "no surface", 2, 1.0, 2.0, "")
    assert row.failure == "udf: no surface"
    assert dataclasses.replace(row, log="logs/udf.log").failure == "udf: no surface (log: logs/udf.log)"


def test_the_status_vouches_for_the_files_beside_it(tmp_path):
    (tmp_path / "a.ply").write_text("ply")
    write_status(tmp_path, [])
    intact(tmp_path / "a.ply")
    (tmp_path / "a.ply").write_text("plz")
    with pytest.raises(StorageError, match="is damaged"):
        intact(tmp_path / "a.ply")


def test_a_damaged_status_is_refused(tmp_path):
    write_status(tmp_path, [Status("a", "Mug", "ok", "udf", "", 1, 1.0, 2.0, "")])
    path = tmp_path / "status.csv"
    path.write_text(path.read_text().replace("Mug", "Cup"))
    with pytest.raises(StorageError, match=r"status\.csv: is damaged"):
        read_status(tmp_path)
    (tmp_path / LIST).unlink()
    with pytest.raises(StorageError, match=f"has no {LIST}"):
        read_status(tmp_path)


@settings(max_examples=60, deadline=None)
@given(st.builds(Status, st.just("a"), TEXT, st.sampled_from(["ok", "failed"]), TEXT, TEXT, st.integers(1, 2),
                 THOUSANDTHS, THOUSANDTHS, TEXT, TEXT))  # fmt: skip
@example(Status("a", "", "ok", "\r", "a\r\nb", 1, 0.0, 0.0, '"', "\r"))
def test_any_text_comes_back(tmp_path_factory, row):
    folder = tmp_path_factory.mktemp("round_trip")
    write_status(folder, [row])
    assert read_status(folder) == [row]


@pytest.mark.parametrize(("old", "new"), [("attempts", "tries"), (",1,", ",one,"), ("ok", "fine"), ("a,Chair", "a")])
def test_damage_names_the_file(old, new, tmp_path):
    write_status(tmp_path, [Status("a", "Chair", "ok", "udf", "", 1, 0.5, 0.5, "")])
    path = tmp_path / "status.csv"
    path.write_text(path.read_text().replace(old, new))
    write_checksums(tmp_path)
    with pytest.raises(InputError, match=r"status\.csv: expected the status of shapes"):
        read_status(tmp_path)


def test_an_absent_file_is_named(tmp_path):
    write_status(tmp_path, [])
    (tmp_path / "status.csv").unlink()
    with pytest.raises(StorageError, match=r"status\.csv"):
        read_status(tmp_path)
