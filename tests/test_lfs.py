import time
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from solids import random_rotation, sphere_cloud

from morphoskel.errors import ConfigError, InputError
from morphoskel.sampling.lfs import LfsSettings, lfs_points, lfs_weights, weighted_farthest_points
from morphoskel.skeleton.thinning import farthest_points

EPSILON_SAMPLE = LfsSettings(exponent=1.0, floor=0.1)


def weighted_farthest_naive(points, weights, count):
    """Measure all distances again for each choice; ties go to the smallest index not yet chosen."""
    weights = weights / weights.max()
    chosen = [list(weights).index(max(weights))]
    while len(chosen) < count:
        left = [index for index in range(len(points)) if index not in chosen]
        gaps = [min(weights[i] ** 2 * ((points[i] - points[other]) ** 2).sum() for other in chosen) for i in left]
        chosen.append(left[gaps.index(max(gaps))])
    return chosen


def reach(points, weights, chosen):
    """Largest weighted distance of a point to the chosen ones."""
    return (weights[:, None] * cdist(points, points[chosen])).min(axis=1).max()


def dumbbell(count, rod=0.1, seed=0):
    """Two balls of radius 1 joined by a thin rod of length 2, points uniform by area, with the distance to the axis."""
    generator = np.random.default_rng(seed)
    areas = np.array([4 * np.pi, 4 * np.pi, 4 * np.pi * rod])
    part = generator.choice(3, size=count, p=areas / areas.sum())
    points = sphere_cloud(count, seed).points + np.array([-2.0, 2.0, 0.0])[part, None] * [1, 0, 0]
    angle, height = generator.uniform(0, 2 * np.pi, count), generator.uniform(-1, 1, count)
    on_rod = part == 2
    points[on_rod] = np.stack([height, rod * np.cos(angle), rod * np.sin(angle)], axis=1)[on_rod]
    return points, np.where(on_rod, rod, 1.0), on_rod


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 25), st.data())
def test_equals_the_naive_twin_also_among_ties_and_duplicates(seed, size, data):
    generator = np.random.default_rng(seed)
    points = generator.integers(0, 4, (size, 3)).astype(np.float64)
    weights = 2.0 ** generator.integers(-2, 3, size)  # exact products, many ties
    count = data.draw(st.integers(1, size))
    chosen = weighted_farthest_points(points, weights, count)
    assert chosen.tolist() == weighted_farthest_naive(points, weights, count)
    assert len({*chosen.tolist()}) == count
    assert weighted_farthest_points(points, 3 * weights, count).tolist() == chosen.tolist()


def test_with_equal_weights_it_is_farthest_point_sampling():
    points = np.random.default_rng(1).normal(size=(300, 3))
    plain = farthest_points(points, 60).tolist()
    assert weighted_farthest_points(points, np.full(300, 0.3), 60).tolist() == plain
    assert lfs_points(points, np.full(300, 2.0), 60, EPSILON_SAMPLE).tolist() == plain
    assert lfs_points(points, np.zeros(300), 60, EPSILON_SAMPLE).tolist() == plain
    sizes = np.random.default_rng(2).uniform(0.1, 1, 300)
    assert lfs_points(points, sizes, 60, LfsSettings(exponent=0.0, floor=0.1)).tolist() == plain
    assert lfs_points(points, sizes, 60, LfsSettings(exponent=1.0, floor=50.0)).tolist() == plain


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 9), st.data())
def test_it_is_no_worse_than_dyer_and_frieze_prove(seed, size, data):
    generator = np.random.default_rng(seed)
    points, weights = generator.normal(size=(size, 3)), generator.uniform(0.05, 1, size)
    count = data.draw(st.integers(1, size - 1))
    best = min(reach(points, weights, list(chosen)) for chosen in combinations(range(size), count))
    found = reach(points, weights, weighted_farthest_points(points, weights, count))
    assert found <= min(3, 1 + weights.max() / weights.min()) * best * (1 + 1e-12)


def test_a_smaller_choice_begins_a_larger_one():
    points, sizes, _ = dumbbell(800)
    large = lfs_points(points, sizes, 200, EPSILON_SAMPLE)
    assert lfs_points(points, sizes, 70, EPSILON_SAMPLE).tolist() == large[:70].tolist()


