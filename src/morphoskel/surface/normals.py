"""Complete the normals of a cloud, for the reconstructions that need them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, PointCloud

NEIGHBOURS = 16
"""Points that a tangent plane is fitted to, enough to average out sampling noise on 2000-point clouds."""


def complete_normals(cloud: PointCloud) -> FloatArray:
    """Return a unit normal for every point.

    Known normals are kept (scaled to unit length). Where some are unknown (zero rows), a tangent plane is
    fitted and turned to the side of the nearest known normal. Where all are unknown, planes are fitted and
    oriented along a spanning tree, then turned outward as a whole.

    Parameters
    ----------
    cloud
        Any cloud, with or without normals.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64, unit length.

    Raises
    ------
    ShapeError
        If normals are missing and the points span no volume.
    """
    if cloud.normals is None:
        return _estimate_oriented(cloud.points)
    lengths = np.linalg.norm(cloud.normals, axis=1)
    known = lengths > 0
    if not known.any():
        return _estimate_oriented(cloud.points)
    normals = cloud.normals / np.where(known, lengths, 1.0)[:, None]
    if not known.all():
        normals[~known] = _fill_unknown(cloud.points, normals, known)
    return normals


def _fill_unknown(points: FloatArray, normals: FloatArray, known: npt.NDArray[np.bool_]) -> FloatArray:
    from scipy.spatial import cKDTree

    _, nearest = cKDTree(points[known]).query(points[~known])
    reference = normals[known][nearest]
    planes: FloatArray = _fit_tangent_planes(points)[~known]
    planes[np.einsum("ij,ij->i", planes, reference) < 0] *= -1
    return planes


def _fit_tangent_planes(points: FloatArray) -> FloatArray:
    """Return an unoriented unit normal a point: the direction of least variance among its neighbours."""
    from scipy.spatial import cKDTree

    _, neighbours = cKDTree(points).query(points, k=min(NEIGHBOURS, len(points)))
    patches = points[neighbours] - points[neighbours].mean(axis=1, keepdims=True)
    _, _, axes = np.linalg.svd(patches, full_matrices=False)
    planes: FloatArray = axes[:, -1, :]
    return planes


def _estimate_oriented(points: FloatArray) -> FloatArray:
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    cloud.normals = open3d.utility.Vector3dVector(_fit_tangent_planes(points))
    try:
        cloud.orient_normals_consistent_tangent_plane(min(NEIGHBOURS, len(points) - 1))
    except RuntimeError as error:  # Qhull's, which spans the tree along which normals are oriented
        raise ShapeError(
            f"normals: the missing normals of {len(points)} points cannot be oriented; do the points all lie in one "
            "plane, or on one small sphere? Give their normals, or a cloud of a solid shape"
        ) from error
    normals: FloatArray = np.array(cloud.normals, dtype=np.float64)
    # The divergence theorem on the whole cloud: the sum of p . n is positive where normals point outward.
    outward = float(np.sum((points - points.mean(axis=0)) * normals))
    if outward < 0:
        np.negative(normals, out=normals)
    return normals
