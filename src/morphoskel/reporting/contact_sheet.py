"""Contact sheets: many shapes of a data set on one page, coloured by part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.reporting.render import Image, View, render_balls, render_mesh
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud, Skeleton

PART_COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb")
"""Tol's bright scheme, which people with any colour vision can tell apart; parts beyond its end begin anew."""

TILE_INCHES = 1.6

POINT_SIZE = 0.012
"""Radius of the ball that stands for a point, relative to the longest side of the cloud's box."""

FROM_THE_FRONT = View(azimuth=235.0, elevation=22.0, pixels=240)
"""The published clouds have y up and face negative z."""


def draw_contact_sheet(
    shapes: Mapping[str, Sequence[PointCloud | tuple[Mesh, IntArray]]], path: Path, *, view: View = FROM_THE_FRONT
) -> None:
    """Draw one row of pictures a category.

    Parameters
    ----------
    shapes
        For each category its shapes: a cloud, or a mesh with the ``(T,)`` part label of each triangle.
    path
        The PNG to write.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape to draw.
    """
    if not any(len(row) for row in shapes.values()):
        raise InputError("a contact sheet needs at least one shape; the mapping given holds none")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    columns = max(len(row) for row in shapes.values())
    figure = Figure(figsize=(TILE_INCHES * columns, (TILE_INCHES + 0.2) * len(shapes)), layout="constrained")
    FigureCanvasAgg(figure)
    tiles = figure.subplots(len(shapes), columns, squeeze=False)
    for axes_row, (category, row) in zip(tiles, shapes.items(), strict=True):
        first_label = min(int(_labels(shape).min()) for shape in row) if row else 0
        for axes in axes_row:
            axes.set_axis_off()
        for axes, shape in zip(axes_row, row, strict=False):
            axes.imshow(_draw_shape(shape, view, first_label), interpolation="antialiased")
        axes_row[0].set_title(category, loc="left", fontsize=9)
    with atomic_file(path) as partial:
        figure.savefig(partial, dpi=view.pixels / TILE_INCHES, format="png")


def _draw_shape(shape: PointCloud | tuple[Mesh, IntArray], view: View, first_label: int) -> Image:
    colours = _colours(_labels(shape) - first_label)
    if not isinstance(shape, PointCloud):
        return render_mesh(shape[0], view, colours)
    radius = POINT_SIZE * float(np.ptp(shape.points, axis=0).max())
    balls = Skeleton(shape.points, np.full(len(shape), radius), np.zeros(len(shape)))
    return render_balls(balls, colours, view)


def _labels(shape: PointCloud | tuple[Mesh, IntArray]) -> IntArray:
    if isinstance(shape, PointCloud):
        return np.zeros(len(shape), dtype=np.int64) if shape.labels is None else shape.labels
    return shape[1]


def _colours(parts: IntArray) -> FloatArray:
    """Return the ``(N, 3)`` colour of each part number."""
    from matplotlib.colors import to_rgb

    palette: FloatArray = np.array([to_rgb(colour) for colour in PART_COLOURS])
    return palette[parts % len(palette)]
