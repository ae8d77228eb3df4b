import pytest

from morphoskel.chain.medial_axis import find_medial_axis
from morphoskel.errors import InputError


@pytest.mark.parametrize("name", ["a/b/chair_mat.ply", "chair.ma"])
def test_a_file_is_found_anywhere_below(tmp_path, name):
    path = tmp_path / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()
    (tmp_path / "armchair.ma").touch()
    assert find_medial_axis(tmp_path, "chair") == path


def test_none_or_two_are_an_error(tmp_path):
    with pytest.raises(InputError, match=r"one file chair_mat\.ply or chair\.ma in it or below, found no file"):
        find_medial_axis(tmp_path, "chair")
    for name in ("chair_mat.ply", "chair.ma"):
        (tmp_path / name).touch()
    with pytest.raises(InputError, match="found 2 files"):
        find_medial_axis(tmp_path, "chair")
