import numpy as np
from illustrated import illustrated
from PIL import Image

from morphoskel.reporting.figures.occupancy import draw_candidates, draw_occupancy, draw_occupancy_from_files
from morphoskel.reporting.figures.section_view import section_view
from morphoskel.reporting.illustration_file import write_illustration


def test_candidates_inside_stand_out_from_the_others_in_the_box():
    torus = illustrated("torus")
    picture = draw_candidates(section_view(torus, 120), torus)
    blue = picture[..., 2] - picture[..., 0] > 0.2
    grey = (np.ptp(picture, axis=2) < 0.1) & (picture.mean(axis=2) < 0.95)
    assert blue.mean() > 0.01
    assert grey.mean() > 0.01
    rows, columns = np.nonzero(blue)
    height, width = np.nonzero(grey)
    assert np.ptp(columns) <= np.ptp(width)  # the box is around the shape
    assert np.ptp(rows) <= np.ptp(height)


def test_few_candidates_and_many_inner_points_are_drawn_side_by_side(tmp_path):
    few, many = illustrated("torus", count=500), illustrated("torus")
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_occupancy(paths, few, many, pixels=120)
    assert paths[1].read_bytes().startswith(b"%PDF")
    with Image.open(paths[0]) as picture:
        pixels = np.asarray(picture.convert("RGB"), dtype=float) / 255
    half = pixels.shape[1] // 2
    left, right = ((side[..., 2] - side[..., 0] > 0.2).mean() for side in (pixels[:, :half], pixels[:, half:]))
    assert right > 2 * left > 0


def test_files_are_drawn_like_the_illustrations_in_them(tmp_path):
    few, many = illustrated("torus", count=500), illustrated("torus")
    for name, illustration in (("few", few), ("many", many)):
        write_illustration(tmp_path / f"{name}.npz", illustration)
    draw_occupancy_from_files([tmp_path / "a.png"], tmp_path / "few.npz", tmp_path / "many.npz", pixels=60)
    draw_occupancy([tmp_path / "b.png"], few, many, pixels=60)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
