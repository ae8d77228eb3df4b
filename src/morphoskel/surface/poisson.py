"""Screened Poisson reconstruction (Kazhdan and Hoppe 2013)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from morphoskel.shapes import PointCloud
from morphoskel.surface.normals import complete_normals

if TYPE_CHECKING:
    import open3d


def reconstruct_poisson(cloud: PointCloud, *, depth: int = 8) -> open3d.geometry.TriangleMesh:
    """Fit an indicator function to the oriented points and extract its surface, without trimming.

    Parameters
    ----------
    cloud
        Points on the surface; missing normals are completed.
    depth
        Octree depth; 8 in the released code.

    Returns
    -------
    open3d.geometry.TriangleMesh
        Closed except where the octree's box cuts it.
    """
    import open3d

    oriented = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud.points))
    oriented.normals = open3d.utility.Vector3dVector(complete_normals(cloud))
    # One thread: the solver's sums depend on their order, and the shapes of a shard run side by side anyway.
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(oriented, depth=depth, n_threads=1)
    return mesh
