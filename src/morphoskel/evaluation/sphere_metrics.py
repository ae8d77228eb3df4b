"""How well a set of balls explains a surface: the Chamfer and Hausdorff distance between points and spheres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.errors import InputError
from morphoskel.evaluation.protocol import EvaluationProtocol, check_protocol

if TYPE_CHECKING:
    from morphoskel.shapes import FloatArray


@dataclass(frozen=True)
class SphereDistances:
    """The distances between the surface points and the spheres of one shape, as far as both protocols need them.

    Parameters
    ----------
    surface_points, spheres
        Numbers of points and of spheres, each at least 1.
    point_to_sphere_sum, point_to_sphere_max
        Sum and maximum over the points of the distance to the sphere with the nearest centre, in the shape's units.
    sphere_to_point_sum, sphere_to_point_max
        Sum and maximum over the spheres of the distance to the surface point nearest to the centre.
    """

    surface_points: int
    spheres: int
    point_to_sphere_sum: float
    point_to_sphere_max: float
    sphere_to_point_sum: float
    sphere_to_point_max: float


def sphere_distances(surface_points: FloatArray, centres: FloatArray, radii: FloatArray) -> SphereDistances:
    """Measure the unsquared Euclidean distances between surface points and spheres, both ways.

    A point ``p`` belongs to the sphere with the nearest *centre* ``c``, which need not be the nearest sphere, and lies
    ``| |p - c| - r |`` away from it. A sphere lies ``| |c - q| - r |`` away from the surface point ``q`` that is
    nearest to its centre. With all radii 0 these are the distances between two sets of points.

    Parameters
    ----------
    surface_points
        ``(N, 3)`` float64, finite, N >= 1.
    centres
        ``(K, 3)`` float64, finite, K >= 1.
    radii
        ``(K,)`` float64, finite, at least 0, in the same units.

    Returns
    -------
    SphereDistances
        Exact up to floating-point rounding.

    Raises
    ------
    InputError
        If an array is empty, has the wrong shape, or holds values that are not finite, or if a radius is negative.

    Notes
    -----
    The rule of the nearest centre is that of the evaluation released with the paper and of the loss of Point2Skeleton
    [1]_. If two centres are equally near to a point, either may be taken.

    References
    ----------
    .. [1] C. Lin et al., "Point2Skeleton: Learning Skeletal Representations from Point Clouds", CVPR 2021.
    """
    from scipy.spatial import KDTree

    surface_points = _check_rows(surface_points, "surface_points")
    centres = _check_rows(centres, "centres")
    radii = np.asarray(radii, dtype=np.float64)
    if radii.shape != (len(centres),):
        raise InputError(f"radii: expected shape ({len(centres)},), one a centre, got {radii.shape}")
    if not np.isfinite(radii).all() or (radii < 0).any():
        raise InputError("radii: every value must be finite and at least 0")

    point_to_sphere = point_to_sphere_distances(surface_points, centres, radii)
    to_point, _ = KDTree(surface_points).query(centres)
    sphere_to_point = np.abs(to_point - radii)
    return SphereDistances(
        surface_points=len(surface_points),
        spheres=len(centres),
        point_to_sphere_sum=float(point_to_sphere.sum()),
        point_to_sphere_max=float(point_to_sphere.max()),
        sphere_to_point_sum=float(sphere_to_point.sum()),
        sphere_to_point_max=float(sphere_to_point.max()),
    )


def point_to_sphere_distances(surface_points: FloatArray, centres: FloatArray, radii: FloatArray) -> FloatArray:
    """Return the distance of each surface point to the sphere with the nearest centre, ``(N,)`` float64.

    See :func:`sphere_distances`, whose first sum and maximum these are; here the arrays are not checked.
    """
    from scipy.spatial import KDTree

    to_centre, nearest = KDTree(centres).query(surface_points)
    distances: FloatArray = np.abs(to_centre - radii[nearest])
    return distances


def mean_point_to_sphere(distances: SphereDistances) -> float:
    """Return the first term of the Chamfer distance: the mean distance of a surface point to its sphere."""
    return distances.point_to_sphere_sum / distances.surface_points


def mean_sphere_to_point(distances: SphereDistances, protocol: EvaluationProtocol) -> float:
    """Return the second term of the Chamfer distance: the mean distance of a sphere to its surface point.

    The protocol ``released`` divides by the number of surface points instead of the number of spheres, which makes
    the term of 1024 spheres and 2000 points about half as large as it is.
    """
    check_protocol(protocol)
    divisor = distances.surface_points if protocol == "released" else distances.spheres
    return distances.sphere_to_point_sum / divisor


def cd_recon(distances: SphereDistances, protocol: EvaluationProtocol) -> float:
    """Return the Chamfer distance: the sum of both mean distances (see :func:`mean_sphere_to_point`)."""
    return mean_point_to_sphere(distances) + mean_sphere_to_point(distances, protocol)


def hd_recon(distances: SphereDistances) -> float:
    """Return the Hausdorff distance: the largest distance of all, either way. Both protocols agree on it."""
    return max(distances.point_to_sphere_max, distances.sphere_to_point_max)


def _check_rows(array: FloatArray, name: str) -> FloatArray:
    """Return `array` if it is ``(N, 3)`` with N >= 1 and finite, or say why not."""
    rows = np.asarray(array, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3 or len(rows) == 0:
        raise InputError(f"{name}: expected shape (N, 3) with N >= 1, got {rows.shape}")
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise InputError(f"{name}: {len(bad)} of {len(rows)} rows are not finite, the first is row {bad[0]}")
    return rows
