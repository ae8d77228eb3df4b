"""A picture of one skeleton: the surface, and the maximal balls inside it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.reporting.render import Image, View, render_balls, render_mesh
from morphoskel.shapes import FloatArray, Mesh, Skeleton

if TYPE_CHECKING:
    from matplotlib.cm import ScalarMappable

COLOUR_MAP = "viridis"


def draw_skeleton(path: Path, skeleton: Skeleton, surface: Mesh, *, title: str, view: View | None = None) -> None:
    """Write a PNG with the closed surface on the left and its maximal balls, coloured by radius, on the right.

    Parameters
    ----------
    path
        File to write.
    skeleton
        The balls.
    surface
        The closed surface they lie in.
    title
        Name of the shape.
    view
        The camera; a three-quarter view with y up by default.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    view = view or View()
    colours, scale = colour_by_radius(skeleton)
    pictures = [render_mesh(surface, view), render_balls(skeleton, colours, view, under=surface)]
    rows, columns = _extent(pictures)
    shown = [picture[rows, columns] for picture in pictures]
    width = 6.0
    figure = Figure(
        figsize=(2 * width + 0.8, width * shown[0].shape[0] / shown[0].shape[1] + 0.5), layout="constrained"
    )
    FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2)
    left.imshow(shown[0])
    left.set_title(f"{title}: closed surface, {len(surface.triangles):,} triangles")
    right.imshow(shown[1])
    right.set_title(f"{len(skeleton):,} maximal balls")
    for panel in (left, right):
        panel.set_axis_off()
    figure.colorbar(scale, ax=right, label="ball radius (UDF), in the shape's unit", shrink=0.8, pad=0.02)
    with atomic_file(path) as partial:
        figure.savefig(partial, dpi=110, format="png")


def colour_by_radius(skeleton: Skeleton) -> tuple[FloatArray, ScalarMappable]:
    """Return the ``(K, 3)`` colour of each ball, and the scale that a colour bar shows."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    scale = ScalarMappable(Normalize(0, float(skeleton.radii.max())), COLOUR_MAP)
    return scale.to_rgba(skeleton.radii)[:, :3], scale


def _extent(pictures: Sequence[Image], margin: int = 12) -> tuple[slice, slice]:
    """Return the rows and columns around everything that is drawn in any of the pictures."""
    drawn = np.any([(picture < 1).any(axis=2) for picture in pictures], axis=0)
    ranges = []
    for axis in (1, 0):
        used = np.flatnonzero(drawn.any(axis=axis))
        ranges.append(slice(max(int(used[0]) - margin, 0), int(used[-1]) + margin + 1))
    return ranges[0], ranges[1]
