import pandas as pd
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from morphoskel.csv_frame import read_csv_frame, write_csv_frame
from morphoskel.errors import InputError


def read(tmp_path, text, **options):
    path = tmp_path / "rows.csv"
    path.write_bytes(text.encode("latin-1"))
    return read_csv_frame(path, ("id", "value"), **options)


def test_columns_are_read_by_name(tmp_path):
    frame = read(tmp_path, "value,id,more\n1.5,a,x\n", dtype={"id": str})
    assert frame["value"].tolist() == [1.5]
    assert frame["id"].tolist() == ["a"]


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        ("", {}, "cannot be read as a table"),
        ('id,value\n"a,1\n', {}, "cannot be read as a table"),
        ("id,value\na,1\nb,2,3\n", {}, "cannot be read as a table"),
        ("id,value\na,1,2\nb,2,3\n", {}, "cannot be read as a table"),
        ("id,value\n\xe9,1\n", {}, "cannot be read as a table"),
        ("id,value\na,one\n", {"dtype": {"value": float}}, "a value is not a number"),
        ("id,number\na,1\n", {}, "the columns value are missing"),
        ("value,id\n1,a\n", {"exactly": True}, "expected the columns id, value, got value, id"),
    ],
)
def test_anything_else_names_the_file(text, options, message, tmp_path):
    with pytest.raises(InputError, match=rf"rows\.csv: {message}"):
        read(tmp_path, text, **options)


def test_an_absent_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"rows\.csv: no such file; expected a table with the columns id, value"):
        read_csv_frame(tmp_path / "rows.csv", ("id", "value"))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=8), min_size=1))
@example(["\r", "a\r\nb", '"', ",", "\n"])
def test_any_text_comes_back(tmp_path_factory, texts):
    path = tmp_path_factory.mktemp("csv") / "a.csv"
    write_csv_frame(pd.DataFrame({"text": texts, "number": range(len(texts))}), path)
    frame = read_csv_frame(path, ["text", "number"], dtype={"text": str, "number": int}, keep_default_na=False)
    assert frame["text"].tolist() == texts


def test_lines_end_in_line_feeds(tmp_path):
    write_csv_frame(pd.DataFrame({"a": [1, 2], "b": ["x", "y\r\n"]}), tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_bytes() == b'a,b\n1,x\n2,"y\r\n"\n'
