import numpy as np
import pytest
from scipy import ndimage
from shard_folders import both, pixels, write_shapes, write_shard
from solids import ball

from morphoskel.errors import InputError
from morphoskel.reporting.figures.reconstructions import (
    Rebuilt,
    draw_reconstructions,
    draw_reconstructions_from_files,
)
from morphoskel.reporting.render import View
from morphoskel.shapes import Skeleton

SMALL = View(azimuth=0, elevation=0, pixels=100)


def balls(radius):
    return Skeleton([[0.0, 0, 0]], [radius], [0.0])


def widths(picture):
    """Return the width of every large thing that is drawn, without the scale."""
    drawn = (picture[:, : picture.shape[1] * 9 // 10] < 0.95).any(axis=2)
    boxes = ndimage.find_objects(ndimage.label(drawn)[0])
    return sorted(box[1].stop - box[1].start for box in boxes if box[0].stop - box[0].start > 60)


def test_what_is_compared_has_one_scale_in_space_and_colour(tmp_path):
    rebuilt = {
        "large": Rebuilt(ball(1.0, 3), balls(0.9)),
        "small": Rebuilt(ball(0.5, 3), balls(0.45)),
    }
    draw_reconstructions(both(tmp_path), {"ball": rebuilt}, view=SMALL)
    picture = pixels(tmp_path / "figure.png")
    found = widths(picture)
    assert len(found) == 4
    assert found == pytest.approx([found[3] / 2] * 2 + [found[3]] * 2, rel=0.04)
    shown = picture[picture.shape[0] // 2 :, : picture.shape[1] * 9 // 10]
    yellow = ((shown[..., 0] > 0.6) & (shown[..., 2] < 0.5)).any(axis=0)
    assert yellow.any()
    assert not yellow[yellow.size // 2 :].any()  # a ball of half the size is not at the end of the scale


def test_a_failed_reconstruction_says_so_in_its_column(tmp_path):
    manifest = write_shapes(tmp_path / "m.csv", {"a": ("Mug", tmp_path), "b": ("Chair", tmp_path)})
    surfaces, skeletons = {}, {}
    for name, results in {
        "poisson": (ball(subdivisions=2), balls(0.9)),
        "ponq": ("reconstruct", "reconstruct"),
    }.items():
        surfaces[name] = [write_shard(tmp_path / "surface" / name, dict.fromkeys("ab", results[0]))]
        skeletons[name] = [write_shard(tmp_path / "skeleton" / name, dict.fromkeys("ab", results[1]))]
    draw_reconstructions_from_files(both(tmp_path), manifest, surfaces, skeletons, split="test", view=SMALL)
    picture = pixels(tmp_path / "figure.png")
    left, right = np.array_split(picture[:, : picture.shape[1] * 9 // 10], 2, axis=1)
    assert (left < 0.9).any(axis=2).mean() > 0.3
    assert 0.001 < (right < 0.5).any(axis=2).mean() < 0.05
    assert (tmp_path / "figure.pdf").exists()


def test_words_alone_are_drawn_where_all_failed(tmp_path):
    draw_reconstructions(both(tmp_path), {"ball": {"poisson": Rebuilt("failed", "not computed")}}, view=SMALL)
    assert 0.001 < (pixels(tmp_path / "figure.png") < 0.5).any(axis=2).mean() < 0.05


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_reconstructions(both(tmp_path), {})
