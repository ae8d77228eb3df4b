"""Alpha shapes (Edelsbrunner and Mücke 1994)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from morphoskel.shapes import PointCloud

if TYPE_CHECKING:
    import open3d


def reconstruct_alpha_shape(
    cloud: PointCloud, *, alpha: float = 0.09, unit: Literal["radius", "absolute"] = "radius"
) -> open3d.geometry.TriangleMesh:
    """Keep what a ball of radius `alpha` cannot carve away from the Delaunay tetrahedra.

    Parameters
    ----------
    cloud
        Points on the surface; normals are not used.
    alpha
        Radius of the carving ball; 0.09 in the released code.
    unit
        ``radius``: `alpha` is relative to the largest distance of a point from the centre of the cloud's box,
        so that the result does not depend on the scale. ``absolute``: as released, in the cloud's own unit.

    Returns
    -------
    open3d.geometry.TriangleMesh
        The boundary of the alpha shape.
    """
    import open3d

    points = cloud.points
    if unit == "radius":
        centre = (points.min(axis=0) + points.max(axis=0)) / 2
        alpha = alpha * float(np.linalg.norm(points - centre, axis=1).max())
    unoriented = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    return open3d.geometry.TriangleMesh.create_from_point_cloud_alpha_shape(unoriented, alpha)
