"""Bring skeletons to the same number of balls, since more balls explain a surface better whatever their quality."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import Skeleton
from morphoskel.skeleton.interpolation import interpolate_balls
from morphoskel.skeleton.thinning import farthest_points


def bring_to_count(skeleton: Skeleton, count: int, generator: np.random.Generator, *, ranked: bool) -> Skeleton:
    """Return a skeleton of `count` balls.

    Parameters
    ----------
    skeleton
        Any skeleton with at least one ball.
    count
        Balls wanted.
    generator
        Source of the positions of new balls.
    ranked
        Whether each first part of the balls is the method's answer for so many balls. Then surplus balls are cut
        off; else the balls farthest from each other are kept, starting from the first.

    Returns
    -------
    Skeleton
        Balls that are missing are interpolated on the skeleton's curves and sheets.

    Raises
    ------
    InputError
        If balls are missing and the skeleton has neither curves nor sheets.
    """
    if len(skeleton) == count:
        return skeleton
    if len(skeleton) < count:
        if not len(skeleton.edges) and not len(skeleton.triangles):
            raise InputError(f"has {len(skeleton)} balls, and no curves or sheets to add {count - len(skeleton)} on")
        return interpolate_balls(skeleton, count, generator)
    kept = np.arange(count) if ranked else farthest_points(skeleton.points, count)
    residues = None if skeleton.residues is None else skeleton.residues[kept]
    return Skeleton(skeleton.points[kept], skeleton.radii[kept], residues)
