"""How well part segmentation is learned from few labels, by the strategy that chooses the labelled points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.figure_page import COLUMN_WIDTH, figure_page
from morphoskel.reporting.figures.curves import (
    Curve,
    absence,
    count_axis,
    has_deviations,
    has_published,
    light_grid,
    numbers_of_points,
    plot_curve,
    reading_guide,
)
from morphoskel.reporting.figures.marks import mark_of
from morphoskel.reporting.segmentation_names import FULL, STRATEGY_NAMES, split_row
from morphoskel.reporting.table import read_table

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PUBLISHED_POINTS = 2048
"""Points of the clouds that the paper labels some of."""

HEIGHT, LEGEND_ROW = 2.75, 0.16
"""Inches of the figure without the legend, and of one row of it."""

COLUMNS = 2
"""Of the legend."""


def plot_labels(figure: Figure, curves: Sequence[Curve], full: Curve) -> None:
    """Draw the mean intersection over union against the number of labels.

    Parameters
    ----------
    figure
        An empty figure.
    curves
        One a strategy.
    full
        Full supervision, drawn as horizontal lines at its values, wherever they are.
    """
    axes = figure.subplots()
    entries = [plot_curve(axes, curve) for curve in curves]
    entries += _plot_full(axes, full)
    count_axis(axes, numbers_of_points(curves), "points with a label in a training shape")
    axes.set_ylabel("Instance mIoU (%)")
    light_grid(axes)
    guide = reading_guide(deviations=has_deviations([*curves, full]), published=has_published(curves))
    figure.legend(handles=[*guide, *entries], loc="outside lower center", ncols=COLUMNS, columnspacing=1.0)


def _plot_full(axes: Axes, full: Curve) -> list[Artist]:
    """Draw the lines of full supervision, its own with a band, and return what stands for them in a legend."""
    colour = mark_of(full.name).colour
    entries: list[Artist] = []
    for _, value, deviation in full.measured:
        if not math.isnan(deviation):
            axes.axhspan(value - deviation, value + deviation, color=colour, alpha=0.12, linewidth=0, zorder=0.5)
        entries.append(axes.axhline(value, color=colour, linewidth=1.0, zorder=0.6, label="all labels"))
    for _, value in full.published:
        label = "all labels, published" if len(full.measured) else f"all labels, published ({full.absence})"
        entries.append(axes.axhline(value, color=colour, linewidth=0.8, linestyle=":", zorder=0.6, label=label))
    return entries


def strategy_curves(table: pd.DataFrame) -> dict[str, Curve]:
    """Return the curve of every strategy that has a value, and full supervision.

    Own numbers of labels are those counted, for a point chosen twice has one label; published ones are the points of a
    cloud divided by the ratio.

    Parameters
    ----------
    table
        The result table of part segmentation, as returned by :func:`morphoskel.reporting.table.read_table`.
    """
    means = table[table["group"] == MEAN_OVER_SHAPES]
    of_labels = means[means["metric"] == "labels"]
    labels = dict(zip(of_labels["method"], of_labels["value"], strict=True))
    strategies = {title: strategy for strategy, title in STRATEGY_NAMES.items()}
    measured: dict[str, list[tuple[float, float, float]]] = {strategy: [] for strategy in STRATEGY_NAMES}
    published: dict[str, list[tuple[float, float]]] = {strategy: [] for strategy in STRATEGY_NAMES}
    scores = means[means["metric"] == "miou"]
    names = scores["method"].map(lambda row: strategies[split_row(row)[0]])
    absent = {strategy: absence(scores[names == strategy]) for strategy in STRATEGY_NAMES}
    for row in scores.to_dict("records"):
        title, ratio = split_row(str(row["method"]))
        strategy = strategies[title]
        if not math.isnan(row["value"]):
            measured[strategy].append((labels[row["method"]], float(row["value"]), float(row["std"])))
        if not math.isnan(row["paper"]):
            published[strategy].append((PUBLISHED_POINTS / int(ratio or 1), float(row["paper"])))
    return {
        strategy: Curve.of(strategy, title, measured[strategy], published[strategy], absent[strategy])
        for strategy, title in STRATEGY_NAMES.items()
        if measured[strategy] or published[strategy]
    }


def draw_labels_from_files(paths: Sequence[Path], table: Path) -> None:
    """Draw the table of part segmentation.

    Parameters
    ----------
    paths
        Files to write, see :func:`morphoskel.reporting.figure_page.figure_page`.
    table
        Its CSV file.

    Raises
    ------
    InputError
        If the file cannot be read or has no mean over shapes.
    """
    curves = strategy_curves(read_table(table))
    full = curves.pop(FULL, Curve.of(FULL, STRATEGY_NAMES[FULL], [], []))
    if not curves:
        raise InputError(f"{table}: no mean over shapes of any strategy; expected the table of part segmentation")
    drawn = sorted(curves.values(), key=lambda curve: not mark_of(curve.name).emphasised)
    rows = -(-(len(drawn) + 5) // COLUMNS)
    with figure_page(paths, COLUMN_WIDTH, HEIGHT + LEGEND_ROW * rows) as figure:
        plot_labels(figure, drawn, full)
