"""Tag Delaunay tetrahedra as inside or outside by the normals of their vertices (Maruani et al., CVPR 2024)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, IntArray

OUTSIDE, UNDECIDED, INSIDE = 0, 2, 4
"""Tags. They are counts of vertices that look away from the circumcentre; any other than none or all is undecided."""

Tags = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Tetrahedra:
    """The Delaunay tetrahedra of vertices and the eight corners of a cube around them.

    Parameters
    ----------
    positions
        ``(V + 8, 3)`` float64, the cube's corners last.
    vertices
        ``(T, 4)`` int64 indices into `positions`.
    neighbours
        ``(T, 4)`` int64: the tetrahedron behind the face opposite each vertex, -1 for none.
    """

    positions: FloatArray
    vertices: IntArray
    neighbours: IntArray

    @property
    def first_corner(self) -> int:
        """Index of the first corner of the cube."""
        return len(self.positions) - 8


def tetrahedralise(positions: FloatArray) -> Tetrahedra:
    """Return the Delaunay tetrahedra of points inside the cube ``[-1, 1]^3`` and of its corners.

    Raises
    ------
    ShapeError
        If Qhull fails; with the corners the points are never flat, so only rounding can be the cause.
    """
    from scipy.spatial import Delaunay, QhullError

    corners = np.array([[x, y, z] for x in (1.0, -1.0) for y in (1.0, -1.0) for z in (1.0, -1.0)])
    positions = np.vstack([positions, corners])
    try:
        delaunay = Delaunay(positions)
    except QhullError as error:
        raise ShapeError(f"ponq: no Delaunay tetrahedra of {len(positions)} points: {error}") from error
    return Tetrahedra(positions, delaunay.simplices.astype(np.int64), delaunay.neighbors.astype(np.int64))


def circumcentres(corners: FloatArray) -> FloatArray:
    """Return the centre of the sphere through the four corners of each tetrahedron.

    Parameters
    ----------
    corners
        ``(T, 4, 3)``.

    Returns
    -------
    ndarray
        ``(T, 3)`` float64; the barycentre for a tetrahedron without volume.
    """
    origin = corners[:, 0]
    a, b, c = (corners[:, i] - origin for i in (1, 2, 3))
    b_c, c_a, a_b = np.cross(b, c), np.cross(c, a), np.cross(a, b)
    squares = [np.einsum("ij,ij->i", edge, edge)[:, None] for edge in (a, b, c)]
    determinant = np.einsum("ij,ij->i", a, b_c)[:, None]
    flat = determinant == 0
    offset = (squares[0] * b_c + squares[1] * c_a + squares[2] * a_b) / np.where(flat, 1.0, 2 * determinant)
    centres: FloatArray = np.where(flat, corners.mean(axis=1), origin + offset)
    return centres


def tag_tetrahedra(tetrahedra: Tetrahedra, normals: FloatArray) -> Tags:
    """Count, for every tetrahedron, the vertices whose normal points away from its circumcentre.

    All four: inside; none: outside. A verdict that the barycentre contradicts, lying on average on the other side of
    the vertices' tangent planes, is withdrawn. What touches a corner of the cube is outside in any case.

    Parameters
    ----------
    tetrahedra
        T tetrahedra.
    normals
        ``(V, 3)``, of the vertices without the corners.

    Returns
    -------
    ndarray
        ``(T,)`` int64: `INSIDE`, `OUTSIDE`, or undecided.

    Raises
    ------
    ShapeError
        If none is inside.
    """
    corners = tetrahedra.positions[tetrahedra.vertices]
    vertex_normals = np.vstack([normals, np.zeros((8, 3))])[tetrahedra.vertices]
    from_circumcentre = corners - circumcentres(corners)[:, None]
    tags: Tags = (np.einsum("tij,tij->ti", from_circumcentre, vertex_normals) > 0).sum(axis=1).astype(np.int64)
    to_barycentre = corners.mean(axis=1, keepdims=True) - corners
    height = np.einsum("tij,tij->ti", to_barycentre, vertex_normals).mean(axis=1)
    tags[((tags == OUTSIDE) & (height < 0)) | ((tags == INSIDE) & (height > 0))] = UNDECIDED
    tags[(tetrahedra.vertices >= tetrahedra.first_corner).any(axis=1)] = OUTSIDE
    if not (tags == INSIDE).any():
        raise ShapeError(
            f"ponq: none of {len(tags)} tetrahedra is inside by the normals of its vertices; they point inward or "
            "contradict each other, or there are too few sites for the shape's detail"
        )
    return tags


def repair_tags(tetrahedra: Tetrahedra, tags: Tags, *, reach: float) -> Tags:
    """Let the surface pass through vertices that touch tetrahedra of one verdict only.

    A vertex between an outside and an inside tetrahedron is on the surface whatever the cut decides. Where one of the
    two is missing, the incident tetrahedron whose barycentre is nearest becomes it. The released program does so only
    for a missing inside tetrahedron: its test for vertices that lack both, which are left alone, asks twice about the
    outside. Here both are repaired.

    Parameters
    ----------
    tetrahedra
        T tetrahedra.
    tags
        ``(T,)``.
    reach
        Largest mean squared distance between the barycentre and the four vertices of a tetrahedron that is changed.

    Returns
    -------
    ndarray
        ``(T,)``, a changed copy of `tags`.
    """
    vertices = tetrahedra.vertices
    touches = {tag: np.zeros(len(tetrahedra.positions), dtype=bool) for tag in (OUTSIDE, INSIDE)}
    for tag, touched in touches.items():
        touched[vertices[tags == tag]] = True
    nearest, distance = _nearest_incident(tetrahedra)
    within = distance < reach
    repaired = tags.copy()
    repaired[nearest[within & touches[OUTSIDE] & ~touches[INSIDE]]] = INSIDE
    repaired[nearest[within & touches[INSIDE] & ~touches[OUTSIDE]]] = OUTSIDE
    return repaired


def _nearest_incident(tetrahedra: Tetrahedra) -> tuple[IntArray, FloatArray]:
    """Return each vertex's incident tetrahedron of least mean squared vertex-barycentre distance, and that distance.

    Infinite where every incident tetrahedron touches a corner of the cube, and where there is none: Qhull leaves out
    a vertex that nearly coincides with another.
    """
    corners = tetrahedra.positions[tetrahedra.vertices]
    spread = ((corners - corners.mean(axis=1, keepdims=True)) ** 2).sum(axis=2).mean(axis=1)
    spread[(tetrahedra.vertices >= tetrahedra.first_corner).any(axis=1)] = np.inf
    count = len(tetrahedra.positions)
    # Ordered by vertex, then by spread: the first entry of a vertex is its nearest tetrahedron.
    incident = np.repeat(np.arange(len(tetrahedra.vertices)), 4)
    order = np.lexsort((spread[incident], tetrahedra.vertices.ravel()))
    present, first = np.unique(tetrahedra.vertices.ravel()[order], return_index=True)
    nearest, distance = np.zeros(count, dtype=np.int64), np.full(count, np.inf)
    nearest[present] = incident[order[first]]
    distance[present] = spread[nearest[present]]
    return nearest, distance
