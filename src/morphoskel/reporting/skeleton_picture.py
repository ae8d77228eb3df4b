"""A picture of one skeleton: the surface, if there is one, and the balls."""

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


def draw_skeleton(
    path: Path, skeleton: Skeleton, surface: Mesh | None, *, title: str, view: View | None = None
) -> None:
    """Write a PNG with the closed surface on the left and the balls, coloured by radius, on the right.

    Parameters
    ----------
    path
        File to write.
    skeleton
        The balls.
    surface
        The closed surface they lie in; ``None`` if the method read the cloud alone, then the balls are all there is.
    title
        Name of the shape.
    view
        The camera; a three-quarter view with y up by default.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    view = view or View()
    colours, scale = colour_by_radius(skeleton)
    pictures = [render_balls(skeleton, colours, view, under=surface)]
    titles = [f"{len(skeleton):,} balls" if surface else f"{title}: {len(skeleton):,} balls"]
    if surface:
        pictures.insert(0, render_mesh(surface, view))
        titles.insert(0, f"{title}: closed surface, {len(surface.triangles):,} triangles")
    rows, columns = _extent(pictures)
    shown = [picture[rows, columns] for picture in pictures]
    width = 6.0
    figure = Figure(
        figsize=(len(shown) * width + 0.8, width * shown[0].shape[0] / shown[0].shape[1] + 0.5), layout="constrained"
    )
    FigureCanvasAgg(figure)
    panels = figure.subplots(1, len(shown), squeeze=False)[0]
    for panel, picture, text in zip(panels, shown, titles, strict=True):
        panel.imshow(picture)
        panel.set_title(text, parse_math=False)  # a file's name may hold dollars
        panel.set_axis_off()
    figure.colorbar(scale, ax=panels[-1], label="ball radius, in the shape's unit", shrink=0.8, pad=0.02)
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
