"""Gather inner points on sheets and curves, and spread them evenly there: the meso-skeleton."""

from __future__ import annotations

import numpy as np

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.dpc.settings import DeepPointsSettings

LEAST_NEIGHBOURS = 4
"""Neighbours without which no directions can be told from inner points (released program)."""
LEAST_SCALE = 1e-6
"""Least strength that a distance is divided by; the strength of an axis along which all links point may be 0."""


def form_meso_skeleton(
    samples: FloatArray, inner: FloatArray, spacing: float, settings: DeepPointsSettings
) -> FloatArray:
    """Move inner points to the mean of their neighbours, and apart along the sheet or curve that they form.

    Every inner point stays linked with its sample (Wu et al., "Deep Points Consolidation", SIGGRAPH Asia 2015). All
    points move at once, so that their order does not matter.

    Parameters
    ----------
    samples
        ``(N, 3)`` float64.
    inner
        ``(N, 3)`` float64, where the inner points of the samples came to rest.
    spacing
        The unit of the lengths in `settings`, in the shape's units.
    settings
        Iterations, radius, box, powers and weight of the repulsion.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64.
    """
    for _ in range(settings.iterations):
        order, axis = _sweep(inner)
        moved = np.empty_like(inner)
        moved[order] = _iterate(samples[order], inner[order], axis, settings.radius * spacing, settings)
        inner = moved
    return inner


def axis_strengths(alignment: FloatArray, contrast: float) -> FloatArray:
    """Return how much the meso-skeleton extends along each axis.

    Deep links stand at right angles on a sheet or curve. An axis is therefore the stronger, the less the links are
    aligned with it.

    Parameters
    ----------
    alignment
        ``(N, 3)`` float64, at least 0: for each of three axes, the mean of ``|link · axis|``.
    contrast
        Power that sharpens the differences.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64; every row sums to 1. Where no link has a direction, all three are equal.
    """
    totals = alignment.sum(axis=1, keepdims=True)
    shares = np.divide(alignment, totals, out=np.full_like(alignment, 1 / 3), where=totals > 0)
    strengths: FloatArray = ((1.0 - shares) / 2.0) ** contrast
    strengths /= strengths.sum(axis=1, keepdims=True)
    return strengths


def _iterate(
    samples: FloatArray, inner: FloatArray, axis: int, radius: float, settings: DeepPointsSettings
) -> FloatArray:
    """Return the new positions of points that are sorted along `axis`."""
    from morphoskel.skeleton.dpc.meso_skeleton_kernels import alignments, averages, repulsions

    means, scatters, neighbours = averages(inner, axis, radius)
    axes = np.ascontiguousarray(np.linalg.eigh(scatters)[1])  # column k is axis k
    strengths = axis_strengths(alignments(inner, _directions(samples - inner), axes, axis, radius), settings.contrast)
    few = neighbours < LEAST_NEIGHBOURS
    axes[few], strengths[few] = np.eye(3), 1 / 3
    half_sides = radius * (settings.box + settings.box_growth * strengths)
    ellipsoid = settings.repulsion_distance == "ellipsoid"
    scales = np.maximum(strengths, LEAST_SCALE) if ellipsoid else np.ones_like(strengths)
    pushes = repulsions(inner, axes, half_sides, scales, axis, radius, settings.repulsion_power)
    pushes *= settings.repulsion * np.where(strengths > settings.least_strength, strengths, 0.0)
    moved: FloatArray = means + np.einsum("iak,ik->ia", axes, pushes)
    return moved


def _directions(links: FloatArray) -> FloatArray:
    """Scale the rows to unit length; rows of length 0 stay."""
    lengths = np.linalg.norm(links, axis=1, keepdims=True)
    directions: FloatArray = np.divide(links, lengths, out=np.zeros_like(links), where=lengths > 0)
    return directions


def _sweep(inner: FloatArray) -> tuple[np.ndarray[tuple[int], np.dtype[np.int64]], int]:
    """Return the order of the points along the longest axis, and this axis."""
    axis = int(np.argmax(np.ptp(inner, axis=0)))
    return np.argsort(inner[:, axis], kind="stable"), axis
