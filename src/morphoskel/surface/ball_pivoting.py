"""Ball pivoting (Bernardini et al. 1999)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.shapes import PointCloud
from morphoskel.surface.normals import complete_normals

if TYPE_CHECKING:
    import open3d


def reconstruct_ball_pivoting(
    cloud: PointCloud, *, radius_factors: Sequence[float] = (3.0, 6.0), maximum_triangles: int = 100_000
) -> open3d.geometry.TriangleMesh:
    """Roll balls over the cloud and keep the triangles on which they rest.

    Parameters
    ----------
    cloud
        Points on the surface; missing normals are completed.
    radius_factors
        Ball radii, in units of the mean distance between a point and its nearest neighbour; 3 and 6 in the
        released code.
    maximum_triangles
        A larger mesh is decimated to this many.

    Returns
    -------
    open3d.geometry.TriangleMesh
        Open where the cloud is sparse; free of degenerate, duplicated and non-manifold elements.
    """
    import open3d

    oriented = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud.points))
    oriented.normals = open3d.utility.Vector3dVector(complete_normals(cloud))
    spacing = float(np.asarray(oriented.compute_nearest_neighbor_distance()).mean())
    radii = open3d.utility.DoubleVector([factor * spacing for factor in radius_factors])
    mesh = open3d.geometry.TriangleMesh.create_from_point_cloud_ball_pivoting(oriented, radii)
    if len(mesh.triangles) > maximum_triangles:
        mesh = mesh.simplify_quadric_decimation(maximum_triangles)
    mesh.remove_degenerate_triangles()
    mesh.remove_duplicated_triangles()
    mesh.remove_duplicated_vertices()
    mesh.remove_non_manifold_edges()
    return mesh
