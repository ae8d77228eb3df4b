import pytest

from morphoskel.datasets.dataset import check_root, choose_categories, read_lines
from morphoskel.errors import DatasetError

LEGAL = ("Airplane", "Chair", "Earphone")


def test_categories_keep_the_order_of_the_data_set():
    assert choose_categories(None, LEGAL) == LEGAL
    assert choose_categories(["Earphone", "Airplane"], LEGAL) == ("Airplane", "Earphone")


def test_an_unknown_category_gets_a_hint_and_the_legal_names():
    with pytest.raises(DatasetError, match=r"unknown name 'chiar'; did you mean 'Chair'\? Legal names: Airplane, Cha"):
        choose_categories(["Airplane", "chiar"], LEGAL)
    with pytest.raises(DatasetError, match=r"unknown name 'Xyz'\. Legal names: Airplane"):
        choose_categories(["Xyz"], LEGAL)
    with pytest.raises(DatasetError, match="the list is empty"):
        choose_categories([], LEGAL)


def test_what_is_missing_is_told_with_how_to_get_it(tmp_path):
    with pytest.raises(DatasetError, match=r"absent: the data set's folder does not exist\. Fetch it\."):
        check_root(tmp_path / "absent", "Fetch it.")
    with pytest.raises(DatasetError, match=r"list\.txt: missing from the data set\. Fetch it\."):
        check_root(tmp_path, "Fetch it.", "list.txt")
    (tmp_path / "list.txt").touch()
    check_root(tmp_path, "Fetch it.", "list.txt")


def test_lines(tmp_path):
    path = tmp_path / "list.txt"
    path.write_bytes("\ufeffa\r\n\r\n b \r\nc".encode())
    assert read_lines(path) == ["a", "b", "c"]
    with pytest.raises(DatasetError, match="cannot be read as a list"):
        read_lines(tmp_path / "absent")
    path.write_bytes(b"\xff\0")
    with pytest.raises(DatasetError, match="cannot be read as a list"):
        read_lines(path)
