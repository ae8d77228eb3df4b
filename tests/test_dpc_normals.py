import numpy as np
import pytest

from morphoskel.skeleton.dpc.normals import smooth_normals


@pytest.fixture
def cloud():
    rng = np.random.default_rng(1)
    normals = rng.normal(size=(80, 3)) * 0.5 + [0, 0, 1]
    return rng.random((80, 3)), normals / np.linalg.norm(normals, axis=1, keepdims=True)


@pytest.mark.parametrize("angle", [30.0, 90.0])
def test_matches_the_formula(cloud, angle):
    points, normals = cloud
    expected = normals.copy()
    for i in range(len(points)):
        total = np.zeros(3)
        for j in range(len(points)):
            distance = np.linalg.norm(points[i] - points[j])
            if j != i and distance <= 0.4:
                likeness = np.exp(-(((1 - normals[i] @ normals[j]) / (1 - np.cos(np.radians(angle)))) ** 2))
                total += max(np.exp(-4 * distance**2 / 0.4**2) * likeness, 1e-10) * normals[j]
        if total.any():
            expected[i] = total / np.linalg.norm(total)
    np.testing.assert_allclose(smooth_normals(points, normals, radius=0.4, angle=angle), expected, atol=1e-9)


def test_angle_zero_keeps_normals(cloud):
    points, normals = cloud
    np.testing.assert_array_equal(smooth_normals(points, normals, radius=0.4, angle=0.0), normals)


def test_a_plane_keeps_its_normal_and_a_small_angle_keeps_a_sharp_edge():
    grid = np.indices((10, 10)).reshape(2, -1).T / 10.0
    floor = np.column_stack([grid, np.zeros(100)])
    wall = np.column_stack([np.full(100, 1.0), grid])
    normals = np.repeat([[0.0, 0, 1], [1, 0, 0]], 100, axis=0)
    smoothed = smooth_normals(np.vstack([floor, wall]), normals, radius=0.3, angle=15.0)
    np.testing.assert_allclose(smoothed, normals, atol=1e-6)


def test_neighbours_that_cancel_out_and_lonely_points_keep_their_normals():
    points = np.array([[0.0, 0, 0], [0.1, 0, 0], [-0.1, 0, 0], [5, 5, 5]])
    normals = np.array([[0.0, 1, 0], [0, 0, 1], [0, 0, -1], [1, 0, 0]])
    smoothed = smooth_normals(points, normals, radius=0.15, angle=90.0)
    np.testing.assert_array_equal(smoothed[[0, 3]], normals[[0, 3]])
