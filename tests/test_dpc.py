import numpy as np
import pytest

from morphoskel.errors import InputError, ShapeError
from morphoskel.evaluation.sphere_metrics import hd_recon, mean_point_to_sphere, sphere_distances
from morphoskel.formats import read_point_cloud
from morphoskel.shapes import PointCloud
from morphoskel.skeleton.dpc import DeepPointsSettings, deep_points
from morphoskel.skeleton.dpc.neighbourhood import mean_spacing


def unit_rows(rows):
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


@pytest.fixture(scope="module")
def ball():
    directions = unit_rows(np.random.default_rng(0).normal(size=(500, 3)))
    return PointCloud(directions, directions)


def plates(half_distance):
    """Return two facing square plates, sampled at random and independently."""
    rng = np.random.default_rng(1)
    flat = rng.uniform(-0.5, 0.5, (2, 600, 2))
    heights = np.repeat([-half_distance, half_distance], 600)
    normals = np.column_stack([np.zeros((1200, 2)), np.sign(heights)])
    return PointCloud(np.column_stack([flat.reshape(-1, 2), heights]), normals)


@pytest.mark.parametrize("half_distance", [0.06, 0.15])
def test_two_plates_meet_half_way(half_distance):
    cloud = plates(half_distance)
    skeleton = deep_points(cloud)
    assert len(skeleton) == len(cloud)
    assert len(skeleton.edges) == len(skeleton.triangles) == 0
    step = DeepPointsSettings().step * mean_spacing(cloud.points)
    inside = np.abs(cloud.points[:, :2]).max(axis=1) < 0.4  # away from the plates' open borders
    heights = np.abs(skeleton.points[inside, 2])
    assert np.quantile(heights, 0.95) < step
    assert heights.max() < 2 * step
    radii = skeleton.radii[inside]
    assert np.abs(np.median(radii) - half_distance) < step
    # No point of a plate is nearer than the plate; the nearest is one spacing to the side at most.
    assert (radii > half_distance - 2 * step).all()
    assert (radii < np.hypot(half_distance + step, 2.5 * mean_spacing(cloud.points))).all()


def test_a_ball_shrinks_to_its_centre(ball):
    skeleton = deep_points(ball)
    assert np.linalg.norm(skeleton.points, axis=1).max() < 2 * mean_spacing(ball.points)
    assert np.abs(skeleton.radii - 1.0).max() < 2 * mean_spacing(ball.points)


def test_kinds_of_radii(ball):
    nearest, assigned, link = (
        deep_points(ball, DeepPointsSettings(radii=kind)) for kind in ("nearest", "mean_assigned", "deep_link")
    )
    np.testing.assert_array_equal(nearest.points, link.points)
    np.testing.assert_allclose(link.radii, np.linalg.norm(ball.points - link.points, axis=1))
    distances = np.linalg.norm(nearest.points[:, None] - ball.points, axis=2)
    np.testing.assert_allclose(nearest.radii, distances.min(axis=1))
    assert (link.radii >= nearest.radii).all()
    assert (assigned.radii >= nearest.radii - 1e-12).all()
    assert (assigned.radii != nearest.radii).any()


def test_fewer_samples(ball):
    skeleton = deep_points(ball, DeepPointsSettings(samples=300))
    assert len(skeleton) == 300
    assert np.linalg.norm(skeleton.points, axis=1).max() < 4 * mean_spacing(ball.points)
    with pytest.raises(InputError, match="500"):
        deep_points(ball, DeepPointsSettings(samples=501))


def test_units_and_repetition_do_not_change_the_result(ball):
    skeleton = deep_points(ball)
    again = deep_points(ball)
    np.testing.assert_array_equal(skeleton.points, again.points)
    np.testing.assert_array_equal(skeleton.radii, again.radii)
    doubled = deep_points(PointCloud(2.0 * ball.points, ball.normals))
    np.testing.assert_allclose(doubled.points, 2.0 * skeleton.points, atol=1e-9)


def test_normals_are_completed(ball):
    skeleton = deep_points(PointCloud(ball.points))
    assert np.linalg.norm(skeleton.points, axis=1).max() < 4 * mean_spacing(ball.points)


def test_outliers_coinciding_points_and_contradictory_normals(ball):
    rng = np.random.default_rng(2)
    points = np.vstack([ball.points, ball.points[:50], [[20.0, 0, 0], [0, -15.0, 0]]])
    normals = np.vstack([ball.points, -ball.points[:50], [[1.0, 0, 0], [0, 1, 0]]])
    normals[rng.permutation(500)[:100]] *= -1
    normals[60:70] = 0
    skeleton = deep_points(PointCloud(points, normals))
    assert len(skeleton) == 552
    assert np.isfinite(skeleton.points).all()


def test_an_open_sheet_has_no_inside():
    flat = np.random.default_rng(3).random((100, 2))
    sheet = PointCloud(np.column_stack([flat, np.zeros(100)]), np.repeat([[0.0, 0, 1]], 100, axis=0))
    with pytest.raises(ShapeError, match="no inside"):
        deep_points(sheet)


@pytest.mark.parametrize("category", ["02691156", "03001627", "03797390", "04379243"])
def test_real_clouds(real_data, category):
    paths = sorted((real_data / "point2skeleton" / "pointclouds" / category).glob("*.ply"))
    if not paths:
        pytest.skip(f"no clouds of category {category} among the extracts")
    cloud = read_point_cloud(paths[0])
    skeleton = deep_points(cloud)
    assert len(skeleton) == len(cloud)
    size = np.ptp(cloud.points, axis=0).max()
    distances = sphere_distances(cloud.points, skeleton.points, skeleton.radii)
    assert mean_point_to_sphere(distances) < 0.05 * size
    assert hd_recon(distances) < 0.25 * size
