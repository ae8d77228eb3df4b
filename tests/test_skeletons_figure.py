import numpy as np
import pytest
from scipy import ndimage
from shard_folders import both, pixels, write_shapes, write_shard
from solids import ball

from morphoskel.errors import InputError
from morphoskel.reporting.figures.skeletons import REACH, draw_skeletons, draw_skeletons_from_files
from morphoskel.reporting.render import View
from morphoskel.shapes import Skeleton

SMALL = View(azimuth=0, elevation=0, pixels=100)


def balls(radius, *centres):
    centres = centres or ([0.0, 0, 0],)
    return Skeleton(centres, [radius] * len(centres), [0.0] * len(centres))


def without_names_and_scale(path):
    picture = pixels(path)
    return picture[:, picture.shape[1] // 10 : picture.shape[1] * 17 // 20]


def things(picture):
    """Return width and height of every large thing that is drawn, from top to bottom, and its usual colour."""
    labels, _ = ndimage.label((picture < 0.95).any(axis=2))
    found = []
    for box in ndimage.find_objects(labels):
        high, wide = (side.stop - side.start for side in box)
        if min(high, wide) > 60:
            colours = picture[box].reshape(-1, 3)
            found.append((wide, high, np.median(colours[(colours < 0.95).any(axis=1)], axis=0)))
    return found


def test_all_skeletons_of_a_shape_have_one_scale_in_space_and_colour(tmp_path):
    skeletons = {"tiny": balls(0.25), "usual": balls(0.5), "too large": balls(1.0)}
    draw_skeletons(both(tmp_path), {"ball": {name: ("failed", balls) for name, balls in skeletons.items()}}, view=SMALL)
    (tiny, _, dark), (usual, _, bright), (large, _, brightest) = things(
        without_names_and_scale(tmp_path / "figure.png")
    )
    assert (tiny, usual) == pytest.approx((large / 4, large / 2), rel=0.05)
    # The scale ends at the median, so that the largest ball does not make the usual one dark.
    assert bright == pytest.approx(brightest, abs=0.05)
    assert dark[0] < 0.5 * bright[0]
    assert (tmp_path / "figure.pdf").exists()


def test_one_huge_ball_leaves_the_shape_its_size(tmp_path):
    widths = []
    for radius in (1 + 2 * REACH, 30.0):
        of_shape = {"fits": (ball(1.0, 2), balls(1.0)), "huge": (ball(1.0, 2), balls(radius))}
        draw_skeletons(both(tmp_path), {"ball": of_shape}, view=SMALL)
        widths.append(things(without_names_and_scale(tmp_path / "figure.png"))[0][0])
    assert widths[0] == pytest.approx(widths[1], rel=0.06)


def test_one_column_a_category_in_the_surface_of_its_row_and_words_for_what_failed(tmp_path):
    shapes = {"a": ("Mug", tmp_path), "b": ("Mug", tmp_path), "c": ("Chair", tmp_path), "d": ("Lamp", tmp_path)}
    manifest = write_shapes(tmp_path / "m.csv", shapes)
    meshes = {"poisson": [write_shard(tmp_path / "surfaces", {"a": ball(subdivisions=2), "c": ball(subdivisions=2)})]}
    found = balls(0.2, [-0.7, 0, 0], [0.7, 0, 0])
    pairs = {"cloud/dpc": {"a": found, "c": found, "d": "dpc"}, "poisson/ms3d": {"a": found, "c": "udf", "d": "udf"}}
    skeletons = {pair: [write_shard(tmp_path / pair, results)] for pair, results in pairs.items()}
    draw_skeletons_from_files(both(tmp_path), manifest, meshes, skeletons, split="test", view=SMALL)
    picture = without_names_and_scale(tmp_path / "figure.png")
    share = [
        [(panel < 0.98).any(axis=2).mean() for panel in np.array_split(row, 3, axis=1)]
        for row in np.array_split(picture, 2, axis=0)
    ]
    # From left to right: the chair, which comes first, the lamp and the mug.
    assert min(share[0][0], share[0][2]) > 0.5  # DPC has no surface of its own; the veil is that of another
    assert share[1][2] > 0.5
    assert all(0.001 < few < 0.1 for few in (share[1][0], share[0][1], share[1][1]))


def test_nothing_to_draw_is_refused(tmp_path):
    for shapes in ({}, {"Mug": {}}):
        with pytest.raises(InputError, match="at least one shape"):
            draw_skeletons(both(tmp_path), shapes)
