import numpy as np
import pytest
from PIL import Image
from shard_folders import both, pixels, write_shapes
from solids import sphere_cloud

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply
from morphoskel.reporting.figure_page import paint_parts
from morphoskel.reporting.figures.contact_sheet import (
    COLUMNS,
    MOST_ROWS,
    draw_contact_sheet,
    draw_contact_sheet_from_files,
    shapes_a_category,
)
from morphoskel.reporting.render import View
from morphoskel.shapes import PointCloud

SMALL = View(azimuth=0, elevation=0, pixels=60)


def cloud(*parts):
    """Return a ball whose points have the given parts in turn."""
    points = sphere_cloud(200).points
    return PointCloud(points, labels=np.resize(parts, 200)) if parts else PointCloud(points)


def share_of_part(picture, part):
    """Return how much of a picture has the hue of a part."""
    colour = paint_parts(np.array([part]))[0]
    bright = picture / np.maximum(picture.max(axis=2, keepdims=True), 1e-9)
    return (np.abs(bright - colour / colour.max()).max(axis=2) < 0.06).mean()


def test_the_parts_of_a_category_have_the_first_colours(tmp_path):
    draw_contact_sheet(both(tmp_path), {"Lamp": [cloud(7), cloud(8), cloud()], "Mug": [cloud(20)]}, view=SMALL)
    picture = pixels(tmp_path / "figure.png")
    panels = np.array_split(picture, 6, axis=1)  # two categories of three places each
    found = [[share_of_part(panel, part) > 0.1 for part in range(3)] for panel in panels]
    first, second, nothing = [True, False, False], [False, True, False], [False] * 3
    # The labels of a cloud without any count as 0, which makes 7 and 8 the eighth and ninth part.
    assert found == [first, second, first, first, nothing, nothing]
    assert (tmp_path / "figure.pdf").exists()


@pytest.mark.parametrize(("categories", "rows", "columns"), [(1, 1, 4), (2, 1, 8), (3, 2, 8)])
def test_whole_categories_stand_beside_each_other(tmp_path, categories, rows, columns):
    shapes = {f"kind {number}": [cloud()] * 4 for number in range(categories)}
    draw_contact_sheet(both(tmp_path), shapes, view=SMALL)
    with Image.open(tmp_path / "figure.png") as picture:
        assert picture.height / picture.width == pytest.approx(rows / columns, abs=0.05 * rows)


@pytest.mark.parametrize("categories", [1, 2, 8, 10, 11, 16, 40, 55, 100])
def test_as_many_shapes_as_a_page_holds_are_shown(categories):
    def rows(shapes):
        return -(-categories * shapes // COLUMNS)

    shapes = shapes_a_category(categories)
    assert COLUMNS % shapes == 0
    assert rows(shapes) <= max(MOST_ROWS, rows(1))
    assert shapes == COLUMNS or rows(2 * shapes) > MOST_ROWS


def test_the_first_shapes_of_every_category_are_read(tmp_path):
    files = {name: tmp_path / "data" / f"{name}.ply" for name in "abc"}
    for file in files.values():
        write_cloud_ply(file, sphere_cloud(50))
    manifest = write_shapes(tmp_path / "m.csv", {"a": ("Mug", files["a"]), "b": ("Lamp", files["b"]),
                                                 "c": ("Mug", files["c"])})  # fmt: skip
    dataset = {"kind": "folder", "root": str(tmp_path / "data")}
    draw_contact_sheet_from_files(both(tmp_path), manifest, dataset=dataset, seed=1, split="test", view=SMALL)
    picture = pixels(tmp_path / "figure.png")
    drawn = [panel.min(axis=2).mean() < 0.8 for panel in np.array_split(picture, 4, axis=1)]
    assert drawn == [True, True, True, False]


@pytest.mark.parametrize("shapes", [{}, {"Chair": []}])
def test_an_empty_sheet_is_refused(tmp_path, shapes):
    with pytest.raises(InputError, match="at least one shape"):
        draw_contact_sheet(both(tmp_path), shapes)
