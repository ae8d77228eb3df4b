"""Pictures of balls, coloured by their radius on a scale that several shapes share."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from morphoskel.reporting.figure_page import DISTANCE_MAP, paint
from morphoskel.reporting.figures.panels import Scale
from morphoskel.reporting.render import Canvas, Image, View
from morphoskel.shapes import FloatArray, Mesh, Skeleton

RADIUS_SCALE = Scale(0, 1, DISTANCE_MAP, "ball radius, relative to the largest of the shape")
"""Of each shape by itself: units differ between data sets, and one thick shape would leave one colour to the others."""

POINT_COLOUR = (0.88, 0.36, 0.1)
"""Of the cloud's points; it is far from every colour of the scale, dark or light."""

POINT_SIZE = 0.0035
"""Radius of a point of the cloud, in sides of the picture."""


def joint_bounds(boxes: Iterable[npt.ArrayLike]) -> FloatArray:
    """Return the smallest box around boxes, ``(2, 3)`` each."""
    corners = np.stack([np.asarray(box, dtype=np.float64) for box in boxes])
    return np.stack([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])


def draw_balls(
    skeleton: Skeleton,
    view: View,
    bounds: npt.ArrayLike,
    *,
    largest: float | None = None,
    points: FloatArray | None = None,
    veil: Mesh | None = None,
) -> Image:
    """Draw the balls of a skeleton.

    Parameters
    ----------
    skeleton
        At least one ball.
    view
        The camera.
    bounds
        ``(2, 3)``, the box that the picture covers.
    largest
        The radius at the end of the scale; that of the largest ball if ``None``.
    points
        ``(N, 3)``, of the cloud, drawn as dots; ``None`` for none.
    veil
        A surface laid over them; ``None`` for none.

    Returns
    -------
    ndarray
        ``(pixels, pixels, 3)`` float64 in [0, 1], on white.
    """
    canvas = Canvas(view, bounds)
    high = float(skeleton.radii.max()) if largest is None else largest
    colours = paint(skeleton.radii, 0, high, RADIUS_SCALE.colour_map)
    canvas.add_balls(skeleton.points, skeleton.radii, colours)
    if points is not None:
        canvas.add_points(points, POINT_COLOUR, POINT_SIZE)
    if veil is not None:
        canvas.add_veil(veil)
    return canvas.image()


def draw_in_surface(
    surface: Mesh | str,
    skeleton: Skeleton | str,
    view: View,
    bounds: npt.ArrayLike,
    *,
    largest: float | None = None,
) -> Image | str:
    """Draw the balls of a skeleton under the veil of its surface, see :func:`draw_balls`.

    Without a surface there is no veil; the words in the place of a skeleton are returned as they are.
    """
    if isinstance(skeleton, str):
        return skeleton
    return draw_balls(skeleton, view, bounds, largest=largest, veil=None if isinstance(surface, str) else surface)
