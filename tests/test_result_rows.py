import math

import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.result_rows import read_result_rows

COLUMNS = ("strategy", "ratio", "seed", "category", "iou")


def write(path, *lines, header="strategy,ratio,seed,category,iou,other"):
    path.write_text("\n".join([header, *lines]) + "\n")
    return path


def test_files_are_read_one_below_the_other_with_names_as_they_stand(tmp_path):
    first = write(tmp_path / "a.csv", "fps,16,0,nan,0.5,x")
    second = write(tmp_path / "b.csv", "0.5,None,1,x,", header="iou,category,seed,strategy,ratio")
    frame = read_result_rows([first, second], COLUMNS)
    assert tuple(frame.columns) == COLUMNS
    assert frame.to_numpy().tolist() == [["fps", "16", 0, "nan", 0.5], ["x", "", 1, "None", 0.5]]


def test_an_empty_number_is_none(tmp_path):
    frame = read_result_rows([write(tmp_path / "a.csv", "fps,16,0,Mug,,", "fps,16,0,Mug,nan,")], COLUMNS)
    assert [math.isnan(value) for value in frame["iou"]] == [True, True]


def test_without_files_there_are_columns_without_rows():
    frame = read_result_rows([], COLUMNS)
    assert tuple(frame.columns) == COLUMNS
    assert len(frame) == 0
    assert frame.dtypes["iou"].kind == "f"


def test_bad_files_are_named(tmp_path):
    with pytest.raises(InputError, match=r"absent\.csv: no such file; expected a table with the columns strategy"):
        read_result_rows([tmp_path / "absent.csv"], COLUMNS)
    path = write(tmp_path / "a.csv", "fps,16,0,Mug,high,")
    with pytest.raises(InputError, match=r"a\.csv: a value is not a number"):
        read_result_rows([path], COLUMNS)
    with pytest.raises(InputError, match=r"a\.csv: the columns draw are missing"):
        read_result_rows([path], ("ratio", "draw"))
