"""The directions in which inner points sink: normals of the surface samples, smoothed without blurring sharp edges."""

from __future__ import annotations

import math

import numpy as np

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.dpc.neighbourhood import neighbour_pairs, proximity

LEAST_WEIGHT = 1e-10
"""Least weight of a neighbour, as in the released program."""
SHARPEST = 1e-8
"""Least value of one minus the cosine of the smoothing angle, as in the released program."""


def smooth_normals(points: FloatArray, normals: FloatArray, *, radius: float, angle: float) -> FloatArray:
    """Replace each normal by the mean of its neighbours' normals, weighted by distance and by likeness.

    A neighbour ``j`` weighs ``exp(-4 d² / radius²)`` times ``exp(-((1 - n_i · n_j) / (1 - cos angle))²)`` (Wu et al.,
    "Deep Points Consolidation", SIGGRAPH Asia 2015; Huang et al., "Edge-Aware Point Set Resampling", 2013).

    Parameters
    ----------
    points
        ``(N, 3)`` float64.
    normals
        ``(N, 3)`` float64, unit length.
    radius
        Points so near are neighbours, in the shape's units. A point is not its own neighbour.
    angle
        Degrees. With 0, the normals are returned as they are.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64, unit length. Without neighbours, or where they cancel out, the normal is kept.
    """
    if angle == 0:
        return normals
    first, second = neighbour_pairs(points, radius)
    separation = np.linalg.norm(points[first] - points[second], axis=1)
    unlikeness = 1.0 - np.einsum("ij,ij->i", normals[first], normals[second])
    likeness = np.exp(-((unlikeness / max(1.0 - math.cos(math.radians(angle)), SHARPEST)) ** 2))
    weights = np.maximum(proximity(separation, radius) * likeness, LEAST_WEIGHT)
    sums = np.empty_like(normals)
    for axis in range(3):
        sums[:, axis] = np.bincount(first, weights * normals[second, axis], minlength=len(points))
    lengths = np.linalg.norm(sums, axis=1)
    totals = np.bincount(first, weights, minlength=len(points))
    certain = lengths > 1e-6 * totals
    return np.where(certain[:, None], sums / np.where(certain, lengths, 1.0)[:, None], normals)
