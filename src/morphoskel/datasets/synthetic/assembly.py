"""Unite named parts to one watertight mesh that remembers which part every triangle comes from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import manifold3d
import numpy as np
from manifold3d import Manifold

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud

_SHORTEST_EDGE = 1e-5
"""Edges shorter than this (the shape's radius is 1) are collapsed, so that float32 keeps every triangle apart."""


@dataclass(frozen=True, eq=False)
class Part:
    """One solid of an assembly.

    Parameters
    ----------
    name
        A part name of the category; several solids may share it.
    solid
        Closed solid; must overlap the rest of the assembly.
    """

    name: str
    solid: Manifold


def unite(parts: Sequence[Part]) -> tuple[Mesh, IntArray]:
    """Unite parts and normalise the result.

    Parameters
    ----------
    parts
        At least one. Where parts overlap, the surface is that of the part that lies outside.

    Returns
    -------
    mesh
        Watertight and connected; voids that the parts enclose are filled. The bounding box is centred at the origin
        and the farthest vertex lies at distance 1. Coordinates are representable in float32.
    part_of_triangle
        ``(T,)`` int64, index into `parts`, from the provenance that the boolean operation keeps.

    Raises
    ------
    ShapeError
        If the parts do not overlap to one connected solid, or a part vanishes inside the others.
    """
    originals = [part.solid.as_original() for part in parts]
    united = _outer_surface(Manifold.batch_boolean(originals, manifold3d.OpType.Add), parts)
    low, high = (np.array(corner) for corner in np.split(np.array(united.bounding_box()), 2))
    united = united.translate(tuple(-(low + high) / 2))
    radius = float(np.linalg.norm(united.to_mesh64().vert_properties[:, :3], axis=1).max())
    united = united.scale((1.0 / radius,) * 3).simplify(_SHORTEST_EDGE)

    result = united.to_mesh64()
    part_of_original = {original.original_id(): index for index, original in enumerate(originals)}
    lengths = np.diff(np.asarray(result.run_index)) // 3
    runs = [part_of_original[identity] for identity in result.run_original_id]
    part_of_triangle = np.repeat(np.array(runs, dtype=np.int64), lengths)
    _check_visible(part_of_triangle, parts)
    vertices = result.vert_properties[:, :3].astype(np.float32)
    return Mesh(vertices.astype(np.float64), result.tri_verts.astype(np.int64)), part_of_triangle


def sample_surface(mesh: Mesh, triangle_labels: IntArray, count: int, generator: np.random.Generator) -> PointCloud:
    """Draw points uniformly by area.

    Parameters
    ----------
    mesh
        Closed surface.
    triangle_labels
        ``(T,)`` label of each triangle.
    count
        Number of points.
    generator
        Source of randomness.

    Returns
    -------
    PointCloud
        `count` points with the outward unit normal and the label of the triangle each lies on, all
        representable in float32.
    """
    corners = mesh.vertices[mesh.triangles]
    first, second, third = corners[:, 0], corners[:, 1], corners[:, 2]
    normals = np.cross(second - first, third - first)
    doubled_areas = np.linalg.norm(normals, axis=1)
    reach = np.cumsum(doubled_areas)
    chosen = np.searchsorted(reach, generator.random(count) * reach[-1], side="right")
    chosen = np.minimum(chosen, len(reach) - 1)
    root, split = np.sqrt(generator.random((count, 1))), generator.random((count, 1))
    points = (1 - root) * first[chosen] + root * (1 - split) * second[chosen] + root * split * third[chosen]
    unit = normals[chosen] / doubled_areas[chosen, None]
    return PointCloud(_to_float32(points), _to_float32(unit), triangle_labels[chosen])


def _to_float32(array: FloatArray) -> FloatArray:
    """Round to what a float32 file can hold, so that a shape is the same in memory and on disk."""
    return array.astype(np.float32).astype(np.float64)


def _outer_surface(solid: Manifold, parts: Sequence[Part]) -> Manifold:
    """Return the one surface seen from outside; inner surfaces, which have negative volume, bound voids."""
    pieces = [piece for piece in solid.decompose() if piece.volume() > 0]
    if len(pieces) != 1:
        raise ShapeError(
            f"the parts {sorted({part.name for part in parts})} form {len(pieces)} separate solids instead of one: "
            "a part floats; make the builder's parts overlap"
        )
    return pieces[0]


def _check_visible(part_of_triangle: IntArray, parts: Sequence[Part]) -> None:
    hidden = sorted(set(range(len(parts))) - set(part_of_triangle.tolist()))
    if hidden:
        raise ShapeError(
            f"part {hidden[0]} ({parts[hidden[0]].name}) lies wholly inside the others; make the builder's parts "
            "reach the surface"
        )
