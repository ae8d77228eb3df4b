"""Bring shapes that lie far from the origin near it, and their skeletons back; refuse those of no usable size.

Closed surfaces and the candidates inside them are held in single precision, whose steps grow with the distance from
the origin: a million times its extent away, a shape is a handful of steps wide.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, Mesh, PointCloud, Skeleton

FAR = 64.0
"""Distance from the origin, in extents, from which a shape is moved. Nearer shapes, as those of every data set, stay
where they are, so that they give the same bits here as in the workflow."""

SMALLEST, LARGEST = 1e-15, 1e15
"""Extents whose squares single precision still holds."""


def remoteness(lower: FloatArray, upper: FloatArray) -> float:
    """Return the largest coordinate of a box in units of its longest side, ``inf`` if it has none."""
    extent = float((upper - lower).max())
    largest = float(np.maximum(np.abs(lower), np.abs(upper)).max())
    return largest / extent if extent > 0 else np.inf


def check_extent(shape: PointCloud | Mesh) -> tuple[FloatArray, FloatArray]:
    """Return the corners of the box around a shape, ``(3,)`` each.

    Raises
    ------
    ShapeError
        If single precision cannot hold the squares of its extent.
    """
    if isinstance(shape, Mesh):
        lower, upper = shape.bounds
    else:
        lower, upper = shape.points.min(axis=0), shape.points.max(axis=0)
    with np.errstate(over="ignore"):
        extent = float((upper - lower).max())
    if extent == 0:
        raise ShapeError(f"{shape!r} has no extent, all of it lies in one point")
    if not SMALLEST <= extent <= LARGEST:
        raise ShapeError(
            f"{shape!r} has the extent {extent:.3g}, expected {SMALLEST:g} to {LARGEST:g}; rescale it, or remove what "
            "lies far from the rest"
        )
    return lower, upper


def bring_near(shape: PointCloud | Mesh) -> tuple[PointCloud | Mesh, FloatArray]:
    """Move a shape to the origin if it lies far from it.

    Returns
    -------
    tuple
        The shape, and what was subtracted from its points, ``(3,)``: zeros if it stayed.

    Raises
    ------
    ShapeError
        As from :func:`check_extent`.
    """
    lower, upper = check_extent(shape)
    if not FAR < remoteness(lower, upper) < np.inf:
        return shape, np.zeros(3)
    offset: FloatArray = (lower + upper) / 2
    if isinstance(shape, Mesh):
        return replace(shape, vertices=shape.vertices - offset), offset
    return replace(shape, points=shape.points - offset), offset


def bring_back(skeleton: Skeleton, offset: FloatArray) -> Skeleton:
    """Move the skeleton of a shape to where the shape was."""
    return replace(skeleton, points=skeleton.points + offset) if offset.any() else skeleton
