import numpy as np
import pytest
from PIL import Image
from shard_folders import both, pixels, write_shapes, write_shard
from solids import ball

from morphoskel.errors import InputError
from morphoskel.reporting.figures.skeleton_sheet import draw_skeleton_sheet, draw_skeleton_sheet_from_files
from morphoskel.reporting.render import View
from morphoskel.shapes import Skeleton

BALL = Skeleton([[0.0, 0, 0]], [0.5], [0.0])
SMALL = View(pixels=40)


def test_one_skeleton_a_category_in_its_surface(tmp_path):
    shapes = {"a": ("Chair", tmp_path), "b": ("Chair", tmp_path), "c": ("Lamp", tmp_path), "d": ("Mug", tmp_path)}
    manifest = write_shapes(tmp_path / "m.csv", shapes)
    surfaces = [write_shard(tmp_path / "surfaces", {"a": ball(subdivisions=2), "c": "reconstruct", "d": "watertight"})]
    skeletons = [write_shard(tmp_path / "skeletons", {"a": BALL, "c": BALL, "d": "watertight"})]
    draw_skeleton_sheet_from_files(both(tmp_path), manifest, surfaces, skeletons, split="test", view=SMALL)
    picture = pixels(tmp_path / "figure.png")
    panels = np.array_split(picture[:, : picture.shape[1] * 9 // 10], 3, axis=1)
    yellow = [((panel[..., 0] > 0.5) & (panel[..., 2] < 0.5)).mean() for panel in panels]
    # Without a surface that shows how large the shape is, the ball fills its panel.
    assert yellow[1] > 2 * yellow[0] > 0
    assert yellow[2] == 0
    assert (panels[2] < 0.5).any()


@pytest.mark.parametrize(("count", "rows"), [(1, 1), (6, 1), (7, 2), (13, 3)])
def test_rows_are_filled_evenly(tmp_path, count, rows):
    shapes = {f"shape {number}": ("not computed", BALL) for number in range(count)}
    draw_skeleton_sheet(both(tmp_path), shapes, view=SMALL)
    with Image.open(tmp_path / "figure.png") as picture:
        columns = -(-count // rows)
        assert picture.height / picture.width == pytest.approx(rows / columns, abs=0.16 * rows)


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_skeleton_sheet(both(tmp_path), {})
