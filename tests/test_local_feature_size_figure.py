import numpy as np
import pytest
from shard_folders import both, pixels
from solids import sphere_cloud
from tiny_clouds import tiny_clouds, tiny_priors

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import InputError
from morphoskel.reporting.figures.local_feature_size import draw_size_map, draw_size_map_from_files
from morphoskel.reporting.render import View
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.prior_set import write_prior_set

SETTINGS = PriorSettings(bins=6, sharpness=1.0)
FRONT = View(azimuth=0, elevation=0, pixels=150)


def yellow_and_blue(half):
    """Return the mean height, from the top, of what has the colours of the two ends of the scale."""
    red, green, blue = np.moveaxis(half[:, : half.shape[1] * 8 // 10], 2, 0)
    return [np.argwhere(mask)[:, 0].mean() for mask in ((red > 0.5) & (blue < 0.4 * green), blue > 3 * green)]


def test_the_smallest_sizes_have_the_largest_weights(tmp_path):
    points = sphere_cloud(1500).points
    draw_size_map(both(tmp_path), {"ball": (points, points[:, 1] + 1)}, SETTINGS, view=FRONT)
    picture = pixels(tmp_path / "figure.png")
    sizes, weights = np.array_split(picture, 2)
    large, small = yellow_and_blue(sizes)
    assert large < small
    heavy, light = yellow_and_blue(weights)
    assert heavy > light
    assert (tmp_path / "figure.pdf").exists()


def test_sizes_are_relative_to_the_largest_of_their_cloud(tmp_path):
    points = sphere_cloud(200).points
    shown = []
    for factor in (1.0, 10.0):
        clouds = {"ball": (points, factor * (points[:, 1] + 2))}
        draw_size_map(both(tmp_path), clouds, PriorSettings(bins=6, sharpness=0.0), view=FRONT)
        picture = pixels(tmp_path / "figure.png")
        shown.append(picture[: picture.shape[0] // 3, : picture.shape[1] // 2])
    assert np.array_equal(*shown)


def test_a_cloud_without_sizes_says_so(tmp_path):
    clouds = tiny_clouds(shapes=4)
    pictures = []
    for failed in ((), (1,)):
        write_cloud_set(clouds, tmp_path / "clouds.npz")
        write_prior_set(tiny_priors(clouds, failed), tmp_path / "priors.npz")
        draw_size_map_from_files(
            both(tmp_path),
            tmp_path / "clouds.npz",
            tmp_path / "priors.npz",
            prior={"bins": 6, "sharpness": 1.0},
            view=FRONT,
        )
        pictures.append(pixels(tmp_path / "figure.png"))
    drawn = [[(half < 1).any(axis=2).mean() for half in np.array_split(picture, 2, axis=1)] for picture in pictures]
    assert drawn[1][1] < drawn[0][1] - 0.02  # the line, of which words are left


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_size_map(both(tmp_path), {}, SETTINGS)