def test_thin_parts_get_more_points_and_a_smaller_epsilon():
    points, sizes, on_rod = dumbbell(6000)
    plain, weighted = farthest_points(points, 128), lfs_points(points, sizes, 128, EPSILON_SAMPLE)
    assert on_rod[weighted].mean() > 2 * on_rod[plain].mean() > 4 * on_rod.mean() / 3
    shares = 0.4 * np.pi / 0.1**2, 8 * np.pi  # areas of the rod and the balls, over squared local feature sizes
    assert on_rod[weighted].mean() == pytest.approx(shares[0] / sum(shares), abs=0.08)
    assert reach(points, 1 / sizes, weighted) < 0.6 * reach(points, 1 / sizes, plain)
    halfway = lfs_points(points, sizes, 128, LfsSettings(exponent=0.5, floor=0.1))
    assert on_rod[plain].mean() < on_rod[halfway].mean() < on_rod[weighted].mean()


def test_similar_parts_get_equally_many_points_whatever_their_size():
    small, large = sphere_cloud(4000, 1).points, sphere_cloud(4000, 2).points
    points = np.vstack([0.2 * small + [10, 0, 0], large])
    sizes = np.repeat([0.2, 1.0], 4000)
    assert (lfs_points(points, sizes, 200, EPSILON_SAMPLE) < 4000).sum() == pytest.approx(100, abs=8)
    assert (farthest_points(points, 200) < 4000).sum() < 20  # by area it would be 1 to 25


def test_it_moves_with_the_shape():
    points, sizes, _ = dumbbell(1500)
    sizes = sizes * np.random.default_rng(4).uniform(0.9, 1.1, len(sizes))
    chosen = lfs_points(points, sizes, 100, EPSILON_SAMPLE).tolist()
    moved = 7 * points @ random_rotation(3).T + [3, -2, 1]
    assert lfs_points(moved, 7 * sizes, 100, EPSILON_SAMPLE).tolist() == chosen
    order = np.random.default_rng(5).permutation(len(points))
    assert order[lfs_points(points[order], sizes[order], 100, EPSILON_SAMPLE)].tolist() == chosen


def test_weights_follow_the_formula():
    sizes = np.array([0.0, 0.1, 1.0, 2.9])  # the mean is 1, so the floor is 0.1
    assert lfs_weights(sizes, EPSILON_SAMPLE) == pytest.approx([1, 1, 0.1, 0.1 / 2.9])
    assert lfs_weights(sizes, LfsSettings(exponent=2.0, floor=0.1)) == pytest.approx([1, 1, 0.01, (0.1 / 2.9) ** 2])
    assert lfs_weights(5 * sizes, EPSILON_SAMPLE) == pytest.approx(lfs_weights(sizes, EPSILON_SAMPLE))


def test_ten_thousand_points_take_well_under_a_second():
    points, sizes, _ = dumbbell(10_000)
    start = time.perf_counter()
    lfs_points(points, sizes, 1024, EPSILON_SAMPLE)
    assert time.perf_counter() - start < 5  # 0.2 s on an idle machine; the margin is for a busy one


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: weighted_farthest_points(np.zeros((3, 2)), np.ones(3), 1), r"points: .*shape \(N, 3\)"),
        (lambda: weighted_farthest_points(np.full((3, 3), np.nan), np.ones(3), 1), "points: expected finite"),
        (lambda: weighted_farthest_points(np.zeros((3, 3)), np.ones(2), 1), "weights: expected 3, one a point, got 2"),
        (lambda: weighted_farthest_points(np.zeros((3, 3)), np.array([1, -1, 1]), 1), "weights: .*at least 0"),
        (lambda: weighted_farthest_points(np.zeros((3, 3)), np.ones(3), 4), "count: expected 1 to 3"),
        (lambda: weighted_farthest_points(np.zeros((3, 3)), np.ones(3), 0), "count: expected 1 to 3"),
        (lambda: lfs_weights(np.array([1, np.inf]), EPSILON_SAMPLE), "local feature sizes: every value must be finite"),
        (lambda: lfs_weights(np.empty(0), EPSILON_SAMPLE), r"local feature sizes: expected shape \(N,\)"),
    ],
)
def test_illegal_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()


@pytest.mark.parametrize(
    ("values", "message"),
    [((-1, 0.1), "exponent"), ((np.nan, 0.1), "exponent"), ((1, 0), "floor"), ((1, np.inf), "floor")],
)
def test_illegal_settings_are_named(values, message):
    with pytest.raises(ConfigError, match=f"{message}: expected"):
        LfsSettings(*values)
