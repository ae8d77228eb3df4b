from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from morphoskel.errors import ConfigError, InputError
from morphoskel.sampling.prior import (
    PriorSettings,
    local_feature_size,
    prior_weights,
    shuffled_weights,
    uniform_weights,
)

PUBLISHED = PriorSettings(bins=6, sharpness=1.0)
UNIT = arrays(np.float64, st.integers(1, 40), elements=st.floats(0, 1))


def naive_weights(distances, settings, lowered=0.1):
    """Weigh points one by one, with the first edge lowered as in the released program instead of a clamped index."""
    low, high = min(distances), max(distances)
    edges = [low + (high - low) * number / settings.bins for number in range(settings.bins + 1)]
    edges[-1] = high
    raw = [np.exp(-settings.sharpness * (a + b) / 2) for a, b in pairwise(edges)]
    edges[0] -= lowered
    weights = []
    for distance in distances:
        (found, *_) = [n for n in range(settings.bins) if edges[n] < distance <= edges[n + 1]]
        weights.append(raw[found] / sum(raw))
    return np.array(weights)


def test_the_distance_to_the_nearest_skeletal_point():
    generator = np.random.default_rng(0)
    points, skeleton = generator.normal(size=(50, 3)), generator.normal(size=(7, 3))
    naive = [min(np.linalg.norm(point - centre) for centre in skeleton) for point in points]
    np.testing.assert_allclose(local_feature_size(points, skeleton), naive)
    assert local_feature_size(skeleton, skeleton).max() == 0


@pytest.mark.parametrize("sharpness", [0.0, 1.0, 7.5])
@pytest.mark.parametrize("bins", [1, 3, 6])
def test_weights_are_those_of_the_naive_twin(bins, sharpness):
    distances = np.random.default_rng(bins).gamma(2, 0.1, size=200)
    settings = PriorSettings(bins, sharpness)
    np.testing.assert_allclose(prior_weights(distances, settings), naive_weights(distances, settings))


def test_a_distance_on_an_edge_belongs_to_the_nearer_bin():
    weights = prior_weights(np.arange(7.0), PUBLISHED)
    assert weights[0] == weights[1]
    assert len(np.unique(weights[1:])) == 6


@given(UNIT)
@example(np.array([0.1, 0.1 + 2e-17, 0.1 + 3e-17, 0.7 + 1e-16]))
@example(np.array([np.nextafter(0.5, 0), 0.5, np.nextafter(0.5, 1)]))
def test_weights_fall_with_the_distance_and_stay_near_a_sixth(distances):
    """Also that no index is out of range, whatever rounding does to the edges."""
    weights = prior_weights(distances, PUBLISHED)
    assert (np.diff(weights[np.argsort(distances)]) <= 0).all()
    assert (weights > 0.1).all()
    assert (weights < 0.25).all()


def test_the_weights_of_the_bins_sum_to_one():
    inside = np.linspace(0.3, 0.9, 7)[1:] - 0.01  # one distance in every bin
    weights = prior_weights(np.concatenate([[0.3], inside, [0.9]]), PUBLISHED)
    assert len(np.unique(weights)) == 6
    assert np.unique(weights).sum() == pytest.approx(1)
    # Published example: thin parts at 0.02 and thick ones at 0.4 have weights of about 0.20 and 0.137.
    ends = prior_weights(np.array([0.02 - 0.038, 0.4 + 0.038]), PUBLISHED)
    np.testing.assert_allclose(ends, (0.200, 0.137), atol=5e-4)


@pytest.mark.parametrize("value", [0.0, 0.1, 1 / 3, 1e-300, 1e6])
def test_equal_distances_weigh_the_same(value):
    np.testing.assert_allclose(prior_weights(np.full(9, value), PUBLISHED), 1 / 6)


def test_a_larger_sharpness_tells_thin_from_thick_more_strongly():
    distances = np.linspace(0.05, 0.4, 100)
    ratios = [np.divide(*prior_weights(distances, PriorSettings(6, sharpness))[[0, -1]]) for sharpness in (0, 1, 10)]
    assert ratios[0] == 1
    assert 1 < ratios[1] < 1.5
    assert ratios[2] == pytest.approx(ratios[1] ** 10)
    assert np.isfinite(prior_weights(np.array([0, 1e5]), PUBLISHED)).all()


def test_the_controls_have_no_skeleton():
    weights = prior_weights(np.linspace(0, 1, 60), PUBLISHED)
    shuffled = shuffled_weights(weights, np.random.default_rng(3))
    assert sorted(shuffled) == sorted(weights)
    assert not np.array_equal(shuffled, weights)
    np.testing.assert_array_equal(shuffled, shuffled_weights(weights, np.random.default_rng(3)))
    np.testing.assert_array_equal(uniform_weights(5, PUBLISHED), prior_weights(np.ones(5), PUBLISHED))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_refused(bad):
    with pytest.raises(InputError, match=r"1 of 3 are NaN or infinite, the first is that of point 1"):
        prior_weights(np.array([0, bad, 1]), PUBLISHED)
    rows = np.array([[0, 0, 0], [0, bad, 0]])
    with pytest.raises(InputError, match=r"skeleton: 1 rows hold NaN or infinite values, the first is row 1"):
        local_feature_size(np.zeros((2, 3)), rows)
    with pytest.raises(InputError, match="points: 1 rows"):
        local_feature_size(rows, np.zeros((2, 3)))


def test_what_is_no_cloud_or_setting_is_refused():
    with pytest.raises(InputError, match="it has no point"):
        local_feature_size(np.zeros((2, 3)), np.zeros((0, 3)))
    with pytest.raises(InputError, match=r"points: expected shape \(N, 3\)"):
        local_feature_size(np.zeros((2, 2)), np.zeros((1, 3)))
    for empty in (np.zeros(0), np.zeros((2, 1))):
        with pytest.raises(InputError, match=r"expected shape \(N,\) with N >= 1"):
            prior_weights(empty, PUBLISHED)
    with pytest.raises(ConfigError, match="bins: expected at least 1"):
        PriorSettings(0, 1.0)
    for sharpness in (-1.0, np.nan, np.inf):
        with pytest.raises(ConfigError, match="sharpness"):
            PriorSettings(6, sharpness)
