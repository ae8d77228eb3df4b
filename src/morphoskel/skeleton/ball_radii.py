"""Radii of skeletal balls from methods that find only the centres."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from morphoskel.errors import ConfigError, InputError
from morphoskel.shapes import FloatArray

RadiusKind = Literal["nearest", "mean_assigned"]


def radii_of(centres: FloatArray, points: FloatArray, kind: RadiusKind = "nearest") -> FloatArray:
    """Return the radii of balls from the points of the surface around their centres.

    Parameters
    ----------
    centres
        ``(K, 3)`` float64.
    points
        ``(N, 3)`` float64, on the surface, at least one.
    kind
        ``"nearest"``: distance to the nearest point, so that the ball touches the surface from inside.
        ``"mean_assigned"``: mean distance of the points for which this centre is the nearest; a centre that is the
        nearest of no point takes the distance to its nearest point instead. Where a section is elongated, the second
        covers the surface better, but its balls stick out.

    Returns
    -------
    ndarray
        ``(K,)`` float64, in the unit of the coordinates.

    Raises
    ------
    ConfigError
        If `kind` is neither.
    InputError
        If there is no point.
    """
    from scipy.spatial import cKDTree

    if kind not in get_args(RadiusKind):
        raise ConfigError(f"radius: expected one of {', '.join(get_args(RadiusKind))}, got {kind!r}")
    if len(points) == 0:
        raise InputError("radii of balls: there is no point on the surface to measure them from")
    if len(centres) == 0:
        return np.empty(0)
    nearest = np.asarray(cKDTree(points).query(centres)[0])
    if kind == "nearest":
        return nearest
    distances, owners = cKDTree(centres).query(points)
    counts = np.bincount(owners, minlength=len(centres))
    sums = np.bincount(owners, weights=distances, minlength=len(centres))
    return np.where(counts > 0, sums / np.maximum(counts, 1), nearest)
