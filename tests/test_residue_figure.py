import numpy as np
from illustrated import illustrated
from PIL import Image

from morphoskel.reporting.figures.residue import draw_residue, draw_residue_from_files
from morphoskel.reporting.illustration_file import write_illustration


def test_residue_and_skeleton_are_drawn_side_by_side(tmp_path):
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_residue(paths, illustrated("torus"), pixels=150)
    assert paths[1].read_bytes().startswith(b"%PDF")
    with Image.open(paths[0]) as picture:
        pixels = np.asarray(picture.convert("RGB"), dtype=float) / 255
    coloured = np.ptp(pixels, axis=2) > 0.1
    third = pixels.shape[1] // 3
    assert coloured[:, :third].mean() > 2 * coloured[:, -2 * third : -third // 2].mean() > 0  # solid, and single points


def test_a_file_is_drawn_like_the_illustration_in_it(tmp_path):
    write_illustration(tmp_path / "torus.npz", illustrated("torus"))
    draw_residue_from_files([tmp_path / "a.png"], tmp_path / "torus.npz", pixels=60)
    draw_residue([tmp_path / "b.png"], illustrated("torus"), pixels=60)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
