import pytest
from illustrated import illustrated
from PIL import Image

from morphoskel.errors import InputError
from morphoskel.reporting.figures.rationale import draw_rationale, draw_rationale_from_files
from morphoskel.reporting.illustration_file import write_illustration


def pair(name):
    return illustrated(name), illustrated(name, "grid")


def test_every_solid_is_a_row(tmp_path):
    heights = []
    for names in (["torus"], ["torus", "box"]):
        paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
        draw_rationale(paths, {name: pair(name) for name in names}, pixels=80)
        assert paths[1].read_bytes().startswith(b"%PDF")
        with Image.open(paths[0]) as picture:
            heights.append(picture.height)
    assert heights[1] > 1.4 * heights[0]


def test_candidates_placed_otherwise_are_refused(tmp_path):
    with pytest.raises(InputError, match="box: expected an illustration of random and one of grid candidates"):
        draw_rationale([tmp_path / "figure.png"], {"box": pair("box")[::-1]})


def test_no_solid_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one"):
        draw_rationale([tmp_path / "figure.png"], {})


def test_files_are_drawn_like_the_illustrations_in_them(tmp_path):
    for illustration in pair("box"):
        write_illustration(tmp_path / f"{illustration.mode}.npz", illustration)
    draw_rationale_from_files(
        [tmp_path / "a.png"], {"box": (tmp_path / "random.npz", tmp_path / "grid.npz")}, pixels=60
    )
    draw_rationale([tmp_path / "b.png"], {"box": pair("box")}, pixels=60)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
