"""Coverage Axis++: few balls that cover the surface, chosen greedily among inner points.

Source: Wang et al., *Coverage Axis++: Efficient Inner Point Selection for 3D Shape Skeletonization*, Symposium on
Geometry Processing, 2024, and the program released with it.
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from morphoskel.errors import InputError, ShapeError
from morphoskel.shapes import FloatArray, Skeleton

Penalty = Literal["demo", "standardised"]
"""How small balls are put at a disadvantage."""

DEMO_WEIGHT = 0.1
"""Weight of the released demonstrations' penalty."""

SMALLEST_RADIUS = 1e-6
"""Candidates nearer to the surface than this, at unit scale, lie on it and are no centres of balls."""


def coverage_axis(
    surface_points: FloatArray,
    candidates: FloatArray,
    *,
    points: int,
    offset: float = 0.02,
    penalty: Penalty = "demo",
    candidate_limit: int | None = 30_000,
    stop_when_covered: bool = True,
) -> Skeleton:
    """Choose inner balls one by one until they cover the surface.

    A ball reaches from its centre to the nearest surface sample, and covers the samples within its radius plus
    `offset`. Each pick has the highest score: the number of samples that the ball covers and no ball before it does,
    plus the distance of its centre to the nearest centre before it (from the second pick on), each standardised over
    all candidates, minus a penalty for small balls.

    Parameters
    ----------
    surface_points
        ``(P, 3)`` float64, samples of the surface; the method uses 1500 to 2000.
    candidates
        ``(C, 3)`` float64, points inside the surface.
    points
        Largest number of balls, at least 1.
    offset
        By how much a ball grows to cover, at unit scale, above 0. Unit scale makes the longest side of the box
        around the samples 1, as in the examples released with the method; everything is scaled back in the end.
    penalty
        ``standardised``: the inverse radius, standardised as well; the released function's own default. ``demo``: a
        tenth of the largest radius over the radius, which the released demonstrations set instead.
    candidate_limit
        Candidates used, taken evenly by index, so that candidates in spatial order stay evenly spread; the released
        demonstration for point clouds draws 30,000. ``None`` uses all.
    stop_when_covered
        Stop once no candidate covers anything new: every sample that can be covered is. If false the choice goes on
        by distance and penalty alone until there are `points` balls, for comparisons at equal numbers.

    Returns
    -------
    Skeleton
        In the order of the choice, with the radii from before the growth, in the shape's unit. No candidate comes
        twice, so there are fewer balls than `points` where there are fewer candidates.

    Raises
    ------
    InputError
        If an array has the wrong shape, holds values that are not finite, or a setting is not legal.
    ShapeError
        If no candidate is off the surface.

    Notes
    -----
    A term that is equal for all candidates counts 0; the released program divides by zero there. It also may take a
    candidate twice, and goes on for a fixed number of picks where some samples cannot be covered. Ties go to the
    candidate that comes first.
    """
    from scipy.spatial import KDTree

    from morphoskel.skeleton import coverage_axis_kernels as kernels

    surface_points, candidates = _check_rows(surface_points, "surface_points"), _check_rows(candidates, "candidates")
    _check_settings(points, offset, penalty, candidate_limit)
    if candidate_limit is not None and len(candidates) > candidate_limit:
        candidates = candidates[np.arange(candidate_limit) * len(candidates) // candidate_limit]
    lower, extent = surface_points.min(axis=0), float(np.ptp(surface_points, axis=0).max())
    if not extent > 0:
        raise InputError("surface_points: all of them coincide; samples of a surface are needed")
    samples, centres = (surface_points - lower) / extent, (candidates - lower) / extent
    radii: FloatArray = np.asarray(KDTree(samples).query(centres)[0])
    off_surface = radii > SMALLEST_RADIUS
    if not off_surface.any():
        raise ShapeError(f"coverage axis: all {len(centres)} candidates lie on the surface; expected points inside it")
    candidates, centres, radii = candidates[off_surface], centres[off_surface], radii[off_surface]
    penalties = DEMO_WEIGHT * radii.max() / radii if penalty == "demo" else kernels.standardise(1 / radii)
    chosen = np.empty(min(points, len(centres)), dtype=np.int64)
    count = kernels.choose(samples, centres, radii + offset, penalties, stop_when_covered, chosen)
    return Skeleton(candidates[chosen[:count]], radii[chosen[:count]] * extent)


def _check_settings(points: int, offset: float, penalty: Penalty, candidate_limit: int | None) -> None:
    """Say what is wrong with the settings, if anything."""
    if points < 1:
        raise InputError(f"points: expected at least 1 ball, got {points}")
    if not 0 < offset < np.inf:
        raise InputError(f"offset: expected a length above 0, without which no ball covers a sample, got {offset:g}")
    if penalty not in get_args(Penalty):
        raise InputError(f"penalty: expected one of {', '.join(get_args(Penalty))}, got {penalty!r}")
    if candidate_limit is not None and candidate_limit < 1:
        raise InputError(f"candidate_limit: expected at least 1 candidate or None, got {candidate_limit}")


def _check_rows(array: FloatArray, name: str) -> FloatArray:
    """Return `array` if it is ``(N, 3)`` with N >= 1 and finite, or say why not."""
    rows = np.ascontiguousarray(array, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3 or len(rows) == 0:
        raise InputError(f"{name}: expected shape (N, 3) with N >= 1, got {rows.shape}")
    if not np.isfinite(rows).all():
        raise InputError(f"{name}: every coordinate must be finite")
    return rows
