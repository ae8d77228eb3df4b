"""Cut the tetrahedra in two where the faces agree best with their vertices (Maruani et al., CVPR 2024)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, IntArray
from morphoskel.surface.ponq.quadrics import QuadricVertices
from morphoskel.surface.ponq.tetrahedra import INSIDE, OUTSIDE, Tags, Tetrahedra

ANGLE_UNIT = 1.5
"""Sum of the three angles between a face and its vertices, in radians, that costs as much as a squared cell."""

LARGEST_FLOW = 2**30 - 1
"""Half of the largest 32-bit integer, because a residual is the sum of a capacity and a flow back."""

OTHER_VERTICES = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])
"""The vertices of the face opposite each vertex of a tetrahedron."""


@dataclass(frozen=True, eq=False)
class Faces:
    """The faces between two tetrahedra.

    Parameters
    ----------
    vertices
        ``(F, 3)`` int64, counter-clockwise seen from the second tetrahedron.
    sides
        ``(F, 2)`` int64, the first and the second tetrahedron.
    """

    vertices: IntArray
    sides: IntArray


def collect_faces(tetrahedra: Tetrahedra) -> Faces:
    """List every face that two tetrahedra share."""
    first, opposite = np.nonzero(tetrahedra.neighbours > np.arange(len(tetrahedra.vertices))[:, None])
    second = tetrahedra.neighbours[first, opposite]
    triangles = tetrahedra.vertices[first[:, None], OTHER_VERTICES[opposite]]
    back = np.argmax(tetrahedra.neighbours[second] == first[:, None], axis=1)
    apex_heights = [
        _height(tetrahedra.positions, triangles, tetrahedra.vertices[tetrahedron, vertex])
        for tetrahedron, vertex in ((first, opposite), (second, back))
    ]
    # The two apices lie on different sides. Of a flat tetrahedron the side is a matter of rounding, so ask the other.
    flipped = np.where(np.abs(apex_heights[0]) > np.abs(apex_heights[1]), apex_heights[0] > 0, apex_heights[1] < 0)
    triangles = np.where(flipped[:, None], triangles[:, ::-1], triangles)
    return Faces(triangles, np.stack([first, second], axis=1).astype(np.int64))


def face_capacities(faces: Faces, vertices: QuadricVertices, *, grid: int) -> tuple[FloatArray, FloatArray]:
    """Return what it costs to cut each face with its first, and with its second tetrahedron inside.

    Parameters
    ----------
    faces
        F faces without corners of the cube.
    vertices
        The vertices of the faces.
    grid
        Number of cells along the cube's side; weighs distances against angles.

    Returns
    -------
    first_inside, second_inside
        ``(F,)`` float64: the squared distances of each vertex from the other two vertices' planes, in squared cells
        up to a constant, plus the squared sum of the angles between the outward normal of the face and those of its
        vertices, in units of 1.5 radians.
    """
    corners = vertices.positions[faces.vertices]
    homogeneous = np.concatenate([corners, np.ones((*corners.shape[:2], 1))], axis=2)
    quadrics = vertices.quadrics[faces.vertices]
    # Each vertex's quadric at all three vertices of the face, without its own value.
    values = np.einsum("fjk,fikl,fjl->fij", homogeneous, quadrics, homogeneous)
    values[:, range(3), range(3)] = 0
    distance = grid**2 * np.maximum(values, 0).sum(axis=(1, 2))

    face_normals = _unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    cosines = np.einsum("fj,fij->fi", face_normals, _unit(vertices.normals[faces.vertices]))
    angles = np.arccos(np.clip(cosines, -1, 1)).sum(axis=1)
    return distance + (angles / ANGLE_UNIT) ** 2, distance + ((3 * np.pi - angles) / ANGLE_UNIT) ** 2


def cut_surface(tetrahedra: Tetrahedra, vertices: QuadricVertices, tags: Tags, *, grid: int) -> IntArray:
    """Separate the inside from the outside tetrahedra by the cheapest set of faces.

    The surface bounds a set of Delaunay tetrahedra: it is closed and free of self-intersection. Edges or vertices in
    which two parts of it touch are possible.

    Parameters
    ----------
    tetrahedra
        T tetrahedra.
    vertices
        Their vertices without the corners of the cube.
    tags
        ``(T,)``, who is inside and who is outside for sure.
    grid
        See `face_capacities`.

    Returns
    -------
    ndarray
        ``(F, 3)`` int64, counter-clockwise seen from outside.

    Raises
    ------
    ShapeError
        If no tetrahedron is inside.
    """
    if not (tags == INSIDE).any():
        raise ShapeError(f"ponq: the cut is empty, none of {len(tags)} tetrahedra is inside; give more sites")
    faces = collect_faces(tetrahedra)
    inside = _minimum_cut(tags, faces, vertices, grid=grid)
    first_inside, second_inside = inside[faces.sides].T
    return np.vstack(
        [faces.vertices[first_inside & ~second_inside], faces.vertices[second_inside & ~first_inside][:, ::-1]]
    )


def _minimum_cut(tags: Tags, faces: Faces, vertices: QuadricVertices, *, grid: int) -> npt.NDArray[np.bool_]:
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    # All that is inside for sure is the source, node 0; all that is outside for sure, the sink, node 1.
    nodes = np.arange(len(tags)) + 2
    nodes[tags == INSIDE], nodes[tags == OUTSIDE] = 0, 1
    sides = nodes[faces.sides]
    open_faces = sides[:, 0] != sides[:, 1]  # without corners of the cube: what touches one is outside
    capacities = np.concatenate(
        face_capacities(Faces(faces.vertices[open_faces], sides[open_faces]), vertices, grid=grid)
    )
    origins, targets = np.concatenate([sides[open_faces], sides[open_faces, ::-1]]).T
    useful = (targets != 0) & (origins != 1)
    capacities, origins, targets = capacities[useful], origins[useful], targets[useful]

    # SciPy's flow counts in 32-bit integers. No more can flow than leaves the source; the unit is chosen after that.
    scale = LARGEST_FLOW / float(capacities[origins == 0].sum())
    units = np.minimum(capacities * scale, LARGEST_FLOW).astype(np.int64)
    network = csr_array((units, (origins, targets)), shape=(len(tags) + 2, len(tags) + 2))
    network.data = np.minimum(network.data, LARGEST_FLOW).astype(np.int32)
    # An edge that is full has a residual of zero, which the search would take for an edge if it were stored.
    residual = csr_array(network - maximum_flow(network, 0, 1).flow)
    residual.eliminate_zeros()
    inside = np.zeros(len(tags) + 2, dtype=bool)
    inside[breadth_first_order(residual, 0, return_predecessors=False)] = True
    return inside[nodes]


def _height(positions: FloatArray, triangles: IntArray, apices: IntArray) -> FloatArray:
    """Return six times the signed volume of a triangle and an apex, positive on its counter-clockwise side."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    height: FloatArray = np.einsum("ij,ij->i", np.cross(b - a, c - a), positions[apices] - a)
    return height


def _unit(vectors: FloatArray) -> FloatArray:
    """Scale to unit length; a zero vector stays, and is at a right angle to everything."""
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    scaled: FloatArray = vectors / np.where(lengths > 0, lengths, 1.0)
    return scaled
