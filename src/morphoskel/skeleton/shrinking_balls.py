"""Maximal balls by shrinking: for each oriented surface point the inner ball that touches the surface there and again.

Sources: Ma, Bae and Choi, *3D medial axis point approximation using nearest neighbors and the normal field*, The Visual
Computer 28, 2012; Peters, *Geographical point cloud modelling with the 3D medial axis transform*, doctoral thesis,
TU Delft, 2018, on noise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray

LEAF_POINTS = 8
ROUNDS = 100
"""Shrinking steps after which a ball counts as done; a handful is usual."""
ROUNDING = 1e-9
"""Share of the radius by which a point must lie inside a ball to count as inside, beyond rounding errors."""
UNIT_LENGTH = 1e-4
"""By how much the length of a normal may differ from 1; files round their normals."""


@dataclass(frozen=True, eq=False)
class TouchingBalls:
    """Balls that touch a surface at two points.

    Parameters
    ----------
    first, second
        ``(M,)`` int64, indices of the two surface points that a ball touches. Its centre lies on the inward normal
        of the first.
    centres
        ``(M, 3)`` float64.
    radii
        ``(M,)`` float64.
    chords
        ``(M,)`` float64, distance between the two touching points.
    separation_angles
        ``(M,)`` float64 in degrees, 0 to 180: the angle at the centre between the two touching points.
    """

    first: IntArray
    second: IntArray
    centres: FloatArray
    radii: FloatArray
    chords: FloatArray
    separation_angles: FloatArray


def shrink_balls(points: FloatArray, normals: FloatArray, *, tolerance: float = 0.02) -> TouchingBalls:
    """Return the inner maximal balls of a closed surface that is given by dense, oriented samples.

    A large ball touches the surface point from inside. As long as other surface points lie in it, it shrinks until it
    goes through the one that was nearest to its centre (Ma et al., section 3). A ball that touches two points is done
    as soon as no point lies deeper in it than a small share of its radius.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite, at least two of them distinct.
    normals
        ``(N, 3)`` float64, outward, unit length.
    tolerance
        Share of the radius, 0 to below 1. With 0 a ball shrinks until it is empty.

    Returns
    -------
    TouchingBalls
        At most one ball a point, in the order of the points. A point from which not even the first ball, half the
        diagonal of the bounding box in radius, reaches another point has none: the surface is open there, or the
        normal points inward.

    Raises
    ------
    InputError
        If an array has the wrong shape, a value is not finite, a normal has another length than 1, all points
        coincide, or `tolerance` is out of range.

    Notes
    -----
    Where a normal is off by the angle a and the surface around its point is flat, neighbours stand up to a above the
    supposed tangent plane, enter the ball, and would make it collapse on them. They lie no deeper than the share
    ``1 - cos(a)`` of the radius, so 2 % forgive 11 degrees. Peters forgives by the separation angle that a step would
    leave, which is twice the angle above the tangent plane; for neighbours that comes to the same. On round parts,
    which touch their ball all around, depth is the better rule: the point that is nearest by a hair says nothing about
    how far apart the touching points are, and must not take the place of one at the opposite side.
    """
    from morphoskel.skeleton.shrinking_ball_kernels import build_tree, shrink

    points, normals = _check(points, normals, tolerance)
    depth = max(int(np.ceil(np.log2(len(points) / LEAF_POINTS))), 0)
    order = np.arange(len(points))
    ranges = np.zeros((2 ** (depth + 1), 2), dtype=np.int64)
    boxes = np.zeros((2 ** (depth + 1), 2, 3))
    build_tree(points, depth, order, ranges, boxes)
    # An inner ball lies in the bounding box, so its radius is less than half the diagonal.
    radii = np.full(len(points), np.linalg.norm(np.ptp(points, axis=0)) / 2)
    second = np.full(len(points), -1, dtype=np.int64)
    shrink(points, normals, order, ranges, boxes, ROUNDS, ROUNDING, max(tolerance, ROUNDING), radii, second)
    return _touching_balls(points, normals, radii, second)


def _touching_balls(points: FloatArray, normals: FloatArray, radii: FloatArray, second: IntArray) -> TouchingBalls:
    """Return the balls of those points that have a second touching point."""
    first = np.flatnonzero(second >= 0)
    second, radii = second[first], radii[first]
    chords = np.linalg.norm(points[first] - points[second], axis=1)
    halves = np.arcsin(np.clip(chords / (2 * radii), 0, 1))
    return TouchingBalls(
        first, second, points[first] - radii[:, None] * normals[first], radii, chords, np.degrees(2 * halves)
    )


def _check(points: FloatArray, normals: FloatArray, tolerance: float) -> tuple[FloatArray, FloatArray]:
    """Return both as contiguous arrays, or say what is wrong with them."""
    points, normals = (np.ascontiguousarray(rows, dtype=np.float64) for rows in (points, normals))
    for name, rows in (("points", points), ("normals", normals)):
        if rows.ndim != 2 or rows.shape[1] != 3 or len(rows) == 0:
            raise InputError(f"{name}: expected shape (N, 3) with N >= 1, got {rows.shape}")
        if not np.isfinite(rows).all():
            raise InputError(f"{name}: every value must be finite")
    if len(normals) != len(points):
        raise InputError(f"normals: expected {len(points)} rows, one a point, got {len(normals)}")
    lengths = np.linalg.norm(normals, axis=1)
    bad = np.flatnonzero(np.abs(lengths - 1) > UNIT_LENGTH)
    if len(bad):
        raise InputError(
            f"normals: {len(bad)} of {len(normals)} have another length than 1, the first is row {bad[0]} with "
            f"{lengths[bad[0]]:.6g}; complete the unknown ones and scale them"
        )
    if (points == points[0]).all():
        raise InputError("points: all of them coincide; samples of a surface are needed")
    if not 0 <= tolerance < 1:
        raise InputError(f"tolerance: expected a share of the radius from 0 to below 1, got {tolerance:g}")
    return points, normals
