"""What an exported file shows: the balls, the sheets and curves between them, and the surface around them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.reporting.render import SURFACE_COLOUR
from morphoskel.reporting.skeleton_picture import colour_by_radius
from morphoskel.shapes import FloatArray, IntArray, Mesh, Skeleton
from morphoskel.skeleton.ball_mesh import ball_mesh, subdivisions_within

TRIANGLE_LIMIT = 500_000
"""Triangles of all balls together, unless told otherwise: 1024 balls get 320 each, and open at once in any viewer."""

SURFACE_OPACITY = 0.3
EDGE_COLOUR = (0.2, 0.2, 0.2)


@dataclass(frozen=True, eq=False)
class ColouredPart:
    """Triangles or segments with a colour at each vertex.

    Parameters
    ----------
    name
        What it shows: ``balls``, ``sheets``, ``curves`` or ``surface``.
    vertices
        ``(V, 3)`` float64.
    elements
        ``(T, 3)`` int64 triangles or ``(E, 2)`` int64 segments, indices into `vertices`.
    colours
        ``(V, 4)`` uint8, sRGB and opacity.
    normals
        ``(V, 3)`` float64, unit length, so that triangles are shaded smoothly; ``None`` for segments.
    """

    name: str
    vertices: FloatArray
    elements: IntArray
    colours: npt.NDArray[np.uint8]
    normals: FloatArray | None = None

    @property
    def translucent(self) -> bool:
        """Whether anything behind it is to be seen."""
        return bool((self.colours[:, 3] < 255).any())


def coloured_parts(
    skeleton: Skeleton, surface: Mesh | None = None, *, subdivisions: int | None = None
) -> list[ColouredPart]:
    """Return what an exported file shows.

    Parameters
    ----------
    skeleton
        Balls are coloured by radius, from 0 in dark blue to the largest in yellow (the colour map viridis, in which
        equal steps of the radius look like equal steps). Those of radius 0 are left out.
    surface
        A surface to lay around the balls, grey and translucent.
    subdivisions
        Of the balls, see :func:`~morphoskel.skeleton.ball_mesh.ball_mesh`; by default the most, up to 4, with which
        all balls together have at most :data:`TRIANGLE_LIMIT` triangles.

    Returns
    -------
    list of ColouredPart
        ``balls``, and where the skeleton has them ``sheets`` (its triangles) and ``curves`` (its edges); ``surface``.

    Raises
    ------
    InputError
        If the skeleton has neither balls of positive radius nor edges or triangles, or `subdivisions` is out of range.
    """
    parts = []
    colours = _bytes(colour_by_radius(skeleton)[0]) if len(skeleton) else np.empty((0, 4), dtype=np.uint8)
    solid = skeleton.radii > 0
    if solid.any():
        parts.append(_balls(Skeleton(skeleton.points[solid], skeleton.radii[solid]), colours[solid], subdivisions))
    if len(skeleton.triangles):
        used, triangles = _renumbered(skeleton.triangles)
        normals = _vertex_normals(skeleton.points[used], triangles)
        parts.append(ColouredPart("sheets", skeleton.points[used], triangles, colours[used], normals))
    if len(skeleton.edges):
        used, edges = _renumbered(skeleton.edges)
        grey = _bytes(np.broadcast_to(EDGE_COLOUR, (len(used), 3)))
        parts.append(ColouredPart("curves", skeleton.points[used], edges, grey))
    if not parts:
        raise InputError(
            f"the skeleton has {len(skeleton)} balls, all of radius 0, and neither edges nor triangles: there is "
            "nothing to draw; export a skeleton with radii"
        )
    if surface is not None:
        grey = _bytes(np.broadcast_to(SURFACE_COLOUR, (len(surface.vertices), 3)), SURFACE_OPACITY)
        normals = _vertex_normals(surface.vertices, surface.triangles)
        parts.append(ColouredPart("surface", surface.vertices, surface.triangles, grey, normals))
    return parts


def _balls(skeleton: Skeleton, colours: npt.NDArray[np.uint8], subdivisions: int | None) -> ColouredPart:
    if subdivisions is None:
        subdivisions = subdivisions_within(len(skeleton), TRIANGLE_LIMIT)
    mesh, owner = ball_mesh(skeleton, subdivisions=subdivisions)
    normals = (mesh.vertices - skeleton.points[owner]) / skeleton.radii[owner, None]
    return ColouredPart("balls", mesh.vertices, mesh.triangles, colours[owner], normals)


def _renumbered(elements: IntArray) -> tuple[IntArray, IntArray]:
    """Return the centres that are used, ascending, and the elements as indices into these."""
    used, places = np.unique(elements, return_inverse=True)
    return used, places.reshape(elements.shape)


def _vertex_normals(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Return the mean normal of the triangles around each vertex, weighted by their angles there."""
    import trimesh

    normals = np.array(trimesh.Trimesh(vertices, triangles, process=False).vertex_normals, dtype=np.float64)
    # Triangles without area, or that cancel each other, leave no direction; formats want one of unit length anyway.
    normals[np.linalg.norm(normals, axis=1) < 0.5] = [0, 0, 1]
    return normals


def _bytes(colours: npt.ArrayLike, opacity: float = 1.0) -> npt.NDArray[np.uint8]:
    """Return ``(N, 3)`` colours in [0, 1] as ``(N, 4)`` bytes."""
    rgb = np.asarray(colours, dtype=np.float64)
    rgba = np.concatenate([rgb, np.full((len(rgb), 1), opacity)], axis=1)
    return np.round(255 * rgba).astype(np.uint8)
