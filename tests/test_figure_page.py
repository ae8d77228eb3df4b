import numpy as np
import pytest
from PIL import Image

from morphoskel.reporting.figure_page import PART_COLOURS, add_scale, cropped, figure_page, paint, paint_parts, show


def draw(folder, fail=False):
    paths = [folder / "figure.png", folder / "figure.pdf"]
    with figure_page(paths, 2.0, 1.0) as figure:
        axes = figure.subplots()
        show(axes, np.full((5, 10, 3), 0.5), "grey")
        add_scale(figure, axes, 0, 1, "viridis", "share")
        if fail:
            raise RuntimeError
    return paths


def test_a_figure_is_written_as_png_of_its_size_and_as_pdf(tmp_path):
    png, pdf = draw(tmp_path)
    with Image.open(png) as picture:
        assert picture.size == (600, 300)
    assert pdf.read_bytes().startswith(b"%PDF")


def test_equal_figures_are_equal_files(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    first, second = draw(tmp_path / "a"), draw(tmp_path / "b")
    assert [path.read_bytes() for path in first] == [path.read_bytes() for path in second]


def test_nothing_is_written_where_drawing_fails(tmp_path):
    with pytest.raises(RuntimeError):
        draw(tmp_path, fail=True)
    assert list(tmp_path.iterdir()) == []


def test_pictures_are_cropped_alike_to_what_is_drawn_in_any_of_them():
    pictures = [np.ones((20, 30, 3)) for _ in "ab"]
    pictures[0][5, 10] = 0
    pictures[1][12, 20] = 0
    first, second = cropped(pictures, margin=2)
    assert first.shape == second.shape == (12, 15, 3)
    assert (first[2, 2] == 0).all()
    assert (second[9, 12] == 0).all()
    assert cropped([np.ones((4, 4, 3))])[0].shape == (4, 4, 3)


def test_colours_run_from_end_to_end_of_the_map():
    import matplotlib

    colours = paint(np.array([-1.0, 0.0, 1.0, 3.0, 9.0]), 0, 3, "viridis")
    ends = [matplotlib.colormaps["viridis"](share)[:3] for share in (0.0, 1.0)]
    assert np.array_equal(colours[[0, 1, 3, 4]], np.repeat(ends, 2, axis=0))
    assert not np.array_equal(colours[2], colours[1])
    assert paint(np.zeros(2), 0, 0, "viridis").shape == (2, 3)


def test_every_part_has_its_colour_and_the_colours_begin_anew():
    colours = paint_parts(np.arange(len(PART_COLOURS) + 1))
    assert len(np.unique(colours, axis=0)) == len(PART_COLOURS)
    assert np.array_equal(colours[0], colours[-1])
    assert colours[1] == pytest.approx([0xEE / 255, 0x66 / 255, 0x77 / 255])
