"""Farthest-point sampling weighted by the local feature size, the prior of MS3D; it needs no training.

Amenta and Bern call a set of surface points an epsilon-sample if every point of the surface is nearer to it than
epsilon times its local feature size, the distance to the medial axis. So thin parts are sampled densely and thick ones
sparsely, each just as much as its reconstruction needs. For a given number of points, the set of smallest epsilon
solves a weighted k-centre problem: the largest of all weighted distances to the set is to be small, the weight being
one over the local feature size. It is solved here with the greedy rule of Dyer and Frieze, at most three times worse
than the best set. The medial axis is that of MS3D: its skeletal points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from morphoskel.errors import ConfigError, InputError
from morphoskel.shapes import FloatArray, IntArray


@dataclass(frozen=True)
class LfsSettings:
    """How much thin parts are favoured.

    Parameters
    ----------
    exponent
        Of the local feature size, by which distances are divided: 1, an epsilon-sample; 0, plain farthest points.
    floor
        Least local feature size that counts, in means over the shape; smaller ones are taken for noise of the skeleton.

    Raises
    ------
    ConfigError
        If a value is out of range.
    """

    exponent: float
    floor: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.exponent) and self.exponent >= 0):
            raise ConfigError(f"exponent: expected a number from 0, got {self.exponent}")
        if not (math.isfinite(self.floor) and self.floor > 0):
            raise ConfigError(f"floor: expected a positive number, got {self.floor}")


def lfs_points(points: FloatArray, sizes: FloatArray, count: int, settings: LfsSettings) -> IntArray:
    """Choose points with gaps that are proportional to the local feature size.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite.
    sizes
        ``(N,)`` float64, local feature size of each point, in the unit of `points`.
    count
        Number of points, 1 to N.
    settings
        How much thin parts are favoured.

    Returns
    -------
    IntArray
        As :func:`weighted_farthest_points` with the weights of :func:`lfs_weights`. Where all sizes are equal, and with
        exponent 0, it is plain farthest-point sampling that starts with point 0.

    Raises
    ------
    InputError
        If an array has the wrong shape or an illegal value, or `count` is out of range.

    Notes
    -----
    Amenta and Bern, *Surface Reconstruction by Voronoi Filtering*, Discrete & Computational Geometry 22, 1999,
    section 2. With a floor the local feature size still changes by no more than the way between two points, which is
    all that its theory uses.
    """
    return weighted_farthest_points(points, lfs_weights(sizes, settings), count)


def lfs_weights(sizes: FloatArray, settings: LfsSettings) -> FloatArray:
    """Return a weight for each point, 1 where the shape is thinnest.

    Parameters
    ----------
    sizes
        ``(N,)`` float64, local feature size of each point, in any unit.
    settings
        How much thin parts are favoured.

    Returns
    -------
    FloatArray
        ``(N,)`` float64 in [0, 1]: ``(smallest / size) ** exponent``, sizes below the floor being raised to it.

    Raises
    ------
    InputError
        If there is no size, or one is negative or not finite.
    """
    sizes = _check_values(sizes, "local feature sizes")
    raised = np.maximum(sizes, settings.floor * sizes.mean())
    if not raised.min() > 0:  # the skeleton lies on the points themselves: nothing is thinner than anything else
        return np.ones(len(sizes))
    weights: FloatArray = (raised.min() / raised) ** settings.exponent
    return weights


def weighted_farthest_points(points: FloatArray, weights: FloatArray, count: int) -> IntArray:
    """Choose the point of largest weight, then one by one that of largest weight times distance to those chosen.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite.
    weights
        ``(N,)`` float64, at least 0; a common factor does not matter.
    count
        Number of points, 1 to N.

    Returns
    -------
    IntArray
        ``(count,)`` distinct indices in the order of the choice, so that any first part of them is the answer for a
        smaller count. Of equals the one with the smallest index is taken. With equal weights it is
        :func:`~morphoskel.skeleton.thinning.farthest_points` from point 0.

    Raises
    ------
    InputError
        If an array has the wrong shape or an illegal value, or `count` is out of range.

    Notes
    -----
    Dyer and Frieze, *A Simple Heuristic for the p-Centre Problem*, Operations Research Letters 3(6), 1985: the largest
    weighted distance of a point to the chosen ones is at most ``min(3, 1 + largest / smallest weight)`` times what the
    best choice of as many points reaches. The time is proportional to N times `count`.
    """
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise InputError(f"points: expected finite values of shape (N, 3), got shape {points.shape}")
    weights = _check_values(weights, "weights")
    if len(weights) != len(points):
        raise InputError(f"weights: expected {len(points)}, one a point, got {len(weights)}")
    if not 1 <= count <= len(points):
        raise InputError(f"count: expected 1 to {len(points)}, the number of points, got {count}")
    x, y, z = np.ascontiguousarray(points.T)
    squared_weights = (weights / (weights.max() or 1)) ** 2
    # Squares, summed in one order: the same numbers on every machine.
    gaps = np.full(len(points), np.inf)
    chosen = np.empty(count, dtype=np.int64)
    chosen[0] = weights.argmax()
    for step in range(1, count):
        last = chosen[step - 1]
        dx, dy, dz = x - x[last], y - y[last], z - z[last]
        np.minimum(gaps, squared_weights * (dx * dx + dy * dy + dz * dz), out=gaps)
        gaps[last] = -1  # never again, also where points coincide
        chosen[step] = gaps.argmax()
    return chosen


def _check_values(values: FloatArray, what: str) -> FloatArray:
    values = np.asarray(values, dtype=np.float64)
    if values.ndim != 1 or len(values) == 0:
        raise InputError(f"{what}: expected shape (N,) with N >= 1, got {values.shape}")
    if not np.isfinite(values).all() or (values < 0).any():
        raise InputError(f"{what}: every value must be finite and at least 0")
    return values
