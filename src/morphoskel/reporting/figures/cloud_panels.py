"""Pictures of clouds whose points are balls, large enough to close up to a surface."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.reporting.render import Canvas, Image, View
from morphoskel.shapes import FloatArray

NEIGHBOUR = 4
"""The neighbour at whose distance the points of a surface count as next to each other."""

OVERLAP = 0.65
"""Radius of a point, in median distances to that neighbour: a little more than half of it closes the gaps."""


def draw_cloud(points: FloatArray, colours: npt.ArrayLike, view: View) -> Image:
    """Draw the points of a cloud as balls that touch their neighbours.

    Parameters
    ----------
    points
        ``(N, 3)``.
    colours
        ``(N, 3)`` or ``(3,)``, red, green and blue in [0, 1].
    view
        The camera.

    Returns
    -------
    ndarray
        ``(pixels, pixels, 3)`` float64 in [0, 1], on white.
    """
    radius = touching_radius(points)
    canvas = Canvas(view, [points.min(axis=0) - radius, points.max(axis=0) + radius])
    canvas.add_balls(points, radius, colours)
    return canvas.image()


def touching_radius(points: FloatArray) -> float:
    """Return the radius at which most points ``(N, 3)`` of a surface overlap their neighbours; 0 for equal points."""
    from scipy.spatial import KDTree

    distinct = np.unique(points, axis=0)
    if len(distinct) == 1:
        return 0.0
    # The first of the nearest ones is the point itself.
    distances, _ = KDTree(distinct).query(distinct, k=[min(NEIGHBOUR + 1, len(distinct))])
    return OVERLAP * float(np.median(distances))
