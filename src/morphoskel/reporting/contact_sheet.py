"""Contact sheets: many shapes of a data set on one page, coloured by part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PART_COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb")
"""Tol's bright scheme, which people with any colour vision can tell apart; parts beyond its end begin anew."""

_TILE_INCHES = 1.6
_PIXELS = 300
"""Width of a tile as it is drawn, before the page is scaled to its resolution."""

_LIGHT = np.array([-0.7, 0.8, -0.3]) / np.linalg.norm([-0.7, 0.8, -0.3])


def draw_contact_sheet(
    shapes: Mapping[str, Sequence[PointCloud | tuple[Mesh, IntArray]]],
    path: Path,
    *,
    turn: float = 55.0,
    tilt: float = 22.0,
    dots_per_inch: int = 110,
) -> None:
    """Draw one row of pictures a category.

    Parameters
    ----------
    shapes
        For each category its shapes: a cloud, or a mesh with the ``(T,)`` part label of each triangle.
    path
        The picture to write; its suffix decides the format.
    turn, tilt
        Direction of view in degrees: around the upright axis away from the front (negative z), and from above.
    dots_per_inch
        Resolution; a tile is 1.6 inches wide.

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
    figure = Figure(figsize=(_TILE_INCHES * columns, (_TILE_INCHES + 0.2) * len(shapes)), layout="constrained")
    FigureCanvasAgg(figure)
    tiles = figure.subplots(len(shapes), columns, squeeze=False)
    view = _view(turn, tilt)
    for axes_row, (category, row) in zip(tiles, shapes.items(), strict=True):
        first_label = min(int(_labels(shape).min()) for shape in row) if row else 0
        for axes in axes_row:
            axes.set_axis_off()
        for axes, shape in zip(axes_row, row, strict=False):
            _draw_shape(axes, shape, view, first_label)
        axes_row[0].set_title(category, loc="left", fontsize=9)
    with atomic_file(path) as partial:
        figure.savefig(partial, dpi=dots_per_inch, format=path.suffix.lstrip("."))


def _draw_shape(axes: Axes, shape: PointCloud | tuple[Mesh, IntArray], view: FloatArray, first_label: int) -> None:
    """Draw one shape in parallel projection."""
    colours = _colours(_labels(shape) - first_label)
    if isinstance(shape, PointCloud):
        seen = shape.points @ view.T
        order = np.argsort(seen[:, 2])
        axes.scatter(seen[order, 0], seen[order, 1], c=colours[order], s=1.5, linewidths=0)
        axes.set_aspect("equal", adjustable="datalim")
        return
    corners = (shape[0].vertices @ view.T)[shape[0].triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(np.float64).tiny)
    shade = 0.5 + 0.5 * np.clip(unit @ view @ _LIGHT, 0.0, 1.0)
    facing = normals[:, 2] > 0
    axes.imshow(
        _render(corners[facing], (colours * shade[:, None])[facing]), origin="lower", interpolation="antialiased"
    )


def _render(corners: FloatArray, colours: FloatArray) -> FloatArray:
    """Return a picture, ``(P, P, 3)``, of flat-coloured triangles in which the nearest one is seen at each pixel.

    Every triangle is covered with samples at most a pixel apart, and each pixel keeps its nearest sample.
    """
    flat = corners.reshape(-1, 3)[:, :2]
    low, high = flat.min(axis=0), flat.max(axis=0)
    scale = (_PIXELS - 3) / max(float((high - low).max()), np.finfo(np.float64).tiny)
    middle = np.append((low + high) / 2, 0.0)
    triangle, samples = _cover((corners - middle) * scale)
    pixel = np.round(samples[:, :2] + (_PIXELS - 1) / 2).astype(np.int64)
    place = pixel[:, 1] * _PIXELS + pixel[:, 0]
    nearest_last = np.argsort(samples[:, 2], kind="stable")
    picture = np.ones((_PIXELS * _PIXELS, 3))
    picture[place[nearest_last]] = colours[triangle[nearest_last]]
    return picture.reshape(_PIXELS, _PIXELS, 3)


def _cover(corners: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return samples, ``(S, 3)``, at most 0.7 units apart on triangles, ``(T, 3, 3)``, and the triangle of each."""
    edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    # Rows run from the apex opposite the shortest edge, so that slivers take few samples.
    apex = (np.argmin(edges, axis=1) + 2) % 3
    turned = corners[np.arange(len(corners))[:, None], (apex[:, None] + np.arange(3)) % 3]
    rows = np.ceil(edges.max(axis=1) / 0.7).astype(np.int64) + 1
    columns = np.ceil(edges.min(axis=1) / 0.7).astype(np.int64) + 1
    counts = rows * columns
    triangle = np.repeat(np.arange(len(corners)), counts)
    within = np.arange(len(triangle)) - np.repeat(np.cumsum(counts) - counts, counts)
    down = (within // columns[triangle] / np.maximum(rows[triangle] - 1, 1))[:, None]
    across = (within % columns[triangle] / np.maximum(columns[triangle] - 1, 1))[:, None]
    first, second, third = (turned[triangle, corner] for corner in range(3))
    return triangle, first + down * (second - first) + down * across * (third - second)


def _labels(shape: PointCloud | tuple[Mesh, IntArray]) -> IntArray:
    if isinstance(shape, PointCloud):
        return np.zeros(len(shape), dtype=np.int64) if shape.labels is None else shape.labels
    return shape[1]


def _colours(parts: IntArray) -> FloatArray:
    """Return the ``(N, 3)`` colour of each part number."""
    from matplotlib.colors import to_rgb

    palette = np.array([to_rgb(colour) for colour in PART_COLOURS])
    chosen: np.ndarray[Any, np.dtype[np.float64]] = palette[parts % len(palette)]
    return chosen


def _view(turn: float, tilt: float) -> FloatArray:
    """Return the rotation, ``(3, 3)``, to picture coordinates: right, up, towards the viewer."""
    around, above = np.radians(turn), np.radians(tilt)
    towards = np.array([-np.sin(around) * np.cos(above), np.sin(above), -np.cos(around) * np.cos(above)])
    right = np.cross([0.0, 1.0, 0.0], towards)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(towards, right), towards])
