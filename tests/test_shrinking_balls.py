import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from solids import sphere_cloud

from morphoskel.errors import InputError
from morphoskel.skeleton.shrinking_balls import shrink_balls


def random_case(seed, size):
    """Points of an ellipsoid with exact normals, some of them then turned at random."""
    generator = np.random.default_rng(seed)
    axes = generator.uniform(0.2, 1, 3)
    directions = generator.normal(size=(size, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    normals = directions / axes + (generator.random((size, 1)) < 0.3) * generator.normal(size=(size, 3))
    return directions * axes, normals / np.linalg.norm(normals, axis=1, keepdims=True)


def shrink_naive(points, normals, tolerance):
    """Follow the rule with all distances, one point after the other: radius and second point, -1 if there is none."""
    radii, seconds = [], []
    for point, normal in zip(points, normals, strict=True):
        radius, second = np.linalg.norm(np.ptp(points, axis=0)) / 2, -1
        while True:
            distances = np.linalg.norm(points - (point - radius * normal), axis=1)
            nearest = int(distances.argmin())
            if distances[nearest] >= radius * (1 - (1e-9 if second < 0 else max(tolerance, 1e-9))):
                break
            gap = point - points[nearest]
            radius, second = gap @ gap / (2 * gap @ normal), nearest
        radii.append(radius)
        seconds.append(second)
    return np.array(radii), np.array(seconds)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 120), st.sampled_from([0.0, 0.02, 0.2]))
def test_equals_the_naive_twin(seed, size, tolerance):
    points, normals = random_case(seed, size)
    balls = shrink_balls(points, normals, tolerance=tolerance)
    radii, seconds = shrink_naive(points, normals, tolerance)
    np.testing.assert_array_equal(balls.first, np.flatnonzero(seconds >= 0))
    np.testing.assert_array_equal(balls.second, seconds[seconds >= 0])
    np.testing.assert_allclose(balls.radii, radii[seconds >= 0], rtol=1e-7)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 120))
def test_an_empty_ball_is_the_smallest_of_all_through_another_point(seed, size):
    """The largest empty ball that touches a point with a given normal, in closed form."""
    points, normals = random_case(seed, size)
    balls = shrink_balls(points, normals, tolerance=0)
    gaps = points[balls.first][:, None] - points
    heights = np.einsum("ijk,ik->ij", gaps, normals[balls.first])
    with np.errstate(divide="ignore", invalid="ignore"):
        through = np.where(heights > 1e-12, (gaps**2).sum(axis=2) / (2 * heights), np.inf)
    np.testing.assert_allclose(balls.radii, through.min(axis=1), rtol=1e-4)


@pytest.mark.parametrize("tolerance", [0, 0.02, 0.1])
def test_balls_touch_two_points_and_are_empty_up_to_the_tolerance(tolerance):
    points, normals = random_case(11, 2000)
    balls = shrink_balls(points, normals, tolerance=tolerance)
    assert len(balls.first) > 1900
    for touched in (balls.first, balls.second):
        np.testing.assert_allclose(np.linalg.norm(points[touched] - balls.centres, axis=1), balls.radii, rtol=1e-9)
    inside = cdist(balls.centres, points).min(axis=1) / balls.radii
    assert inside.min() >= 1 - tolerance - 1e-6
    assert (inside.min() < 1 - 1e-6) == (tolerance > 0)


def test_separation_angles_are_those_at_the_centres():
    points, normals = random_case(12, 500)
    balls = shrink_balls(points, normals)
    first, second = (points[touched] - balls.centres for touched in (balls.first, balls.second))
    cosines = np.einsum("ij,ij->i", first, second) / balls.radii**2
    np.testing.assert_allclose(balls.separation_angles, np.degrees(np.arccos(np.clip(cosines, -1, 1))), atol=1e-3)
    np.testing.assert_allclose(balls.chords, np.linalg.norm(first - second, axis=1), rtol=1e-9)


def two_plates(gap, count, tilt):
    """Samples of two parallel squares of side 2, with outward normals that are off by `tilt` degrees any way."""
    generator = np.random.default_rng(3)
    points = generator.uniform(-1, 1, (2 * count, 3))
    points[:, 2] = np.repeat([-gap / 2, gap / 2], count)
    ways = generator.uniform(0, 2 * np.pi, 2 * count)
    normals = np.column_stack([np.sin(np.radians(tilt)) * np.cos(ways), np.sin(np.radians(tilt)) * np.sin(ways),
                               np.sign(points[:, 2]) * np.cos(np.radians(tilt))])  # fmt: skip
    return points, normals


def test_between_two_plates_all_balls_are_half_the_gap_wide():
    balls = shrink_balls(*two_plates(0.2, 3000, 0), tolerance=0)
    assert np.quantile(balls.radii, 0.99) < 0.106  # the samples opposite are not quite opposite
    np.testing.assert_array_less(0.1 - 1e-9, balls.radii)
    assert np.abs(balls.centres[:, 2]).max() < 0.05
    assert np.quantile(balls.separation_angles, 0.01) > 150


def test_a_normal_that_is_slightly_off_is_forgiven_only_with_the_tolerance():
    """2 % of the radius stand for 11 degrees."""
    plates = two_plates(0.6, 10_000, 8)
    assert np.median(shrink_balls(*plates, tolerance=0).radii) < 0.2
    forgiven = shrink_balls(*plates, tolerance=0.02).radii
    assert np.quantile(forgiven, 0.01) > 0.29
    assert np.quantile(forgiven, 0.99) < 0.33
    assert np.median(shrink_balls(*two_plates(0.6, 10_000, 16), tolerance=0.02).radii) < 0.2


def test_coinciding_points_and_inward_normals_do_no_harm():
    cloud = sphere_cloud(300)
    points, normals = np.repeat(cloud.points, 2, axis=0), np.repeat(cloud.points, 2, axis=0)
    balls = shrink_balls(points, normals)
    assert len(balls.first) == 600
    assert balls.radii.min() > 0.9
    assert len(shrink_balls(points, -normals).first) == 0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"points": np.zeros((4, 2))}, r"points: expected shape \(N, 3\)"),
        ({"points": np.zeros((0, 3))}, r"points: expected shape \(N, 3\) with N >= 1"),
        ({"points": np.full((4, 3), np.nan)}, "points: every value must be finite"),
        ({"points": np.eye(3)}, "normals: expected 3 rows, one a point, got 4"),
        ({"points": np.ones((4, 3))}, "points: all of them coincide"),
        ({"normals": np.zeros((4, 3))}, "normals: 4 of 4 have another length than 1, the first is row 0 with 0"),
        ({"tolerance": 1}, "tolerance: expected a share of the radius"),
    ],
)
def test_illegal_input_is_named(changes, message):
    legal = {"points": np.vstack([np.eye(3), np.zeros((1, 3))]), "normals": np.tile([0.0, 0, 1], (4, 1))}
    with pytest.raises(InputError, match=message):
        shrink_balls(**{**legal, **changes})
