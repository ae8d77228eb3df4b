import numpy as np
import pytest
from shard_folders import both, pixels, write_shapes, write_shard
from solids import sphere_cloud

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply
from morphoskel.reporting.figures.explanation import draw_explanation, draw_explanation_from_files, unexplained
from morphoskel.reporting.render import View
from morphoskel.shapes import PointCloud, Skeleton

EXPLAINED = Skeleton(np.zeros((1, 3)), [1.0], [0.0])
SMALL_BALL = Skeleton(np.zeros((1, 3)), [0.4], [0.0])
SMALL = View(pixels=100)


def panels(path, rows, columns):
    """Return the panels of a figure, without the names of its rows and the scale."""
    picture = pixels(path)
    picture = picture[:, picture.shape[1] // 10 : picture.shape[1] * 17 // 20]
    return [np.array_split(row, columns, axis=1) for row in np.array_split(picture, rows, axis=0)]


def purple(picture):
    """Return how much of a picture has the colour of the largest distances."""
    return (picture[..., 1] < 0.3 * picture[..., 2]).mean()


def test_a_point_is_explained_by_the_ball_that_it_lies_on():
    points = np.vstack([sphere_cloud(50).points, np.eye(3), -np.eye(3)])
    for scale in (1.0, 5.0):  # distances are relative to the size of the cloud
        cloud = PointCloud(scale * points)
        assert unexplained(cloud, Skeleton(np.zeros((1, 3)), [scale])) == pytest.approx(np.zeros(56), abs=1e-9)
        assert unexplained(cloud, Skeleton(np.zeros((1, 3)), [0.4 * scale])) == pytest.approx(np.full(56, 30.0))


def test_what_is_not_explained_has_the_colour_of_the_end_of_the_scale(tmp_path):
    shapes = {"ball": (sphere_cloud(300), {"whole": EXPLAINED, "small": SMALL_BALL})}
    draw_explanation(both(tmp_path), shapes, view=SMALL)
    (whole,), (small,) = panels(tmp_path / "figure.png", 2, 1)
    assert purple(small) > 0.3
    assert purple(whole) == 0
    assert (whole < 0.9).any(axis=2).mean() > 0.3
    assert (tmp_path / "figure.pdf").exists()


def test_one_column_a_category_and_words_where_a_skeleton_is_missing(tmp_path):
    files = {name: tmp_path / "data" / f"{name}.ply" for name in "ab"}
    for file in files.values():
        write_cloud_ply(file, sphere_cloud(100))
    manifest = write_shapes(tmp_path / "m.csv", {"a": ("Lamp", files["a"]), "b": ("Mug", files["b"])})
    skeletons = {
        "poisson/ms3d": [write_shard(tmp_path / "ms3d", {"a": SMALL_BALL, "b": SMALL_BALL})],
        "poisson/ms3d_coverage": [write_shard(tmp_path / "coverage", {"a": "udf", "b": SMALL_BALL})],
    }
    dataset = {"kind": "folder", "root": str(tmp_path / "data")}
    draw_explanation_from_files(both(tmp_path), manifest, skeletons, dataset=dataset, seed=1, split="test", view=SMALL)
    (mug, lamp), (covered_mug, covered_lamp) = panels(tmp_path / "figure.png", 2, 2)
    assert min(purple(mug), purple(lamp), purple(covered_mug)) > 0.2
    assert purple(covered_lamp) == 0
    assert 0.0005 < (covered_lamp < 0.5).any(axis=2).mean() < 0.05


def test_nothing_to_draw_is_refused(tmp_path):
    for shapes in ({}, {"ball": (sphere_cloud(50), {})}):
        with pytest.raises(InputError, match="at least one shape"):
            draw_explanation(both(tmp_path), shapes)
