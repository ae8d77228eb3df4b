import numpy as np
import open3d
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import random_rotation

from morphoskel.errors import InputError
from morphoskel.morphology import dilation


def cloud(count, seed=0):
    generator = np.random.default_rng(seed)
    return generator.random((count, 3), dtype=np.float32), generator.random(count, dtype=np.float32)


def dilation_naive(points, values, k):
    """All pairs of distances, sorted."""
    points = points.astype(np.float64)
    distances = ((points[:, None] - points[None]) ** 2).sum(axis=-1)
    return values[np.argsort(distances, axis=1)[:, :k]].max(axis=1)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 80), st.integers(1, 30))
def test_equals_the_naive_twin(seed, count, k):
    points, values = cloud(count, seed)
    assert np.array_equal(dilation(points, values, k), dilation_naive(points, values, k))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 30))
def test_lies_between_identity_and_maximum_and_is_monotone(seed, k):
    points, values = cloud(200, seed)
    dilated = dilation(points, values, k)
    assert (dilated >= values).all()
    assert dilated.max() == values.max()
    assert (dilation(points, values + 0.5, k) == dilated + 0.5).sum() > 190  # commutes with constants, to rounding
    assert (dilation(points, np.maximum(values, 0.5), k) >= dilated).all()
    assert (dilation(points, values, k + 1) >= dilated).all()


def test_k_of_one_is_the_identity_and_k_of_all_is_the_maximum():
    points, values = cloud(50)
    assert np.array_equal(dilation(points, values, 1), values)
    assert (dilation(points, values, 50) == values.max()).all()
    assert (dilation(points, values, 500) == values.max()).all()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_agrees_with_open3d_on_many_points(dtype):
    """In float32, as in the published program, two neighbours may be equally far to the last bit."""
    points, values = cloud(70_000)
    search = open3d.core.nns.NearestNeighborSearch(open3d.core.Tensor(points.astype(dtype)))
    search.knn_index()
    neighbours, _ = search.knn_search(open3d.core.Tensor(points.astype(dtype)), 20)
    assert (dilation(points, values, 20) != values[neighbours.numpy()].max(axis=1)).sum() <= 3


def test_order_motion_and_threads_do_not_matter():
    points, values = cloud(3000)
    dilated = dilation(points, values)
    order = np.random.default_rng(1).permutation(3000)
    assert np.array_equal(dilation(points[order], values[order]), dilated[order])
    assert np.array_equal(dilation(points, values, threads=2), dilated)
    moved = (points.astype(np.float64) @ random_rotation(2).T + 3).astype(np.float32)
    assert (dilation(moved, values) != dilated).mean() < 0.001  # rounding can swap two almost equally far neighbours


def test_coincident_points_share_the_largest_value():
    """All are equally far, so all belong to the structuring element, however small `k` is."""
    points = np.zeros((40, 3), dtype=np.float32)
    values = np.arange(40, dtype=np.float32)
    assert (dilation(points, values, 3) == 39).all()


def test_nothing_to_dilate():
    assert dilation(np.zeros((0, 3), dtype=np.float32), np.zeros(0, dtype=np.float32)).shape == (0,)


@pytest.mark.parametrize(("values", "k"), [(np.zeros(4), 3), (np.zeros(5), 0)])
def test_illegal_arguments(values, k):
    with pytest.raises(InputError, match="structuring element"):
        dilation(np.zeros((5, 3), dtype=np.float32), values.astype(np.float32), k)
