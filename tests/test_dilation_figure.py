import numpy as np
from illustrated import illustrated
from PIL import Image

from morphoskel.reporting.figures.dilation import draw_dilation, draw_dilation_from_files
from morphoskel.reporting.illustration_file import write_illustration


def test_the_dilation_is_brighter_than_the_distance(tmp_path):
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_dilation(paths, illustrated("torus"), pixels=150)
    assert paths[1].read_bytes().startswith(b"%PDF")
    with Image.open(paths[0]) as picture:
        pixels = np.asarray(picture.convert("RGB"), dtype=float) / 255
    panels = pixels[60:, : int(0.88 * pixels.shape[1])]  # without titles and scale
    half = panels.shape[1] // 2
    greens = [side[np.ptp(side, axis=2) > 0.1][:, 1].mean() for side in (panels[:, :half], panels[:, half:])]
    assert greens[1] > greens[0] + 0.02


def test_a_file_is_drawn_like_the_illustration_in_it(tmp_path):
    write_illustration(tmp_path / "torus.npz", illustrated("torus"))
    draw_dilation_from_files([tmp_path / "a.png"], tmp_path / "torus.npz", pixels=60)
    draw_dilation([tmp_path / "b.png"], illustrated("torus"), pixels=60)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
