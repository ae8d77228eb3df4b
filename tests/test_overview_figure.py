import numpy as np
from illustrated import illustrated
from PIL import Image

from morphoskel.reporting.figures.overview import draw_overview, draw_overview_from_files
from morphoskel.reporting.illustration_file import write_illustration


def test_two_rows_of_four_stages_fill_the_page(tmp_path):
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_overview(paths, illustrated("torus"), pixels=80)
    assert paths[1].read_bytes().startswith(b"%PDF")
    with Image.open(paths[0]) as picture:
        drawn = np.asarray(picture.convert("L")) < 245
    height, width = drawn.shape
    assert width == 2070
    for row in range(2):
        for column in range(4):
            top, left = int(height * 0.42 * row), width * column // 4
            assert drawn[top : top + int(0.4 * height), left : left + width // 4].mean() > 0.05
    edge = np.concatenate([drawn[:3].ravel(), drawn[-3:].ravel(), drawn[:, :1].ravel(), drawn[:, -1:].ravel()])
    assert not edge.any()  # nothing is cut off


def test_a_file_is_drawn_like_the_illustration_in_it(tmp_path):
    write_illustration(tmp_path / "torus.npz", illustrated("torus"))
    draw_overview_from_files([tmp_path / "a.png"], tmp_path / "torus.npz", pixels=60)
    draw_overview([tmp_path / "b.png"], illustrated("torus"), pixels=60)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
