"""The neighbourhoods themselves; what is done over them is tested by operation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.errors import InputError
from morphoskel.morphology.structuring_element import StructuringElement


def belongs_naive(points, k):
    """``(N, N)`` bool: whether the second point belongs to the structuring element of the first."""
    offsets = points[:, None] - points[None]
    squares = offsets[..., 0] ** 2 + offsets[..., 1] ** 2 + offsets[..., 2] ** 2  # in float32, in this order
    radii = np.sort(squares, axis=1)[:, min(k, len(points)) - 1]
    return squares <= radii[:, None]


def cloud(kind, count, seed):
    generator = np.random.default_rng(seed)
    points = generator.normal(size=(count, 3))
    if kind == "lattice":  # ties everywhere, and coincident points
        points = generator.integers(0, 4, (count, 3))
    elif kind == "plane":
        points[:, seed % 3] = 0.5
    elif kind == "line":
        points[:, [seed % 3, (seed + 1) % 3]] = 2
    elif kind == "clusters":
        points = points * 0.001 + generator.integers(0, 2, (count, 1)) * 50
    elif kind == "coincident":
        points[:] = 1
    return points.astype(np.float32)


KINDS = ["normal", "lattice", "plane", "line", "clusters", "coincident"]


@settings(max_examples=80, deadline=None)
@given(st.sampled_from(KINDS), st.integers(1, 150), st.integers(1, 60), st.integers(0, 1000))
def test_every_operation_equals_its_naive_twin(kind, count, k, seed):
    points = cloud(kind, count, seed)
    values = np.random.default_rng(seed).normal(size=count).astype(np.float32)
    belongs, element = belongs_naive(points, k), StructuringElement(points, k)
    assert np.array_equal(element.dilate(values), np.where(belongs, values, -np.inf).max(axis=1))
    assert np.array_equal(element.erode(values), np.where(belongs, values, np.inf).min(axis=1))
    assert np.array_equal(element.spread(values), np.where(belongs.T, values, -np.inf).max(axis=1))


@pytest.mark.parametrize("kind", ["normal", "lattice", "clusters"])
def test_many_points_equal_the_naive_twin_in_any_order_and_with_any_threads(kind):
    points = cloud(kind, 3000, 5)
    values = np.random.default_rng(1).normal(size=3000).astype(np.float32)
    expected = np.where(belongs_naive(points, 20), values, -np.inf).max(axis=1)
    order = np.random.default_rng(2).permutation(3000)
    assert np.array_equal(StructuringElement(points).dilate(values), expected)
    assert np.array_equal(StructuringElement(points[order], threads=2).dilate(values[order]), expected[order])
    spread = StructuringElement(points).spread(values)
    assert np.array_equal(StructuringElement(points[order], threads=2).spread(values[order]), spread[order])


def test_a_thin_shell_in_a_large_box_gets_small_cells():
    """Cells made for the box, not for the points, would each hold a thousand of them."""
    directions = np.random.default_rng(0).normal(size=(100_000, 3))
    shell = (directions / np.linalg.norm(directions, axis=1, keepdims=True)).astype(np.float32)
    assert np.diff(StructuringElement(shell)._starts).max() < 60


def test_adjunction():
    """A function spread stays below another exactly where it stays below the other's erosion."""
    points = cloud("normal", 300, 3)
    element, generator = StructuringElement(points, 12), np.random.default_rng(4)
    for shift in (-3, 0, 3):
        f, g = (generator.normal(size=300).astype(np.float32) for _ in range(2))
        f += shift
        assert (element.spread(f) <= g).all() == (f <= element.erode(g)).all()


def test_no_points():
    element = StructuringElement(np.zeros((0, 3), dtype=np.float32))
    nothing = np.zeros(0, dtype=np.float32)
    assert len(element) == len(element.dilate(nothing)) == len(element.spread(nothing)) == 0


@pytest.mark.parametrize(
    ("points", "k", "values", "message"),
    [
        (np.zeros((5, 2)), 3, 5, r"points \(N, 3\)"),
        (np.full((5, 3), np.nan), 3, 5, "NaN or infinite"),
        (np.array([[0, 0, np.inf]] * 5), 3, 5, "NaN or infinite"),
        (np.zeros((5, 3)), 0, 5, "k = 0"),
        (np.zeros((5, 3)), 3, 4, "expected 5 values"),
    ],
)
def test_illegal_arguments(points, k, values, message):
    with pytest.raises(InputError, match=message):
        StructuringElement(points.astype(np.float32), k).dilate(np.zeros(values, dtype=np.float32))


def test_values_that_are_no_numbers_are_refused():
    with pytest.raises(InputError, match="NaN"):
        StructuringElement(np.zeros((2, 3), dtype=np.float32)).dilate(np.array([0, np.nan], dtype=np.float32))
