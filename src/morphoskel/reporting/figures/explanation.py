"""Where a skeleton leaves the surface unexplained: clouds coloured by the distance to their balls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.evaluation.sphere_metrics import point_to_sphere_distances
from morphoskel.reporting.figure_page import DISTANCE_MAP, paint
from morphoskel.reporting.figures.cloud_panels import draw_cloud
from morphoskel.reporting.figures.panels import Row, Scale, crop_alike, draw_rows
from morphoskel.reporting.figures.shown_shapes import choose_records, find_skeleton
from morphoskel.reporting.names import method_name
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View
from morphoskel.shapes import FloatArray, PointCloud, Skeleton

LARGE = replace(FROM_THE_FRONT, pixels=480)
SHAPES = 6
WANTED = ("mug", "guitar", "earphone", "chair", "airplane", "table")
"""Categories shown first, if the data set has them: their thick parts are the first that go without balls."""

HEIGHT = 1.0
"""Of a panel, in widths; one for all rows, so that all pictures of a shape have one scale."""

SCALE = Scale(0, 3, f"{DISTANCE_MAP}_r", "distance to its ball,\n% of the longest side")
"""Most points are near their ball; at the light end of the map their shading shows. The few points that are farther
away than the scale reaches have its last colour."""


def draw_explanation(
    paths: Sequence[Path], shapes: Mapping[str, tuple[PointCloud, Mapping[str, Skeleton | str]]], *, view: View = LARGE
) -> None:
    """Draw every cloud once for each kind of skeleton, and below it the mean of the distances.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        For each title the cloud, and for each kind its skeleton, or what to say in its place; the same kinds of every
        shape.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    columns: list[list[Image | str]] = []
    notes: list[list[str]] = []
    for cloud, skeletons in shapes.values():
        distances = [found if isinstance(found, str) else unexplained(cloud, found) for found in skeletons.values()]
        columns.append(crop_alike([_draw(cloud, of_kind, view) for of_kind in distances]))
        notes.append(["" if isinstance(of_kind, str) else f"mean {of_kind.mean():.2f}%" for of_kind in distances])
    _, kinds = next(iter(shapes.values()), (None, {}))
    rows = [
        Row(
            [column[number] for column in columns],
            name=kind,
            titles=() if number else list(shapes),
            notes=[of_shape[number] for of_shape in notes],
        )
        for number, kind in enumerate(kinds)
    ]
    draw_rows(paths, rows, scale=SCALE, flattest=HEIGHT, tallest=HEIGHT, level_names=True)


def unexplained(cloud: PointCloud, skeleton: Skeleton) -> FloatArray:
    """Return the distance of each point to its ball, ``(N,)`` float64, in per cent of the longest side of the cloud."""
    distances = point_to_sphere_distances(cloud.points, skeleton.points, skeleton.radii)
    shares: FloatArray = 100 * distances / float(np.ptp(cloud.points, axis=0).max())
    return shares


def _draw(cloud: PointCloud, distances: FloatArray | str, view: View) -> Image | str:
    if isinstance(distances, str):
        return distances
    return draw_cloud(cloud.points, paint(distances, SCALE.low, SCALE.high, SCALE.colour_map), view)


def draw_explanation_from_files(
    paths: Sequence[Path],
    manifest: Path,
    skeletons: Mapping[str, Sequence[Path]],
    *,
    dataset: Mapping[str, Any],
    seed: int,
    split: str,
    wanted: Sequence[str] = WANTED,
    count: int = SHAPES,
    view: View = LARGE,
) -> None:
    """Draw the first shape of each of several categories.

    Parameters
    ----------
    paths
        Files to write.
    manifest
        Of the data set.
    skeletons
        For each surface and method, joined with a slash, the folders of all shards of the split with skeletons.
    dataset, seed
        The configuration's data set section and the global seed.
    split
        Which shapes.
    wanted, count
        See :func:`~morphoskel.reporting.figures.shown_shapes.choose_shapes`.
    view
        The camera.
    """
    from morphoskel.datasets.configured import open_configured
    from morphoskel.datasets.manifest import read_manifest

    source = open_configured(dataset, seed=seed)
    records = read_manifest(manifest, split=split)
    shapes = {
        title: (
            source.load(record.path),
            {method_name(*reversed(pair.split("/"))): find_skeleton(folders, record.id)
             for pair, folders in skeletons.items()},
        )
        for title, record in choose_records(records, wanted=wanted, count=count).items()
    }  # fmt: skip
    draw_explanation(paths, shapes, view=view)
