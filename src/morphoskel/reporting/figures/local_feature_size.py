"""The skeleton prior on clouds: the local feature size, and the sampling weight that it becomes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.reporting.figure_page import SIZE_MAP, cropped, paint
from morphoskel.reporting.figures.cloud_panels import draw_cloud
from morphoskel.reporting.figures.panels import Row, Scale, draw_rows
from morphoskel.reporting.figures.shown_shapes import choose_shapes
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View
from morphoskel.sampling.prior import PriorSettings, prior_weights
from morphoskel.shapes import FloatArray

LARGE = replace(FROM_THE_FRONT, pixels=600)
SHAPES = 5
WANTED = ("airplane", "lamp", "earphone", "chair", "mug")
"""Categories shown first, if the data set has them: thin and thick parts beside each other."""


SIZE_SCALE = Scale(0, 1, SIZE_MAP, "local feature size\n(the shape's largest = 1)")


def draw_size_map(
    paths: Sequence[Path],
    clouds: Mapping[str, tuple[FloatArray, FloatArray | str]],
    settings: PriorSettings,
    *,
    view: View = LARGE,
) -> None:
    """Draw clouds coloured by local feature size above, and by sampling weight below.

    Sizes are relative to the largest of their cloud, which is named; weights of all clouds are on one scale.

    Parameters
    ----------
    paths
        Files to write.
    clouds
        For each title the points, ``(N, 3)``, and the local feature size of each, ``(N,)``, or what to say in its
        place.
    settings
        How sizes become weights.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no cloud.
    """
    weights = {name: settings.bins * prior_weights(sizes, settings)
               for name, (_, sizes) in clouds.items() if not isinstance(sizes, str)}  # fmt: skip
    spread = [weight for of_cloud in weights.values() for weight in (of_cloud.min(), of_cloud.max())]
    scale = Scale(min(spread, default=1.0), max(spread, default=1.0), SIZE_MAP, "weight\n(equal weights = 1)")
    upper: list[Image | str] = []
    lower: list[Image | str] = []
    notes = []
    for name, (points, sizes) in clouds.items():
        if isinstance(sizes, str):
            upper.append(sizes)
            lower.append("no weights")
            notes.append("")
            continue
        notes.append(f"largest: {sizes.max():#.2g}")
        colours = [paint(sizes, 0, sizes.max(), SIZE_MAP), paint(weights[name], scale.low, scale.high, SIZE_MAP)]
        pictures = [draw_cloud(points, of_points, view) for of_points in colours]
        for row, picture in zip((upper, lower), cropped(pictures), strict=True):
            row.append(picture)
    rows = [Row(upper, titles=list(clouds), notes=notes, scale=SIZE_SCALE), Row(lower, scale=scale)]
    draw_rows(paths, rows)


def draw_size_map_from_files(
    paths: Sequence[Path],
    clouds: Path,
    priors: Path,
    *,
    prior: Mapping[str, Any],
    wanted: Sequence[str] = WANTED,
    count: int = SHAPES,
    view: View = LARGE,
) -> None:
    """Draw the first cloud of each of several categories.

    Parameters
    ----------
    paths
        Files to write.
    clouds, priors
        Files of the split's clouds and of their local feature sizes.
    prior
        Settings of :class:`~morphoskel.sampling.prior.PriorSettings`.
    wanted, count
        See :func:`~morphoskel.reporting.figures.shown_shapes.choose_shapes`.
    view
        The camera.
    """
    from morphoskel.datasets.cloud_set import read_cloud_set
    from morphoskel.sampling.prior_set import read_prior_set

    shapes = read_cloud_set(clouds)
    sizes = read_prior_set(priors, shapes)
    shown: dict[str, tuple[FloatArray, FloatArray | str]] = {}
    places = choose_shapes(shapes.ids.tolist(), shapes.categories.tolist(), wanted=wanted, count=count)
    for title, place in places.items():
        stage = str(sizes.reasons[place]).partition(":")[0]
        of_points = f"failed at\n{stage}" if stage else sizes.distances[place].astype(np.float64)
        shown[title] = shapes.points[place].astype(np.float64), of_points
    draw_size_map(paths, shown, PriorSettings(**prior), view=view)
