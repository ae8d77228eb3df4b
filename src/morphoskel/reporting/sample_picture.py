"""A picture of the points that were chosen from a cloud."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.reporting.render import View
from morphoskel.shapes import FloatArray, IntArray, PointCloud

COLOUR_MAP = "viridis"
PLAIN_COLOUR = "tab:blue"
CLOUD_COLOUR = "0.72"

INCHES = 6.0
"""Of the longer side of the cloud."""

DOT_AREA, CHOSEN_AREA = 3.0, 45.0
"""Of a point of the cloud and of a chosen one, in square points of print."""


def draw_sample(
    path: Path,
    cloud: PointCloud,
    chosen: IntArray,
    sizes: FloatArray | None,
    *,
    title: str,
    view: View | None = None,
) -> None:
    """Write a PNG with the cloud in grey and the chosen points as discs, coloured by local feature size if known.

    Points on the far side are paler than near ones.

    Parameters
    ----------
    path
        File to write.
    cloud
        All points.
    chosen
        ``(M,)`` int64, the chosen ones.
    sizes
        ``(N,)`` float64, local feature size of each point of the cloud, or ``None``.
    title
        Name of the shape.
    view
        The camera; a three-quarter view with y up by default.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize, to_rgba
    from matplotlib.figure import Figure

    view = view or View()
    right, up, depth = view.axes() @ cloud.points.T
    near = nearness(cloud.points, view)
    extents = np.array([np.ptp(right), np.ptp(up)])
    width, height = INCHES * np.maximum(extents / max(extents.max(), 1e-12), 0.4)
    figure = Figure(figsize=(width + (1.0 if sizes is not None else 0.2), height + 0.4), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    colours = np.tile(to_rgba(PLAIN_COLOUR), (len(chosen), 1))
    if sizes is not None:
        # A few sizes far above the others, where the skeleton has a gap, would leave one colour to the rest.
        scale = ScalarMappable(Normalize(0, float(np.quantile(sizes, 0.95)) or 1.0), COLOUR_MAP)
        colours = scale.to_rgba(sizes[chosen])
        label = "local feature size, in the shape's unit"
        figure.colorbar(scale, ax=axes, label=label, shrink=0.8, pad=0.02, extend="max")
    colours[:, 3] = 0.25 + 0.75 * near[chosen]
    of_cloud = np.tile(to_rgba(CLOUD_COLOUR), (len(cloud), 1))
    of_cloud[:, 3] = 0.15 + 0.65 * near
    axes.scatter(right, up, DOT_AREA, of_cloud, lw=0)
    order = np.argsort(depth[chosen])  # the nearest are drawn last
    axes.scatter(right[chosen][order], up[chosen][order], CHOSEN_AREA, colours[order], edgecolors="white", lw=0.6)
    axes.set(xticks=[], yticks=[], frame_on=False)
    text = f"{title}: {len(chosen):,} of {len(cloud):,} points"
    axes.set_title(text, parse_math=False)  # a file's name may hold dollars
    axes.set_aspect("equal")
    with atomic_file(path) as partial:
        figure.savefig(partial, dpi=view.pixels / INCHES, format="png")


def nearness(points: FloatArray, view: View) -> FloatArray:
    """Return how near points ``(N, 3)`` are to the viewer, ``(N,)``: 0 the farthest, 1 the nearest."""
    depth = points @ view.axes()[2]
    near: FloatArray = np.clip((depth - depth.min()) / max(float(np.ptp(depth)), 1e-12), 0, 1)
    return near
