import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist

from morphoskel.errors import InputError
from morphoskel.skeleton.thinning import farthest_points, separated_points


def farthest_naive(points, count, first):
    """Measure all distances again for each choice; ties go to the smallest index not yet chosen."""
    chosen = [first]
    while len(chosen) < count:
        left = [index for index in range(len(points)) if index not in chosen]
        gaps = [min(((points[index] - points[other]) ** 2).sum() for other in chosen) for index in left]
        chosen.append(left[gaps.index(max(gaps))])
    return chosen


def some_points(seed, size):
    """Points on a coarse grid: many ties and duplicates, and distances that are exact."""
    return np.random.default_rng(seed).integers(0, 4, (size, 3)).astype(np.float64)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 25), st.data())
def test_equals_the_naive_twin_also_among_ties_and_duplicates(seed, size, data):
    points = some_points(seed, size)
    count, first = data.draw(st.integers(1, size)), data.draw(st.integers(0, size - 1))
    chosen = farthest_points(points, count, first)
    assert chosen.tolist() == farthest_naive(points, count, first)
    assert len({*chosen.tolist()}) == count


def test_the_chosen_points_are_apart_and_cover_the_rest():
    points = np.random.default_rng(3).normal(size=(500, 3))
    chosen = farthest_points(points, 40)
    gaps = cdist(points[chosen], points[chosen]) + np.diag(np.full(40, np.inf))
    reach = cdist(points, points[chosen]).min(axis=1).max()
    assert gaps.min() >= reach  # the next point would be `reach` away, and gaps never grow
    assert farthest_points(points, 39).tolist() == chosen[:39].tolist()


@pytest.mark.parametrize("smallest_gap", [0.2, 0.5, 1.5])
def test_points_keep_apart_and_leave_nothing_uncovered(smallest_gap):
    points = np.random.default_rng(4).normal(size=(400, 3))
    chosen = separated_points(points, smallest_gap, limit=400, first=7)
    assert chosen[0] == 7
    assert 1 < len(chosen) < 400
    gaps = cdist(points[chosen], points[chosen]) + np.diag(np.full(len(chosen), np.inf))
    assert gaps.min() >= smallest_gap
    assert cdist(points, points[chosen]).min(axis=1).max() < smallest_gap
    assert separated_points(points, smallest_gap, limit=5, first=7).tolist() == chosen[:5].tolist()
    assert farthest_points(points, len(chosen), 7).tolist() == chosen.tolist()


def test_ten_thousand_points_take_well_under_a_second():
    points = np.random.default_rng(5).normal(size=(10_000, 3))
    start = time.perf_counter()
    farthest_points(points, 1024)
    assert time.perf_counter() - start < 5  # 0.2 s on an idle machine; the margin is for a busy one


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: farthest_points(np.zeros((3, 2)), 1), r"points: expected shape \(N, 3\)"),
        (lambda: farthest_points(np.zeros((0, 3)), 1), r"got \(0, 3\)"),
        (lambda: farthest_points(np.full((3, 3), np.nan), 1), "finite"),
        (lambda: farthest_points(np.zeros((3, 3)), 4), "count: expected 1 to 3"),
        (lambda: farthest_points(np.zeros((3, 3)), 0), "count: expected 1 to 3"),
        (lambda: farthest_points(np.zeros((3, 3)), 1, 3), "first: expected an index from 0 to 2, got 3"),
        (lambda: separated_points(np.zeros((3, 3)), 1.0, limit=0), "limit: expected at least 1"),
    ],
)
def test_illegal_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
