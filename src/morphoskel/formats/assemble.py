"""Make a validated shape from what a file holds; shared by the readers of all formats."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud


@dataclass(frozen=True, eq=False)
class Polygons:
    """Polygons of any number of corners.

    Parameters
    ----------
    counts
        ``(F,)`` int64, number of corners of each polygon.
    corners
        ``(counts.sum(),)`` int64, the vertex indices of all polygons in a row.
    """

    counts: IntArray
    corners: IntArray


def assemble_shape(
    vertices: npt.ArrayLike,
    polygons: Polygons | None = None,
    *,
    normals: npt.ArrayLike | None = None,
    labels: npt.ArrayLike | None = None,
) -> PointCloud | Mesh:
    """Return a mesh if there are polygons, else a cloud.

    Parameters
    ----------
    vertices
        ``(N, 3)``.
    polygons
        Faces, or ``None``; those with more than three corners are cut into a fan of triangles.
    normals
        ``(N, 3)``, scaled to unit length here; zero rows stand for unknown normals and stay zero. A mesh
        has no use for them.
    labels
        ``(N,)``, whole numbers. A mesh has no use for them.

    Raises
    ------
    InputError
        If the arrays do not make a legal shape.
    """
    vertices = as_rows(vertices, "points")
    if polygons is not None and len(polygons.counts):
        mesh = Mesh(vertices, triangulate_fans(polygons))
        PointCloud(mesh.vertices)  # a mesh, too, needs four distinct points
        return mesh
    return PointCloud(
        vertices,
        normals=None if normals is None else scale_to_unit_length(as_rows(normals, "normals")),
        labels=None if labels is None else as_whole_numbers(labels, "labels"),
    )


def triangulate_fans(polygons: Polygons) -> IntArray:
    """Cut each polygon into a fan of triangles around its first corner.

    Returns
    -------
    IntArray
        ``(counts.sum() - 2 F, 3)``, with the orientation of the polygons. Exact for convex polygons.

    Raises
    ------
    InputError
        If a polygon has fewer than three corners.
    """
    counts = polygons.counts
    if (counts < 3).any():
        face = int(np.argmax(counts < 3))
        raise InputError(f"face {face} has {counts[face]} corners; a face needs at least 3, remove it")
    fans = counts - 2
    first = np.repeat(np.cumsum(counts) - counts, fans)
    step = np.arange(int(fans.sum()), dtype=np.int64) - np.repeat(np.cumsum(fans) - fans, fans)
    return np.stack(
        [polygons.corners[first], polygons.corners[first + step + 1], polygons.corners[first + step + 2]], axis=1
    )


def as_rows(values: npt.ArrayLike, what: str) -> FloatArray:
    """Return `values` as float64 if they have the shape ``(N, 3)``.

    Raises
    ------
    InputError
        If they are no numbers or have another shape; `what` names the values in the message.
    """
    rows = as_numbers(values, what)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise InputError(f"{what}: expected shape (N, 3), got {rows.shape}")
    return rows


def as_numbers(values: npt.ArrayLike, what: str) -> FloatArray:
    """Return `values` as float64; what is too large for that becomes infinite.

    Raises
    ------
    InputError
        If they are no real numbers, such as text, complex numbers or dates; `what` names the values in the message.
    """
    try:
        array = np.asarray(values)
    except ValueError as error:  # rows of different length
        raise InputError(f"{what}: expected numbers ({error})") from error
    if array.dtype.kind not in "biuf":
        raise InputError(f"{what}: expected numbers, got values of the type {array.dtype}")
    # A float32 NaN whose bits say that it signals is "invalid" here; like any other, it is refused later, by its row.
    with np.errstate(over="ignore", invalid="ignore"):
        return array.astype(np.float64)


def scale_to_unit_length(normals: FloatArray) -> FloatArray:
    """Return `normals`, ``(N, 3)``, scaled to length 1; zero rows (unknown normals) stay zero.

    Rows that are not finite stay, too, for :class:`PointCloud` to report.
    """
    unit = normals.copy()
    known = np.isfinite(normals).all(axis=1) & normals.any(axis=1)
    # Dividing by the largest component first keeps the squares from overflowing or vanishing.
    unit[known] /= np.abs(normals[known]).max(axis=1, keepdims=True)
    unit[known] /= np.linalg.norm(unit[known], axis=1, keepdims=True)
    return unit


def as_whole_numbers(values: npt.ArrayLike, what: str) -> IntArray:
    """Return `values` as int64.

    Raises
    ------
    InputError
        If a value is not a whole number; `what` names the values in the message.
    """
    array = np.asarray(values)
    if array.dtype.kind == "i" or (array.dtype.kind == "u" and array.dtype.itemsize < 8):
        return array.astype(np.int64)
    floats = as_numbers(array, what)
    bad = np.flatnonzero(~np.isfinite(floats) | (floats != np.trunc(floats)) | (np.abs(floats) > 2**53))
    if len(bad):
        raise InputError(f"{what}: expected whole numbers, got {floats.reshape(-1)[bad[0]]} at position {bad[0]}")
    return floats.astype(np.int64)
