import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from solids import sphere_cloud

from morphoskel.errors import InputError, ShapeError
from morphoskel.skeleton.coverage_axis import coverage_axis


def standardised(values):
    deviation = np.std(values, ddof=1) if len(values) > 1 else 0
    return (values - np.mean(values)) / deviation if np.ptp(values) and deviation else np.zeros(len(values))


def coverage_axis_naive(surface_points, candidates, points, offset, penalty, stop):
    """Keep the whole table of who covers what, and score all candidates anew for each pick."""
    extent = np.ptp(surface_points, axis=0).max()
    gaps = cdist(candidates, surface_points) / extent
    radii = gaps.min(axis=1)
    covers = gaps < radii[:, None] + offset
    cost = 0.1 * radii.max() / radii if penalty == "demo" else standardised(1 / radii)
    uncovered, chosen = np.ones(len(surface_points), bool), []
    while len(chosen) < min(points, len(candidates)):
        gains = covers[:, uncovered].sum(axis=1)
        if stop and not gains.any():
            break
        score = standardised(gains) - cost
        if chosen:
            score += standardised(cdist(candidates, candidates[chosen]).min(axis=1))
        score[chosen] = -np.inf
        chosen.append(int(score.argmax()))
        uncovered &= ~covers[chosen[-1]]
    return candidates[chosen], radii[chosen] * extent


def random_case(seed, samples=60, centres=40):
    """Samples of an ellipsoid of any size and place, and points inside it."""
    generator = np.random.default_rng(seed)
    axes, shift, size = generator.uniform(0.3, 1, 3), generator.normal(size=3), generator.uniform(0.1, 10)
    surface = generator.normal(size=(samples, 3))
    surface /= np.linalg.norm(surface, axis=1, keepdims=True)
    inner = generator.normal(size=(centres, 3))
    inner *= generator.uniform(0, 0.9, (centres, 1)) / np.linalg.norm(inner, axis=1, keepdims=True)
    return size * (surface * axes + shift), size * (inner * axes + shift)


@settings(max_examples=60, deadline=None)
@given(
    st.integers(0, 10_000),
    st.integers(1, 50),
    st.sampled_from([0.001, 0.02, 0.3]),
    st.sampled_from(["demo", "standardised"]),
    st.booleans(),
)
def test_equals_the_naive_twin(seed, points, offset, penalty, stop):
    surface, inner = random_case(seed)
    skeleton = coverage_axis(surface, inner, points=points, offset=offset, penalty=penalty, stop_when_covered=stop)
    centres, radii = coverage_axis_naive(surface, inner, points, offset, penalty, stop)
    np.testing.assert_array_equal(skeleton.points, centres)
    np.testing.assert_allclose(skeleton.radii, radii, rtol=1e-9)


def covered(surface, skeleton, offset):
    grown = skeleton.radii + offset * np.ptp(surface, axis=0).max()
    return (cdist(surface, skeleton.points) < grown * (1 + 1e-9)).any(axis=1)


@pytest.mark.parametrize("seed", range(5))
def test_every_sample_is_covered_at_the_stop(seed):
    surface, inner = random_case(seed, 400, 3000)
    skeleton = coverage_axis(surface, inner, points=3000, offset=0.05)
    coverable = (
        cdist(surface, inner) < (cdist(inner, surface).min(axis=1) + 0.05 * np.ptp(surface, axis=0).max())
    ).any(1)
    assert coverable.mean() > 0.9
    assert (covered(surface, skeleton, 0.05) == coverable).all()
    assert len(skeleton) < 400
    shorter = coverage_axis(surface, inner, points=len(skeleton) - 1, offset=0.05)
    assert not covered(surface, shorter, 0.05)[coverable].all()
    np.testing.assert_array_equal(shorter.points, skeleton.points[:-1])


def test_equal_numbers_for_comparisons():
    surface, inner = random_case(1, 300, 2000)
    stopped = coverage_axis(surface, inner, points=500, offset=0.1)
    full = coverage_axis(surface, inner, points=500, offset=0.1, stop_when_covered=False)
    assert len(stopped) < len(full) == 500
    assert len(np.unique(full.points, axis=0)) == 500
    np.testing.assert_array_equal(full.points[: len(stopped)], stopped.points)
    assert len(coverage_axis(surface, inner[:7], points=9, stop_when_covered=False)) == 7


def test_one_ball_covers_a_ball():
    inner = np.random.default_rng(2).uniform(-0.5, 0.5, (500, 3))
    skeleton = coverage_axis(sphere_cloud(2000).points, np.vstack([inner, np.zeros((1, 3))]), points=100)
    assert len(skeleton) == 1
    np.testing.assert_allclose(np.append(skeleton.points[0], skeleton.radii), [0, 0, 0, 1], atol=1e-6)


def test_moves_and_scales_with_the_shape():
    surface, inner = random_case(3, 200, 500)
    before = coverage_axis(surface, inner, points=20)
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])  # a quarter turn keeps the longest side of the box, the unit
    after = coverage_axis(8 * surface @ turn.T + 2, 8 * inner @ turn.T + 2, points=20)
    np.testing.assert_allclose(after.points, 8 * before.points @ turn.T + 2, atol=1e-9)
    np.testing.assert_allclose(after.radii, 8 * before.radii, rtol=1e-9)


def test_candidates_are_thinned_evenly():
    surface, inner = random_case(4, 200, 1000)
    limited = coverage_axis(surface, inner, points=50, candidate_limit=250)
    every_fourth = coverage_axis(surface, inner[::4], points=50, candidate_limit=None)
    np.testing.assert_array_equal(limited.points, every_fourth.points)
    everything = coverage_axis(surface, inner, points=50, candidate_limit=1000)
    assert not np.array_equal(everything.points[:5], limited.points[:5])


def test_candidates_on_the_surface_are_left_out():
    surface, inner = random_case(5)
    with_surface = coverage_axis(surface, np.vstack([surface, inner]), points=10)
    np.testing.assert_array_equal(with_surface.points, coverage_axis(surface, inner, points=10).points)
    with pytest.raises(ShapeError, match="all 60 candidates lie on the surface"):
        coverage_axis(surface, surface, points=10)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"points": 0}, "points: expected at least 1"),
        ({"offset": 0.0}, "offset: expected a length above 0"),
        ({"penalty": "paper"}, "penalty: expected one of demo, standardised, got 'paper'"),
        ({"candidate_limit": 0}, "candidate_limit: expected at least 1"),
        ({"candidates": np.zeros((0, 3))}, r"candidates: expected shape \(N, 3\)"),
        ({"surface_points": np.zeros((4, 2))}, r"surface_points: expected shape \(N, 3\)"),
        ({"surface_points": np.full((4, 3), np.inf)}, "surface_points: every coordinate must be finite"),
        ({"surface_points": np.ones((4, 3))}, "surface_points: all of them coincide"),
    ],
)
def test_illegal_input_is_named(changes, message):
    surface, inner = random_case(6)
    with pytest.raises(InputError, match=message):
        coverage_axis(**{"surface_points": surface, "candidates": inner, "points": 5, **changes})
