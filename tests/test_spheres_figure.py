import numpy as np
import pytest
from shard_folders import both, pixels, write_shapes, write_shard
from solids import sphere_cloud

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply
from morphoskel.reporting.figures.spheres import draw_spheres, draw_spheres_from_files
from morphoskel.reporting.render import View
from morphoskel.shapes import Skeleton

BALL = Skeleton([[0.0, 0, 0]], [0.9], [0.0])
SMALL = View(pixels=200)


def test_one_panel_a_category_and_words_for_the_one_that_failed(tmp_path):
    for name in "abc":
        write_cloud_ply(tmp_path / "data" / f"{name}.ply", sphere_cloud(50))
    shapes = {"a": ("Mug", "a"), "b": ("Lamp", "b"), "c": ("Lamp", "c")}
    manifest = write_shapes(
        tmp_path / "m.csv",
        {key: (category, tmp_path / "data" / f"{name}.ply") for key, (category, name) in shapes.items()},
    )
    folders = [write_shard(tmp_path / "0", {"a": BALL, "b": "udf", "c": BALL})]
    dataset = {"kind": "folder", "root": str(tmp_path / "data")}
    draw_spheres_from_files(both(tmp_path), manifest, folders, split="test", dataset=dataset, seed=1, view=SMALL)
    drawn = (pixels(tmp_path / "figure.png") < 0.9).any(axis=2)
    share = [part.mean() for part in np.array_split(drawn[:, : drawn.shape[1] * 5 // 6], 2, axis=1)]
    assert share[1] > 0.3 > 0.1 > share[0] > 0.001  # the lamp comes first and has failed
    assert (tmp_path / "figure.pdf").exists()


def test_points_are_drawn_over_the_balls(tmp_path):
    orange = []
    for count in (20, 200):
        shapes = {"ball": (sphere_cloud(count), BALL)}
        draw_spheres(both(tmp_path), shapes, view=SMALL)
        picture = pixels(tmp_path / "figure.png")
        orange.append(((picture[..., 0] > 0.4) & (picture[..., 1] < 0.6 * picture[..., 0])).sum())
    assert 3 * orange[0] < orange[1]


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_spheres(both(tmp_path), {})
