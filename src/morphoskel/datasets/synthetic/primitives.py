"""Closed solids from which the synthetic shapes are assembled.

Coordinates as in ShapeNet: x to the right, y up, and the front of a shape towards negative z.
Every function returns a watertight `manifold3d.Manifold` of positive volume.
"""

from __future__ import annotations

from collections.abc import Sequence

import manifold3d
import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.curves import Outline, Path3, Triple, embed, rounded_rectangle
from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray


def box(size: Triple, centre: Triple = (0.0, 0.0, 0.0)) -> Manifold:
    """Return an axis-aligned box with edge lengths `size`."""
    return Manifold.cube(tuple(size), True).translate(tuple(centre))


def rounded_box(size: Triple, centre: Triple = (0.0, 0.0, 0.0), radius: float = 0.05) -> Manifold:
    """Return a box whose edges and corners are rounded with `radius`, cut to what the thinnest edge allows."""
    radius = min(radius, 0.49 * min(size))
    ball_at_corner = Manifold.sphere(radius, 12)
    reach = [edge / 2 - radius for edge in size]
    corners = [
        ball_at_corner.translate((i * reach[0], j * reach[1], k * reach[2]))
        for i in (-1, 1)
        for j in (-1, 1)
        for k in (-1, 1)
    ]
    return Manifold.batch_hull(corners).translate(tuple(centre))


def slab(width: float, thickness: float, depth: float, centre: Triple, corner: float) -> Manifold:
    """Return a horizontal slab (x, y, z extents) whose four vertical edges are rounded with radius `corner`."""
    points = 4 if corner < 0.2 * min(width, depth) else 9
    return prism(rounded_rectangle(width, depth, corner, points), thickness, "y").translate(tuple(centre))


def ball(radii: Triple | float, centre: Triple = (0.0, 0.0, 0.0), segments: int = 20) -> Manifold:
    """Return an ellipsoid; a single number as `radii` gives a sphere."""
    scale = (radii,) * 3 if isinstance(radii, int | float) else tuple(radii)
    return Manifold.sphere(1.0, segments).scale(scale).translate(tuple(centre))


def rod(start: Triple, end: Triple, radius: float, end_radius: float | None = None, segments: int = 16) -> Manifold:
    """Return a cylinder from `start` to `end`, or a frustum if `end_radius` differs."""
    begin, finish = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    length = float(np.linalg.norm(finish - begin))
    frame = _frame((finish - begin) / length)
    solid = Manifold.cylinder(length, radius, radius if end_radius is None else end_radius, segments)
    return solid.transform(np.column_stack([frame, begin]))


def beam(start: Triple, end: Triple, width: float, height: float, end_scale: float = 1.0) -> Manifold:
    """Return a bar of rectangular section from `start` to `end`.

    `width` lies along x where the bar is not itself parallel to x, else along z; the section shrinks or grows
    linearly by `end_scale`.
    """
    begin, finish = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    direction = (finish - begin) / np.linalg.norm(finish - begin)
    side = np.array([1.0, 0.0, 0.0]) if abs(direction[0]) < 0.9 else np.array([0.0, 0.0, 1.0])
    side -= direction * (side @ direction)
    side /= np.linalg.norm(side)
    up = np.cross(direction, side)
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / 2
    section = signs @ np.stack([side * width, up * height])
    return loft(np.stack([begin + section, finish + end_scale * section]))


def lathe(profile: Outline, axis: str = "y", centre: Triple = (0.0, 0.0, 0.0), segments: int = 32) -> Manifold:
    """Revolve a closed profile of ``(radius, position along the axis)`` points about `axis` through `centre`."""
    solid = Manifold.revolve(_cross_section(profile), segments)
    turned = {"x": (0.0, 90.0, 0.0), "y": (-90.0, 0.0, 0.0), "z": (0.0, 0.0, 0.0)}[axis]
    return solid.rotate(turned).translate(tuple(centre))


def prism(outline: Outline, thickness: float, normal: str, offset: float = 0.0) -> Manifold:
    """Extrude a plane outline (see :func:`curves.embed`) to both sides of its plane, `thickness` in all."""
    axes = embed(np.eye(2), normal)
    along = embed(np.zeros((1, 2)), normal, 1.0)[0]
    solid = Manifold.extrude(_cross_section(outline), thickness)
    return solid.transform(np.column_stack([axes[0], axes[1], along, along * (offset - thickness / 2)]))


def loft(rings: FloatArray | Sequence[FloatArray]) -> Manifold:
    """Join consecutive closed rings of equally many points, ``(S, M, 3)``, and close both ends.

    The end rings must be star-shaped about their centroids.
    """
    points = np.asarray(rings, dtype=np.float64)
    count, size = points.shape[:2]
    index = np.arange(count * size).reshape(count, size)
    here, right = index[:-1], np.roll(index[:-1], -1, axis=1)
    above, above_right = index[1:], np.roll(index[1:], -1, axis=1)
    sides = np.concatenate([np.stack([here, right, above_right], -1), np.stack([here, above_right, above], -1)])
    first, last = index[0], index[-1]
    bottom = np.column_stack([np.roll(first, -1), first, np.full(size, count * size)])
    top = np.column_stack([last, np.roll(last, -1), np.full(size, count * size + 1)])
    vertices = np.vstack([points.reshape(-1, 3), points[0].mean(axis=0), points[-1].mean(axis=0)])
    return _solid(vertices, np.vstack([sides.reshape(-1, 3), bottom, top]))


