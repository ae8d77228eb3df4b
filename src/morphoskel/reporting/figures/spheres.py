"""Skeletal balls inside the points of the surface they were made from, one shape a category in large panels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from morphoskel.progress import track
from morphoskel.reporting.figure_page import cropped
from morphoskel.reporting.figures.ball_panels import RADIUS_SCALE, draw_balls, joint_bounds
from morphoskel.reporting.figures.panels import Row, draw_rows
from morphoskel.reporting.figures.shown_shapes import choose_records, find_skeleton
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View, ball_bounds
from morphoskel.shapes import PointCloud, Skeleton

WANTED = ("earphone", "headphone", "lamp")
"""Categories shown first, if the data set has them: their thin parts and round parts differ most in radius."""

LARGE = replace(FROM_THE_FRONT, pixels=760)
COLUMNS, SHAPES = 3, 6


def draw_spheres(
    paths: Sequence[Path], shapes: Mapping[str, tuple[PointCloud, Skeleton | str]], *, view: View = LARGE
) -> None:
    """Draw balls, coloured by radius, and the points of the surface as dots.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        For each title the cloud, and its skeleton or what to say in its place.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    names = list(shapes)
    panels: list[Image | str] = []
    for cloud, skeleton in track(shapes.values(), "spheres"):
        if isinstance(skeleton, str):
            panels.append(skeleton)
            continue
        bounds = joint_bounds([ball_bounds(skeleton), [cloud.points.min(axis=0), cloud.points.max(axis=0)]])
        panels += cropped([draw_balls(skeleton, view, bounds, points=cloud.points)])
    starts = range(0, len(names), COLUMNS)
    rows = [Row(panels[start : start + COLUMNS], titles=names[start : start + COLUMNS]) for start in starts]
    draw_rows(paths, rows, scale=RADIUS_SCALE)


def draw_spheres_from_files(
    paths: Sequence[Path],
    manifest: Path,
    skeletons: Sequence[Path],
    *,
    split: str,
    dataset: Mapping[str, Any],
    seed: int,
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
        The skeleton folders of all shards of the split.
    split
        Which shapes.
    dataset, seed
        The configuration's data set section and the global seed.
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
        title: (source.load(record.path), find_skeleton(skeletons, record.id))
        for title, record in choose_records(records, wanted=wanted, count=count).items()
    }
    draw_spheres(paths, shapes, view=view)
