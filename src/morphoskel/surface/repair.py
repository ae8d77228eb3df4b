"""Compare a rebuilt surface with its cloud, both ways, and mend what contradicts it.

Where normals contradict each other, or where two sheets of a thin part lie closer together than the points, Poisson
reconstruction loses sheets and closes the wrong side. The damage shows in the cloud itself: points far from the
surface, and surface far from the points. Normals are not used here, since they are what cannot be trusted.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud

MISSED = 2.0
"""A point farther than this from the surface is missed by it. All distances are in mean distances between a point and
its nearest neighbour; for points spread at random, the widest gaps between them are about 3."""

FAR = 4.0
"""A triangle farther than this from every point is surface that the cloud does not know of."""

BURIED_SHARE = 0.005
"""More points than this, missed and inside the surface, say that a cavity was filled."""

ALPHA = 3.0
"""Radius of the alpha shape that mends a sheet, wide enough to pass the gaps between points."""

REACH = 6.0
"""Points no farther apart than this may be joined by a strand."""


@dataclass(frozen=True)
class Repair:
    """A mended surface and what was done to it.

    Parameters
    ----------
    mesh
        The surface; a triangle soup where it was mended, to be closed afterwards.
    missed, buried
        Points of the cloud that the surface missed, and those of them that lay inside it.
    removed, added
        Triangles.
    """

    mesh: Mesh
    missed: int
    buried: int
    removed: int
    added: int

    @property
    def reason(self) -> str:
        """What was wrong: ``none``, ``missed points``, ``filled cavity``, or both."""
        found = ["filled cavity"] * (self.removed > 0) + ["missed points"] * (self.added > 0)
        return " and ".join(found) or "none"


def repair_surface(mesh: Mesh, cloud: PointCloud) -> Repair:
    """Mend a rebuilt surface so that no point of its cloud is far from it.

    If points lie deep inside the surface, a cavity was filled: triangles far from all points are removed. Far
    triangles elsewhere stay, for they may well close a hole in the cloud. Then the sheets that run through missed
    points are added: triangles of the alpha shape of the cloud, strands between neighbours where the cloud is a line,
    and a speck for a point by itself.

    Parameters
    ----------
    mesh
        The rebuilt surface.
    cloud
        What it was rebuilt from. Normals are not used.

    Returns
    -------
    Repair
        The mesh itself, if nothing contradicts it.

    Raises
    ------
    ShapeError
        If a surface has to be mended and the points all lie in one plane.
    """
    from scipy.spatial import KDTree

    points = cloud.points
    tree = KDTree(points)
    spacing = mean_spacing(points)
    missed = _distances(mesh, points) > MISSED * spacing
    buried = int(_inside(mesh, points[missed]).sum()) if missed.any() else 0
    kept = mesh.triangles
    if buried > BURIED_SHARE * len(points):
        to_point, _ = tree.query(mesh.vertices[kept].mean(axis=1))
        kept = kept[to_point <= FAR * spacing]
    left = np.ones(len(points), dtype=np.bool_)
    if len(kept):
        left = _distances(Mesh(mesh.vertices, kept), points) > MISSED * spacing
    vertices, triangles = patch(points, left, spacing)
    soup = np.vstack([kept, triangles + len(mesh.vertices)])
    return Repair(
        mesh=Mesh(np.vstack([mesh.vertices, vertices]), soup),
        missed=int(missed.sum()),
        buried=buried,
        removed=len(mesh.triangles) - len(kept),
        added=len(triangles),
    )


def mean_spacing(points: FloatArray) -> float:
    """Return the mean distance between a point and the nearest other; repeated points count once."""
    from scipy.spatial import KDTree

    distinct = np.unique(points, axis=0)
    distances, _ = KDTree(distinct).query(distinct, k=[2])
    return float(np.mean(distances))


def patch(points: FloatArray, missed: npt.NDArray[np.bool_], spacing: float) -> tuple[FloatArray, IntArray]:
    """Return triangles that run through missed points.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, the whole cloud.
    missed
        ``(N,)`` bool, points that need a surface.
    spacing
        Mean distance between neighbours.

    Returns
    -------
    vertices
        ``(V, 3)`` float64: the points, then corners of specks.
    triangles
        ``(T, 3)`` int64 indices of vertices; each touches a missed point.
    """
    from scipy.spatial import KDTree

    if not missed.any():
        return np.empty((0, 3)), np.empty((0, 3), dtype=np.int64)
    sheets = _alpha_triangles(points, ALPHA * spacing)
    sheets = sheets[missed[sheets].any(axis=1)]
    bare = np.flatnonzero(missed & ~np.isin(np.arange(len(points)), sheets))
    if len(bare) == 0:
        return points, sheets
    found = KDTree(points).query(points[bare], k=[2, 3])
    distances, neighbours = np.asarray(found[0]), np.asarray(found[1])
    joined = distances[:, 1] <= REACH * spacing
    strands = np.column_stack([bare, neighbours])[joined]
    corners = spacing / 2 * np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3)
    specks = points[bare[~joined], None] + corners
    faces = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    starts = len(points) + 4 * np.arange(len(specks))
    tetrahedra = (starts[:, None, None] + faces).reshape(-1, 3)
    return np.vstack([points, specks.reshape(-1, 3)]), np.vstack([sheets, strands, tetrahedra])


def _alpha_triangles(points: FloatArray, alpha: float) -> IntArray:
    """Return the Delaunay triangles with a circumradius below `alpha`."""
    from scipy.spatial import Delaunay, QhullError

    try:
        corners = Delaunay(points).simplices
    except QhullError as error:
        raise ShapeError(
            "repair: the points lie in one plane, which encloses no volume; use the surface alpha_shape or poisson"
        ) from error
    faces = np.vstack([np.delete(corners, corner, axis=1) for corner in range(4)])
    faces = np.unique(np.sort(faces, axis=1), axis=0).astype(np.int64)
    a, b, c = points[faces].transpose(1, 0, 2)
    sides = np.linalg.norm([b - c, c - a, a - b], axis=2)
    doubled_area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen: IntArray = faces[np.prod(sides, axis=0) < 2 * alpha * doubled_area]
    return chosen


def _distances(mesh: Mesh, points: FloatArray) -> npt.NDArray[np.float32]:
    from morphoskel.volume import SurfaceDistance

    return SurfaceDistance(mesh)(points.astype(np.float32))


def _inside(mesh: Mesh, points: FloatArray) -> npt.NDArray[np.bool_]:
    """Return which points lie inside, by the majority of three rays: the surface may have holes."""
    import open3d

    tensor: Any = open3d.core.Tensor
    scene: Any = open3d.t.geometry.RaycastingScene(nthreads=1)
    vertices, triangles = mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32)
    scene.add_triangles(tensor(vertices), tensor(triangles))
    queries = tensor(points.astype(np.float32))
    inside: npt.NDArray[np.bool_] = scene.compute_occupancy(queries, nsamples=3).numpy() > 0.5
    return inside