def tube(path: Path3, radius: float | FloatArray, segments: int = 10, flatten: float = 1.0) -> Manifold:
    """Sweep a disc along an open path, ``(S, 3)``; the radius may differ from point to point.

    `flatten` scales the section across the plane in which the path begins to bend.
    """
    points = np.asarray(path, dtype=np.float64)
    tangents = np.gradient(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    angles = 2.0 * np.pi * np.arange(segments) / segments
    circle = np.column_stack([np.cos(angles), flatten * np.sin(angles)])
    sizes = np.broadcast_to(radius, len(points))
    side = _bending_direction(points, tangents)
    rings = []
    for point, tangent, size in zip(points, tangents, sizes, strict=True):
        side = side - tangent * (side @ tangent)
        side /= np.linalg.norm(side)
        rings.append(point + size * circle @ np.stack([side, np.cross(tangent, side)]))
    return loft(np.stack(rings))


def hull(points: Path3) -> Manifold:
    """Return the convex hull of points, ``(N, 3)``."""
    return Manifold.hull_points(np.asarray(points, dtype=np.float64))


def hull_of(*solids: Manifold) -> Manifold:
    """Return the convex hull of several solids together."""
    return Manifold.batch_hull(list(solids))


def union(*solids: Manifold) -> Manifold:
    """Return the exact union of solids that belong to the same part."""
    return Manifold.batch_boolean(list(solids), manifold3d.OpType.Add)


def both_sides(solid: Manifold) -> list[Manifold]:
    """Return `solid` and its mirror image in the plane x = 0."""
    return [solid, solid.mirror((1.0, 0.0, 0.0))]


def lathe_shell(profile: Outline, wall: float, segments: int = 32) -> Manifold:
    """Revolve a wall about the axis y.

    `profile` holds the outer ``(radius, height)`` points from below upwards; the wall lies inside it. An end away
    from the axis stays open, an end at radius 0 is closed.
    """
    half = np.asarray(profile, dtype=np.float64)
    outer = _cross_section(np.vstack([half, (half * (-1.0, 1.0))[::-1]]))
    solid = outer
    for (radius, height), sign in ((half[0], -1.0), (half[-1], 1.0)):
        if radius > wall:
            strip = manifold3d.CrossSection.square((2 * radius, 4 * wall), True)
            solid += strip.translate((0.0, height + sign * 1.9 * wall))
    inner = solid.offset(-wall, manifold3d.JoinType.Miter, 2.0)
    reach = 2 * float(np.abs(half).max()) + 1.0
    right_half = manifold3d.CrossSection.square((reach, 2 * reach)).translate((0.0, -reach))
    # Revolving a section that crosses the axis would leave vertices there that belong to no triangle.
    return Manifold.revolve((outer - inner) ^ right_half, segments).rotate((-90.0, 0.0, 0.0))


def _cross_section(outline: Outline) -> manifold3d.CrossSection:
    """Return the outline as a cross-section, whichever way round it was given."""
    return manifold3d.CrossSection([np.asarray(outline, dtype=np.float64)], manifold3d.FillRule.NonZero)


def _frame(direction: FloatArray) -> FloatArray:
    """Return a rotation, ``(3, 3)``, whose third column is `direction`."""
    helper = np.array([1.0, 0.0, 0.0]) if abs(direction[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    first = np.cross(helper, direction)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(direction, first), direction])


def _bending_direction(points: FloatArray, tangents: FloatArray) -> FloatArray:
    """Return a vector in the plane in which the path first bends, or any normal of a straight path."""
    offsets = points - points[0]
    across = offsets - np.outer(offsets @ tangents[0], tangents[0])
    strength = np.linalg.norm(across, axis=1)
    if strength.max() < 1e-9:
        return _frame(tangents[0])[:, 0]
    first = across[int(np.argmax(strength > 0.2 * strength.max()))]
    return np.asarray(first / np.linalg.norm(first), dtype=np.float64)


def _solid(vertices: FloatArray, triangles: FloatArray) -> Manifold:
    """Return the solid a closed triangle mesh encloses, turned so that its volume is positive."""
    corners = vertices[triangles]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    faces = triangles if volume > 0 else triangles[:, ::-1]
    solid = Manifold(manifold3d.Mesh64(np.ascontiguousarray(vertices), np.ascontiguousarray(faces, dtype=np.uint64)))
    if solid.status() != manifold3d.Error.NoError:
        raise ShapeError(f"a primitive of a synthetic shape is not closed: {solid.status()}")
    return solid
