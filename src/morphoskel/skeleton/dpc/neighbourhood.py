"""Neighbours on the surface, and how much they count."""

from __future__ import annotations

import numpy as np

from morphoskel.shapes import FloatArray, IntArray


def mean_spacing(points: FloatArray) -> float:
    """Return the mean distance from a point to the nearest other point, the unit of all lengths of the method.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, at least two of them distinct. Of coinciding points one is counted.

    Returns
    -------
    float
        Greater than 0, in the shape's units.
    """
    from scipy.spatial import cKDTree

    distinct = np.unique(points, axis=0)
    distances = np.asarray(cKDTree(distinct).query(distinct, k=2)[0])
    return float(distances[:, 1].mean())


def neighbour_pairs(points: FloatArray, radius: float) -> tuple[IntArray, IntArray]:
    """List the pairs of points that are at most `radius` apart, both ways round.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.
    radius
        In the same units.

    Returns
    -------
    first, second
        ``(E,)`` int64 indices, sorted; no point is paired with itself.
    """
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(radius, output_type="ndarray").astype(np.int64)
    both = np.vstack([pairs, pairs[:, ::-1]])
    both = both[np.lexsort((both[:, 1], both[:, 0]))]
    return both[:, 0], both[:, 1]


def proximity(distances: FloatArray, radius: float) -> FloatArray:
    """Return ``exp(-4 d² / radius²)``, the weight that the released program gives to a distance."""
    weights: FloatArray = np.exp(-4.0 * (distances / radius) ** 2)
    return weights
