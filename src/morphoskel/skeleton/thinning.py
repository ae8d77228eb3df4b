"""Thin a dense set of points evenly: farthest-point sampling."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice, takewhile

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray


def farthest_points(points: FloatArray, count: int, first: int = 0) -> IntArray:
    """Choose points one by one, each the farthest from all that were chosen before.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite.
    count
        Number of points, 1 to N.
    first
        Index of the point to start with.

    Returns
    -------
    IntArray
        ``(count,)`` distinct indices in the order of the choice, so that any first part of them is the answer for a
        smaller count. Of equally far points the one with the smallest index is taken.

    Raises
    ------
    InputError
        If `points` has the wrong shape, or `count` or `first` is out of range.

    Notes
    -----
    Gonzalez, *Clustering to Minimize the Maximum Intercluster Distance*, Theoretical Computer Science 38, 1985: no
    point is farther from the chosen ones than twice what the best choice of as many points reaches.
    """
    points = _check(points, first)
    if not 1 <= count <= len(points):
        raise InputError(f"count: expected 1 to {len(points)}, the number of points, got {count}")
    return np.array([index for index, _ in islice(_walk(points, first), count)], dtype=np.int64)


def separated_points(points: FloatArray, smallest_gap: float, *, limit: int, first: int = 0) -> IntArray:
    """Choose points as :func:`farthest_points` does, as long as they keep apart from each other.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite.
    smallest_gap
        Distance that all chosen points keep from each other, in the unit of `points`.
    limit
        Largest number of points, at least 1.
    first
        Index of the point to start with.

    Returns
    -------
    IntArray
        At most `limit` distinct indices. If they are fewer, every point is nearer than `smallest_gap` to one of them.

    Raises
    ------
    InputError
        If `points` has the wrong shape, or `limit` or `first` is out of range.
    """
    points = _check(points, first)
    if limit < 1:
        raise InputError(f"limit: expected at least 1 point, got {limit}")
    apart = takewhile(lambda step: step[1] >= smallest_gap, _walk(points, first))
    return np.array([index for index, _ in islice(apart, limit)], dtype=np.int64)


def _walk(points: FloatArray, first: int) -> Iterator[tuple[int, float]]:
    """Yield all indices in the order of the choice, each with its distance to those before, infinite for the first."""
    x, y, z = np.ascontiguousarray(points.T)
    # Squares, summed in one order: the same numbers on every machine.
    squared = np.full(len(points), np.inf)
    index, gap = first, np.inf
    for _ in range(len(points)):
        yield index, float(np.sqrt(gap))
        dx, dy, dz = x - x[index], y - y[index], z - z[index]
        np.minimum(squared, dx * dx + dy * dy + dz * dz, out=squared)
        squared[index] = -1  # never again, also where points coincide
        index = int(squared.argmax())
        gap = squared[index]


def _check(points: FloatArray, first: int) -> FloatArray:
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) == 0:
        raise InputError(f"points: expected shape (N, 3) with N >= 1, got {points.shape}")
    if not np.isfinite(points).all():
        raise InputError("points: every coordinate must be finite")
    if not 0 <= first < len(points):
        raise InputError(f"first: expected an index from 0 to {len(points) - 1}, got {first}")
    return points
