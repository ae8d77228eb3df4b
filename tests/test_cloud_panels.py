import numpy as np
import pytest
from solids import sphere_cloud

from morphoskel.reporting.figures.cloud_panels import NEIGHBOUR, OVERLAP, draw_cloud, touching_radius
from morphoskel.reporting.render import View


def slow_radius(points):
    distinct = np.unique(points, axis=0)
    distances = [sorted(np.linalg.norm(distinct - point, axis=1))[NEIGHBOUR] for point in distinct]
    return OVERLAP * np.median(distances)


def test_the_radius_is_that_of_a_plain_loop():
    points = np.random.default_rng(0).normal(size=(60, 3))
    assert touching_radius(points) == pytest.approx(slow_radius(points))
    assert touching_radius(np.vstack([points, points[:20]])) == pytest.approx(slow_radius(points))


def test_few_or_equal_points_have_a_radius():
    assert touching_radius(np.zeros((5, 3))) == 0
    assert touching_radius(np.array([[0.0, 0, 0], [1, 0, 0]])) == pytest.approx(OVERLAP)


def test_the_points_of_a_sphere_close_up_to_its_surface():
    picture = draw_cloud(sphere_cloud(2000).points, (0.2, 0.4, 0.6), View(azimuth=0, elevation=0, pixels=100))
    drawn = (picture < 1).all(axis=2)
    across, along = np.meshgrid(*2 * [np.linspace(-1, 1, 100)])
    assert drawn[np.hypot(across, along) < 0.8].mean() > 0.99


def test_every_point_has_its_colour():
    points = np.array([[-1.0, 0, 0], [-1, 0, 0], [1, 0, 0]])
    picture = draw_cloud(points, np.array([[1.0, 0, 0], [1, 0, 0], [0, 0, 1]]), View(azimuth=0, elevation=0, pixels=50))
    left, right = picture[:, :25], picture[:, 25:]
    assert (left[..., 0] >= left[..., 2]).all()
    assert (right[..., 2] >= right[..., 0]).all()
    assert (left < 1).any()
    assert (right < 1).any()
