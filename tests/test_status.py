import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.chain.status import Status, read_status, write_status
from morphoskel.errors import InputError

TEXT = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)
THOUSANDTHS = st.integers(0, 10**9).map(lambda number: number / 1000)


def test_rows_come_back_sorted_with_awkward_reasons(tmp_path):
    rows = [
        Status("b", "Mug", "failed", "udf", 'a "quoted", reason\nin two lines', 2, 1.25, 7.5, ""),
        Status("a", "Chair", "ok", "udf", "", 1, 0.5, 0.5, "inside=3;largest=0.1"),
    ]
    write_status(tmp_path, rows)
    assert read_status(tmp_path) == rows[::-1]


@settings(max_examples=60, deadline=None)
@given(st.builds(Status, st.just("a"), TEXT, st.sampled_from(["ok", "failed"]), TEXT, TEXT, st.integers(1, 2),
                 THOUSANDTHS, THOUSANDTHS, TEXT))  # fmt: skip
def test_any_text_comes_back(tmp_path_factory, row):
    folder = tmp_path_factory.mktemp("round_trip")
    write_status(folder, [row])
    assert read_status(folder) == [row]


@pytest.mark.parametrize(("old", "new"), [("attempts", "tries"), (",1,", ",one,"), ("ok", "fine"), ("a,Chair", "a")])
def test_damage_names_the_file(old, new, tmp_path):
    write_status(tmp_path, [Status("a", "Chair", "ok", "udf", "", 1, 0.5, 0.5, "")])
    path = tmp_path / "status.csv"
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(InputError, match=r"status\.csv: expected the status of shapes"):
        read_status(tmp_path)


def test_an_absent_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"status\.csv"):
        read_status(tmp_path)
