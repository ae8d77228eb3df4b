from dataclasses import replace

import numpy as np
import pytest
import torch
import trimesh
from scipy.spatial.distance import cdist
from solids import as_mesh, sphere_cloud
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER, TINY_SKELETON

from morphoskel.datasets.cloud_set import normalise
from morphoskel.errors import ConfigError, InputError
from morphoskel.networks.point_generator import PointGenerator
from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork
from morphoskel.networks.skeleton_sampler import SkeletonSampler
from morphoskel.sampling.lfs import LfsSettings, lfs_points
from morphoskel.sampling.prior import PriorSettings, prior_weights
from morphoskel.sampling.sample_shape import SampledShape, ShapeSampler
from morphoskel.sampling.trained import choose_trained
from morphoskel.shapes import PointCloud
from morphoskel.skeleton.thinning import farthest_points

INSIDE = {
    "method": "ms3d",
    "candidates": {"mode": "random", "count": 20_000},
    "k": 20,
    "points": 20,
    "seed": 3,
    "watertight_settings": {"resolution": 2000},
    "threads": 1,
}
PILL = as_mesh(trimesh.creation.capsule(height=2, radius=0.5, count=[24, 24]))
CLOUD = PointCloud(sphere_cloud(90).points * [4, 4, 1] + [9, 0, 0], sphere_cloud(90).normals, np.arange(90))


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def seeded(network, *arguments):
    with torch.random.fork_rng():
        torch.manual_seed(0)
        return network(*arguments).eval()


def sampler(name, **others):
    values = {
        "count": 12,
        "seed": 3,
        "skeletonization": {},
        "lfs": LfsSettings(exponent=1.0, floor=0.1),
        "prior": PriorSettings(bins=6, sharpness=1.0),
        "network_points": 60,
    }
    return ShapeSampler(name, **{**values, **others})


@pytest.fixture
def network():
    return seeded(SkeletonSampler, 12, TINY_SAMPLER)


def test_random_points_are_fixed_by_seed_and_name_and_nested():
    chosen = sampler("random")(CLOUD, "a").indices.tolist()
    assert sampler("random", count=20)(CLOUD, "a").indices[:12].tolist() == chosen
    assert sampler("random")(CLOUD, "b").indices.tolist() != chosen
    assert sampler("random", seed=4)(CLOUD, "a").indices.tolist() != chosen


def test_farthest_points_start_with_the_first():
    assert sampler("fps")(CLOUD, "a").indices.tolist() == farthest_points(CLOUD.points, 12).tolist()


def test_lfs_measures_the_distance_to_the_skeleton_of_ms3d():
    result = sampler("lfs", count=40, skeletonization=INSIDE)(PILL, "a")
    assert len(result.cloud) == 2000
    assert result.sizes == pytest.approx(cdist(result.cloud.points, result.skeleton.points).min(axis=1))
    assert np.median(np.linalg.norm(result.skeleton.points[:, :2], axis=1)) < 0.1  # from the axis
    expected = lfs_points(result.cloud.points, result.sizes, 40, LfsSettings(exponent=1.0, floor=0.1))
    assert result.indices.tolist() == expected.tolist()


def test_the_chosen_points_keep_normals_and_labels():
    indices = np.array([7, 3, 40, 80])
    chosen = SampledShape(CLOUD, indices).chosen
    assert np.array_equal(chosen.points, CLOUD.points[indices])
    assert np.array_equal(chosen.normals, CLOUD.normals[indices])
    assert np.array_equal(chosen.labels, indices)
    assert SampledShape(PointCloud(CLOUD.points), indices).chosen.normals is None


def test_a_larger_cloud_is_thinned_before_the_network_sees_it():
    network = seeded(PointGenerator, 12, TINY)
    result = sampler("snet", network=network)(CLOUD, "a")
    assert len({*result.indices.tolist()}) == 12
    assert result.sizes is None
    everything = sampler("snet", network=network, network_points=90)(CLOUD, "a")
    expected = choose_trained(network, normalise(CLOUD.points)[0], None)
    assert everything.indices.tolist() == expected.indices.tolist()
    assert everything.chosen_by_network == expected.matched
    seen = {
        index
        for seed in range(30)
        for index in sampler("snet", seed=seed, network=network)(CLOUD, "a").indices.tolist()
    }
    assert max(seen) >= 60  # indices refer to the whole cloud


def test_the_prior_is_measured_in_the_normalised_frame(network):
    ready = sampler("ms3d", skeletonization=INSIDE, network=network, network_points=2000)
    result = ready(PILL, "a")
    points, _, scale = normalise(result.cloud.points)
    weights = prior_weights(result.sizes / scale, ready.prior)
    assert weights.max() > weights.min()
    assert result.indices.tolist() == choose_trained(network, points, weights).indices.tolist()
    again = sampler("uniform", network=network, network_points=2000)(PILL, "a")
    assert again.skeleton is None
    assert again.indices.tolist() == choose_trained(network, points, np.ones(2000)).indices.tolist()
    shuffled = replace(ready, sampler="shuffled")(PILL, "a")
    assert np.array_equal(shuffled.sizes, result.sizes)


def test_a_predicted_skeleton_moves_with_the_shape(network):
    ready = sampler("skeleton_aware", network=network, skeleton_network=seeded(SkeletonAwareNetwork, TINY_SKELETON))
    result = ready(CLOUD, "a")
    moved = ready(PointCloud(CLOUD.points * 8 - 1024), "a")  # exact in float64, so the network sees the same
    assert moved.indices.tolist() == result.indices.tolist()
    assert moved.skeleton.points == pytest.approx(result.skeleton.points * 8 - 1024, abs=1e-2)
    assert moved.sizes == pytest.approx(result.sizes * 8, abs=1e-2)


def test_noise_depends_on_seed_and_name(network):
    ready = sampler("uniform", network=network, noise=True)
    chosen = ready(CLOUD, "a").indices.tolist()
    assert ready(CLOUD, "a").indices.tolist() == chosen
    assert replace(ready, seed=5)(CLOUD, "a").indices.tolist() != chosen
    assert ready(CLOUD, "b").indices.tolist() != chosen


def test_what_cannot_be_done_is_refused():
    with pytest.raises(InputError, match="91 points are wanted, and it has only 90"):
        sampler("fps", count=91)(CLOUD, "a")
    with pytest.raises(ConfigError, match=r"sampler 'ms3d': .*network are missing"):
        sampler("ms3d")(CLOUD, "a")
    with pytest.raises(ConfigError, match="sampler 'lfs': its settings"):
        sampler("lfs", lfs=None)(CLOUD, "a")
