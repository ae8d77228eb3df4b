import pytest

from morphoskel.csv_frame import read_csv_frame
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
