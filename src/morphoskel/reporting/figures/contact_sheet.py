"""A contact sheet: several shapes of every category of a data set on one page, coloured by part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.progress import track
from morphoskel.reporting.figure_page import cropped, paint_parts
from morphoskel.reporting.figures.cloud_panels import draw_cloud
from morphoskel.reporting.figures.panels import Row, draw_rows
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View
from morphoskel.shapes import IntArray, PointCloud

LARGE = replace(FROM_THE_FRONT, pixels=420)

COLUMNS, MOST_ROWS = 8, 10
"""Panels side by side, and rows of them that a page holds."""


def draw_contact_sheet(
    paths: Sequence[Path], shapes: Mapping[str, Sequence[PointCloud]], *, view: View = LARGE
) -> None:
    """Draw the shapes of each category beside each other, and as many categories in a row as fit.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        For each category its shapes. Points without labels are of one part.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    longest = max((len(clouds) for clouds in shapes.values()), default=0)
    columns = max(COLUMNS // max(longest, 1), 1) * longest
    panels: list[Image | str] = []
    titles: list[str] = []
    for category, clouds in track(shapes.items(), "contact sheet", unit="row"):
        # Shapes of the same category show their parts in the same colours.
        first_part = min((int(_parts(cloud).min()) for cloud in clouds), default=0)
        for cloud in clouds:
            panels += cropped([draw_cloud(cloud.points, paint_parts(_parts(cloud) - first_part), view)])
        panels += [""] * (longest - len(clouds))
        titles += [category, *[""] * (longest - 1)]
    starts = range(0, len(panels), max(columns, 1))
    rows = [Row(panels[start : start + columns], titles=titles[start : start + columns]) for start in starts]
    draw_rows(paths, rows)


def draw_contact_sheet_from_files(
    paths: Sequence[Path], manifest: Path, *, dataset: Mapping[str, Any], seed: int, split: str, view: View = LARGE
) -> None:
    """Draw the first shapes of every category, so many that they fill a page.

    Parameters
    ----------
    paths
        Files to write.
    manifest
        Of the data set.
    dataset, seed
        The configuration's data set section and the global seed.
    split
        Which shapes.
    view
        The camera.
    """
    from morphoskel.datasets.configured import open_configured
    from morphoskel.datasets.manifest import read_manifest

    source = open_configured(dataset, seed=seed)
    files: dict[str, list[Path]] = {}
    for record in read_manifest(manifest, split=split):
        files.setdefault(record.category, []).append(record.path)
    most = shapes_a_category(len(files))
    shapes = {category: [source.load(path) for path in of_category[:most]] for category, of_category in files.items()}
    draw_contact_sheet(paths, shapes, view=view)


def shapes_a_category(categories: int) -> int:
    """Return the most shapes of each of so many categories for which whole categories fill the rows of a page."""
    for shapes in range(COLUMNS, 1, -1):
        if COLUMNS % shapes == 0 and shapes * categories <= COLUMNS * MOST_ROWS:
            return shapes
    return 1


def _parts(cloud: PointCloud) -> IntArray:
    return np.zeros(len(cloud), dtype=np.int64) if cloud.labels is None else cloud.labels
