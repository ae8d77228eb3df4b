"""Give inner points that met no other front the depth of their neighbours on the surface."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray
from morphoskel.skeleton.dpc.sinking import Sinking

NEIGHBOURS = 24
"""Nearest samples that a depth is taken from, as in the released program."""
ROUNDS = 5
"""Times that depths are handed on, as in the released program."""


def complete_depths(samples: FloatArray, sinking: Sinking) -> FloatArray:
    """Return a depth for every sample.

    A point that still moved takes the least depth among its nearest samples whose points have stopped. This is
    repeated, as each round makes more depths known. What five rounds do not reach takes the depth of the nearest sample
    that has one.

    Parameters
    ----------
    samples
        ``(N, 3)`` float64.
    sinking
        Depths, and which of them are final.

    Returns
    -------
    ndarray
        ``(N,)`` float64, in the shape's units.

    Raises
    ------
    ShapeError
        If no inner point stopped, as on an open sheet whose normals all point to one side.
    """
    from scipy.spatial import cKDTree

    known = sinking.stopped.copy()
    if not known.any():
        raise ShapeError(
            f"none of the {len(samples)} inner points met an opposite side, so the cloud has no inside; "
            "check that it is closed and that its normals point outward"
        )
    depths = np.where(known, sinking.depths, np.inf)
    _, neighbours = cKDTree(samples).query(samples, k=min(NEIGHBOURS + 1, len(samples)))
    for _ in range(ROUNDS):
        least = depths[neighbours].min(axis=1)
        depths = np.where(known, depths, least)
        known = np.isfinite(depths)
        if known.all():
            return depths
    _, nearest = cKDTree(samples[known]).query(samples[~known])
    depths[~known] = depths[known][nearest]
    return depths
