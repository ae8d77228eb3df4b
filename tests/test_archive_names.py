from pathlib import Path

import pytest

from morphoskel.datasets.archive_names import MemberNames
from morphoskel.errors import DatasetError


@pytest.fixture
def names():
    return MemberNames(Path("archive"), 100)


def test_ordinary_names(names):
    listed = ["./", "data/", "./data/a b.txt", "data/Stühle/ü.txt", "data/$(touch x).txt", "data/-x", "data/"]
    accepted = [str(names.accept(name, is_folder=name.endswith("/"))) for name in listed]
    assert accepted == [".", "data", "data/a b.txt", "data/Stühle/ü.txt", "data/$(touch x).txt", "data/-x", "data"]


@pytest.mark.parametrize("name", ["a\nb", "a\x00b", "a\udcff", "a" * 1025, ".", ""])
def test_impossible_names(names, name):
    with pytest.raises(DatasetError, match="impossible name"):
        names.accept(name, is_folder=False)
