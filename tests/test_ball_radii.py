import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.errors import ConfigError, InputError
from morphoskel.skeleton.ball_radii import radii_of


def radii_naive(centres, points, kind):
    distances = [[np.linalg.norm(point - centre) for centre in centres] for point in points]
    radii = []
    for number in range(len(centres)):
        own = [row[number] for row in distances if min(row) == row[number]]
        if kind == "nearest" or not own:
            radii.append(min(row[number] for row in distances))
        else:
            radii.append(sum(own) / len(own))
    return radii


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 12), st.integers(1, 40), st.sampled_from(["nearest", "mean_assigned"]))
def test_equals_the_naive_twin(seed, centre_count, point_count, kind):
    generator = np.random.default_rng(seed)
    centres, points = generator.random((centre_count, 3)), generator.random((point_count, 3))
    np.testing.assert_allclose(radii_of(centres, points, kind), radii_naive(centres, points, kind))


def test_both_are_the_radius_of_a_sphere_around_its_centre():
    points = np.random.default_rng(0).normal(size=(100, 3))
    points *= 2 / np.linalg.norm(points, axis=1, keepdims=True)
    for kind in ("nearest", "mean_assigned"):
        np.testing.assert_allclose(radii_of(np.zeros((1, 3)), points, kind), 2)


def test_a_centre_without_points_takes_the_nearest():
    centres, points = np.array([[0.0, 0, 0], [9.0, 0, 0]]), np.array([[1.0, 0, 0], [-3.0, 0, 0]])
    assert radii_of(centres, points, "mean_assigned").tolist() == [2, 8]


def test_nothing_to_measure():
    assert len(radii_of(np.empty((0, 3)), np.ones((5, 3)), "mean_assigned")) == 0
    with pytest.raises(InputError, match="no point on the surface"):
        radii_of(np.zeros((1, 3)), np.empty((0, 3)))
    with pytest.raises(ConfigError, match="expected one of nearest, mean_assigned, got 'furthest'"):
        radii_of(np.zeros((1, 3)), np.ones((5, 3)), "furthest")
