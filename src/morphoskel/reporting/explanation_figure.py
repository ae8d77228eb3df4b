"""Where a skeleton leaves the surface unexplained: clouds coloured by the distance to their balls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.reporting.contact_sheet import FROM_THE_FRONT
from morphoskel.reporting.render import View
from morphoskel.shapes import FloatArray, PointCloud, Skeleton

COLOUR_MAP = "inferno_r"

FULL_SCALE = 0.05
"""Distance shown in the darkest colour, in longest sides of the cloud's box."""

POINT_AREA = 2.5
"""Of the dot that stands for a point of the cloud, in square points of print."""

TILE_INCHES = 1.7


def draw_explanations(
    path: Path,
    clouds: Mapping[str, PointCloud],
    skeletons: Mapping[str, Sequence[Skeleton]],
    *,
    view: View = FROM_THE_FRONT,
) -> None:
    """Draw every cloud once for each kind of skeleton.

    Parameters
    ----------
    path
        The PNG to write.
    clouds
        The shapes by name.
    skeletons
        For each kind, the skeleton of every shape.
    view
        The camera.

    Raises
    ------
    InputError
        If there is nothing to draw.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    if not clouds or not skeletons:
        raise InputError("expected at least one shape and one kind of skeleton to draw")
    scale = ScalarMappable(Normalize(0, 100 * FULL_SCALE), COLOUR_MAP)
    size = (TILE_INCHES * len(clouds) + 1.0, TILE_INCHES * len(skeletons) + 0.3)
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    tiles = figure.subplots(len(skeletons), len(clouds), squeeze=False)
    for row, (kind, of_kind) in zip(tiles, skeletons.items(), strict=True):
        row[0].set_ylabel(kind.replace(", ", "\n"), fontsize=8)
        for axes, cloud, skeleton in zip(row, clouds.values(), of_kind, strict=True):
            extent = float(np.ptp(cloud.points, axis=0).max())
            error = 100 * unexplained(cloud, skeleton) / extent
            right, up, towards = view.axes() @ cloud.points.T
            order = np.argsort(towards)  # the nearest points are drawn last
            axes.scatter(right[order], up[order], POINT_AREA, error[order], cmap=COLOUR_MAP, norm=scale.norm, lw=0)
            axes.set(xticks=[], yticks=[], frame_on=False)
            axes.set_aspect("equal", adjustable="datalim")
    for axes, name in zip(tiles[0], clouds, strict=True):
        axes.set_title(name, fontsize=9)
    bar = figure.colorbar(scale, ax=tiles, shrink=0.8, pad=0.01, extend="max")
    bar.set_label("distance to its ball, % of the longest side", fontsize=8)
    with atomic_file(path) as partial:
        figure.savefig(partial, dpi=view.pixels / TILE_INCHES, format="png")


def unexplained(cloud: PointCloud, skeleton: Skeleton) -> FloatArray:
    """Return the distance of each point to the ball with the nearest centre, ``(N,)`` float64."""
    from scipy.spatial import KDTree

    distances, nearest = KDTree(skeleton.points).query(cloud.points)
    errors: FloatArray = np.abs(distances - skeleton.radii[nearest])
    return errors
