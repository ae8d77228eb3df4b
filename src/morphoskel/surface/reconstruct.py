"""Rebuild a surface from a point cloud (paper, supplement on surface reconstruction)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.errors import ConfigError, ShapeError
from morphoskel.native_output import native_output_logged
from morphoskel.shapes import Mesh, PointCloud
from morphoskel.surface.alpha_shape import reconstruct_alpha_shape
from morphoskel.surface.ball_pivoting import reconstruct_ball_pivoting
from morphoskel.surface.poisson import reconstruct_poisson

if TYPE_CHECKING:
    import open3d

METHODS: dict[str, Callable[..., open3d.geometry.TriangleMesh]] = {
    "poisson": reconstruct_poisson,
    "ball_pivoting": reconstruct_ball_pivoting,
    "alpha_shape": reconstruct_alpha_shape,
}


def reconstruct(cloud: PointCloud, method: str = "poisson", **settings: Any) -> Mesh:
    """Rebuild a surface by one of the methods that the paper compares.

    Parameters
    ----------
    cloud
        Points on the surface; missing normals are completed.
    method
        ``poisson``, ``ball_pivoting`` or ``alpha_shape``.
    settings
        Passed to the method, see its function.

    Returns
    -------
    Mesh
        Possibly open, possibly several pieces.

    Raises
    ------
    ConfigError
        If there is no such method.
    ShapeError
        If the method finds no surface.
    """
    if method not in METHODS:
        raise ConfigError(f"surface: no such reconstruction {method!r}; legal are {', '.join(METHODS)}")
    with native_output_logged(method):
        mesh = METHODS[method](cloud, **settings)
    if len(mesh.triangles) == 0:
        raise ShapeError(
            f"{method}: no triangle was found on {cloud!r}; the points may be too sparse for its settings {settings}"
        )
    return Mesh(np.asarray(mesh.vertices), np.asarray(mesh.triangles))
