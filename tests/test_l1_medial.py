import dataclasses

import numpy as np
import pytest

from morphoskel.errors import ConfigError, ShapeError
from morphoskel.formats import read_point_cloud
from morphoskel.shapes import PointCloud
from morphoskel.skeleton.ball_radii import radii_of
from morphoskel.skeleton.l1_medial import L1MedialSettings, l1_medial
from tests.tubes import CYLINDER, RADIUS, Y_SHAPE, distance_to_axes, noisy_tubes


def degrees(skeleton):
    return np.bincount(skeleton.edges.ravel(), minlength=len(skeleton))


def components(skeleton):
    labels = list(range(len(skeleton)))
    for first, second in skeleton.edges.tolist():
        old, new = labels[first], labels[second]
        labels = [new if label == old else label for label in labels]
    return len(set(labels))


@pytest.fixture(scope="module")
def cylinder():
    cloud = noisy_tubes(CYLINDER, 1000, 0)
    return cloud, l1_medial(cloud, np.random.default_rng(1))


@pytest.mark.parametrize("powers", [(2, 1), (1, 2)])
def test_a_noisy_cylinder_becomes_one_branch_on_its_axis(cylinder, powers):
    cloud, skeleton = cylinder
    if powers == (1, 2):  # the energy of the paper
        settings = L1MedialSettings(average_power=1, repulsion_power=2)
        published = l1_medial(cloud, np.random.default_rng(1), settings)
        assert not np.array_equal(published.points, skeleton.points)
        skeleton = published
    assert np.bincount(degrees(skeleton)).tolist() == [0, 2, len(skeleton) - 2]
    assert components(skeleton) == 1
    assert distance_to_axes(skeleton.points, CYLINDER).mean() < 0.05 * RADIUS
    along = (skeleton.points - CYLINDER[0][0]) @ (CYLINDER[0][1] - CYLINDER[0][0])
    assert np.ptp(along) > 0.6
    np.testing.assert_allclose(skeleton.radii, RADIUS, rtol=0.25)


def test_noisy_ys_become_three_branches_with_one_junction():
    """About one in six has a branch that stops short of the junction: few samples are left, so the stages end."""
    merged = 0
    for seed in range(12):
        skeleton = l1_medial(noisy_tubes(Y_SHAPE, 2000, seed), np.random.default_rng(seed))
        attached = degrees(skeleton) > 0
        assert distance_to_axes(skeleton.points, Y_SHAPE).mean() < 0.05 * RADIUS
        for arm in Y_SHAPE:  # each has its own branch, up to near its end
            assert distance_to_axes(arm[1:], skeleton.points[skeleton.edges]) < 0.3
        junction = skeleton.points[degrees(skeleton) == 3]
        if (degrees(skeleton) == 1).sum() == 3 and len(junction) == 1:
            assert components(skeleton) == 1 + (~attached).sum()
            assert np.linalg.norm(junction[0]) < RADIUS
            merged += 1
    assert merged >= 8


def test_the_nodes_are_evenly_spaced(cylinder):
    cloud, skeleton = cylinder
    settings = L1MedialSettings(recentre=False, spacing=0.02)
    skeleton = l1_medial(cloud, np.random.default_rng(1), settings)
    steps = np.linalg.norm(np.diff(skeleton.points[skeleton.edges], axis=1)[:, 0], axis=1)
    box = np.ptp(cloud.points, axis=0).max()
    np.testing.assert_allclose(np.median(steps), 0.02 * box, rtol=0.05)
    assert steps.max() < 0.021 * box  # chords are never longer than the pieces of curve


def test_the_same_input_gives_the_same_bits_and_another_seed_others(cylinder):
    cloud, skeleton = cylinder
    again = l1_medial(cloud, np.random.default_rng(1))
    assert np.array_equal(again.points, skeleton.points)
    assert np.array_equal(again.edges, skeleton.edges)
    assert not np.array_equal(l1_medial(cloud, np.random.default_rng(2)).points, skeleton.points)


def test_scales_with_the_cloud(cylinder):
    """Powers of two, so that rounding is the same; a millimetre shape has the skeleton of a metre shape."""
    cloud, skeleton = cylinder
    large = l1_medial(PointCloud(1024 * cloud.points), np.random.default_rng(1))
    assert np.array_equal(large.points, 1024 * skeleton.points)
    assert np.array_equal(large.radii, 1024 * skeleton.radii)


def test_the_kind_of_radius(cylinder):
    cloud, skeleton = cylinder
    for kind in ("nearest", "mean_assigned"):
        measured = l1_medial(cloud, np.random.default_rng(1), L1MedialSettings(radius=kind))
        assert np.array_equal(measured.points, skeleton.points)
        assert np.array_equal(measured.radii, radii_of(skeleton.points, cloud.points, kind))
    assert measured.radii.mean() > skeleton.radii.mean()
    assert skeleton.residues is None


def test_a_shape_without_a_branch_keeps_its_leftover_or_says_so():
    points = np.random.default_rng(0).normal(size=(120, 3))
    ball = PointCloud(points / np.linalg.norm(points, axis=1, keepdims=True))
    settings = L1MedialSettings(directionality=1.0)
    leftover = l1_medial(ball, np.random.default_rng(0), settings)
    assert len(leftover) > 0
    assert len(leftover.edges) == 0
    assert (np.linalg.norm(leftover.points, axis=1) < 0.5).all()
    with pytest.raises(ShapeError, match="no part of the shape contracts to a line; lower the directionality"):
        l1_medial(ball, np.random.default_rng(0), dataclasses.replace(settings, keep_leftover=False))


def test_the_smallest_clouds():
    corners = PointCloud(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]))
    assert len(l1_medial(corners, np.random.default_rng(0))) > 0
    flat = PointCloud(np.random.default_rng(0).random((60, 3)) * [1, 1, 0])
    assert (l1_medial(flat, np.random.default_rng(0)).points[:, 2] == 0).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"samples": 1}, "samples must be from 2 to 1e"),
        ({"average_power": 3}, "average_power must be from 0 to 2, got 3"),
        ({"merge_distance": float("nan")}, "merge_distance must be from 0 .* got nan"),
        ({"least_repulsion": 0.5}, "largest_repulsion .0.35. must not be below least_repulsion .0.5."),
        ({"radius": "mean"}, "radius must be one of nearest, mean_assigned, got 'mean'"),
    ],
)
def test_illegal_settings(change, message):
    with pytest.raises(ConfigError, match=message):
        L1MedialSettings(**change)


@pytest.mark.parametrize("category", ["03467517", "04090263"])
def test_real_shapes(real_data, category):
    path = min((real_data / "point2skeleton" / "pointclouds" / category).glob("*.ply"))
    cloud = read_point_cloud(path)
    skeleton = l1_medial(cloud, np.random.default_rng(0))
    assert 10 < len(skeleton) < 1000
    assert len(skeleton.edges) > 10
    sides = np.ptp(cloud.points, axis=0)
    assert (skeleton.points >= cloud.points.min(axis=0) - 0.01 * sides).all()
    assert (skeleton.points <= cloud.points.max(axis=0) + 0.01 * sides).all()
    assert skeleton.radii.max() < sides.max() / 2
