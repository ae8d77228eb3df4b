"""Rebuild a surface from a point cloud (paper, supplement on surface reconstruction)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.errors import ConfigError, ShapeError
from morphoskel.native_output import native_output_logged
from morphoskel.placement import check_extent
from morphoskel.shapes import Mesh, PointCloud
from morphoskel.surface.alpha_shape import reconstruct_alpha_shape
from morphoskel.surface.ball_pivoting import reconstruct_ball_pivoting
from morphoskel.surface.poisson import reconstruct_poisson
from morphoskel.surface.ponq import reconstruct_ponq
from morphoskel.surface.repair import Repair, repair_surface

if TYPE_CHECKING:
    import open3d

METHODS: dict[str, Callable[..., open3d.geometry.TriangleMesh | Mesh]] = {
    "poisson": reconstruct_poisson,
    "ball_pivoting": reconstruct_ball_pivoting,
    "alpha_shape": reconstruct_alpha_shape,
    "ponq": reconstruct_ponq,
}

REPAIRED = "repaired_poisson"
"""Poisson, compared with the cloud and mended: our own addition."""

SURFACES = (*METHODS, REPAIRED)
"""All reconstructions by name."""


def reconstruct(cloud: PointCloud, method: str = "poisson", *, seed: int = 0, **settings: Any) -> Mesh:
    """Rebuild a surface by one of the methods that the paper compares, or by repaired Poisson.

    Parameters
    ----------
    cloud
        Points on the surface; missing normals are completed.
    method
        One of :data:`SURFACES`.
    seed
        Of PoNQ, which draws its sites; the others are deterministic.
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
        If the cloud is too large or too small for single precision, or the method finds no surface.
    """
    check_extent(cloud)
    if method == REPAIRED:
        return reconstruct_repaired(cloud, **settings).mesh
    if method not in METHODS:
        raise ConfigError(f"surface: no such reconstruction {method!r}; legal are {', '.join(SURFACES)}")
    if method == "ponq":
        settings = {**settings, "seed": seed}
    with native_output_logged(method):
        mesh = METHODS[method](cloud, **settings)
    if len(mesh.triangles) == 0:
        raise ShapeError(
            f"{method}: no triangle was found on {cloud!r}; the points may be too sparse for its settings {settings}"
        )
    return mesh if isinstance(mesh, Mesh) else Mesh(np.asarray(mesh.vertices), np.asarray(mesh.triangles))


def reconstruct_repaired(cloud: PointCloud, *, depth: int = 8) -> Repair:
    """Rebuild a surface by Poisson reconstruction and mend it, see :func:`repair_surface`."""
    return repair_surface(reconstruct(cloud, "poisson", depth=depth), cloud)
