"""Parts as networks tell them beside the true ones, and the points that they get wrong."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.checksums import intact
from morphoskel.errors import InputError
from morphoskel.evaluation.segmentation import shape_iou
from morphoskel.reporting.figure_page import cropped, paint_parts
from morphoskel.reporting.figures.cloud_panels import draw_cloud
from morphoskel.reporting.figures.panels import Row, draw_rows
from morphoskel.reporting.figures.shown_shapes import choose_shapes
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View
from morphoskel.reporting.segmentation_names import FULL, STRATEGY_NAMES
from morphoskel.shapes import FloatArray, IntArray

if TYPE_CHECKING:
    from morphoskel.datasets.cloud_set import CloudSet

LARGE = replace(FROM_THE_FRONT, pixels=560)
WANTED = ("airplane", "chair", "lamp", "motorbike")
"""Categories shown first, if the data set has them: they have the most parts."""

SHAPES = 4

RIGHT_COLOUR, WRONG_COLOUR = (0.88, 0.88, 0.88), (0.80, 0.1, 0.0)


@dataclass(frozen=True)
class SegmentedShape:
    """A cloud with its true parts and those that networks tell.

    Parameters
    ----------
    points
        ``(N, 3)``.
    truth
        ``(N,)`` int64, a part of the shape's category.
    told
        For each network's title the ``(N,)`` int64 parts that it tells.
    parts
        ``(P,)`` int64, all parts of the category.
    """

    points: FloatArray
    truth: IntArray
    told: Mapping[str, IntArray]
    parts: IntArray


def draw_segmentation(paths: Sequence[Path], shapes: Mapping[str, SegmentedShape], *, view: View = LARGE) -> None:
    """Draw one row a shape: the true parts, then for each network the parts it tells and the points it gets wrong.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        By title; all with the same networks.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    rows: list[Row] = []
    for name, shape in shapes.items():
        panels, notes = _panels(shape, view)
        titles = ["ground truth", *(title for told in shape.told for title in (told, "wrong points"))]
        rows.append(Row(panels, name=name, titles=() if rows else titles, notes=notes))
    draw_rows(paths, rows)


def _panels(shape: SegmentedShape, view: View) -> tuple[list[Image], list[str]]:
    """Return the panels of a row, and the notes below them."""
    pictures = [draw_cloud(shape.points, _colours(shape.truth, shape.parts), view)]
    notes = [""]
    for told in shape.told.values():
        wrong = told != shape.truth
        marked = np.where(wrong[:, None], WRONG_COLOUR, RIGHT_COLOUR)
        pictures += [draw_cloud(shape.points, colours, view) for colours in (_colours(told, shape.parts), marked)]
        iou = shape_iou(told, shape.truth, shape.parts)
        notes += [f"IoU {100 * iou:.0f}%", f"{100 * wrong.mean():.0f}% of the points"]
    return cropped(pictures), notes


def _colours(labels: IntArray, parts: IntArray) -> FloatArray:
    """Return the ``(N, 3)`` colour of each point: that of the place of its part in the category; black of another's."""
    places = np.searchsorted(parts, labels) % len(parts)
    colours = paint_parts(places)
    colours[parts[places] != labels] = 0
    return colours


def draw_segmentation_from_files(
    paths: Sequence[Path],
    clouds: Path,
    networks: Mapping[str, Path],
    evaluations: Mapping[str, Path],
    *,
    wanted: Sequence[str] = WANTED,
    count: int = SHAPES,
    view: View = LARGE,
) -> None:
    """Draw the first shape of each of several categories.

    Parameters
    ----------
    paths
        Files to write.
    clouds
        File of the split's clouds, with parts.
    networks
        For each strategy, by its name in the configuration, a file ``.../{ratio}/{number}/network.pt``.
    evaluations
        For each strategy the CSV file of :func:`~morphoskel.evaluation.segmentation.evaluate_segmentation_files`,
        which holds the number of labels that its networks learned from.
    wanted, count
        See :func:`~morphoskel.reporting.figures.shown_shapes.choose_shapes`.
    view
        The camera.

    Raises
    ------
    InputError
        If the clouds have no parts, or a network knows other ones.
    """
    from morphoskel.datasets.cloud_set import read_cloud_set
    from morphoskel.networks.part_segmentation import load_segmentation, predict_parts

    shapes = read_cloud_set(clouds)
    chosen = choose_shapes(shapes.ids.tolist(), shapes.categories.tolist(), wanted=wanted, count=count)
    places = list(chosen.values())
    told: dict[str, IntArray] = {}
    for strategy, path in networks.items():
        network = load_segmentation(path)
        shapes.check_classes(network.class_names)
        title = _title(strategy, path, evaluations[strategy])
        told[title] = predict_parts(network, shapes.points[places], shapes.labels[places])
    draw_segmentation(paths, _segmented(shapes, chosen, told), view=view)


def _segmented(shapes: CloudSet, chosen: Mapping[str, int], told: Mapping[str, IntArray]) -> dict[str, SegmentedShape]:
    """Return the chosen shapes by title, without the points that repeat others."""
    if shapes.parts is None or shapes.part_classes is None:
        raise InputError("the clouds have no parts; expected those of a data set with parts")
    segmented = {}
    for number, (name, place) in enumerate(chosen.items()):
        known = shapes.parts[place] >= 0
        segmented[name] = SegmentedShape(
            shapes.points[place][known].astype(np.float64),
            shapes.parts[place][known],
            {title: parts[number][known] for title, parts in told.items()},
            np.flatnonzero(shapes.part_classes == shapes.labels[place]),
        )
    return segmented


def _title(strategy: str, network: Path, evaluation: Path) -> str:
    """Return the name of a strategy and the mean number of labels of a shape that the network learned from."""
    import pandas as pd

    if strategy == FULL:
        return "all labels"
    rows = pd.read_csv(intact(evaluation))
    of_network = rows[(rows["ratio"] == int(network.parent.parent.name)) & (rows["seed"] == int(network.parent.name))]
    if of_network.empty:
        raise InputError(f"{evaluation}: holds no row of {network}; evaluate the networks again")
    return f"{STRATEGY_NAMES[strategy]}, {of_network['labels'].iloc[0]:.0f} labels"
