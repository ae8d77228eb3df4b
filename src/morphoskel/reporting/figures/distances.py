"""Distances between balls and the shape or its medial axis, by category and method, beside the published ones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES
from morphoskel.reporting.figure_page import TEXT_WIDTH, figure_page
from morphoskel.reporting.figures.curves import GREY, absence, legend_line
from morphoskel.reporting.figures.marks import Mark, mark_of
from morphoskel.reporting.matrix import NOT_RUN
from morphoskel.reporting.metrics import find_metric
from morphoskel.reporting.names import method_name, skeleton_name, surface_name
from morphoskel.reporting.table import read_table

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SKELETON_ROWS = {
    "l1_medial": skeleton_name("l1_medial"),
    "dpc": skeleton_name("dpc"),
    "point2skeleton": method_name("point2skeleton", "", "dense"),
    "coverage_axis": method_name("coverage_axis", "poisson"),
    "ms3d": method_name("ms3d", "poisson"),
    "ms3d_coverage": method_name("ms3d_coverage", "poisson"),
}
"""Rows of the table of skeletons that are drawn, by mark: each method's own balls, on Poisson surfaces if it needs
one, and the dense balls of Point2Skeleton, as published."""

SURFACE_ROWS = {
    "point2skeleton": skeleton_name("point2skeleton"),
    **{name: surface_name(name) for name in ("ball_pivoting", "alpha_shape", "ponq", "poisson", "repaired_poisson")},
}
"""Rows of the table of surfaces, by mark."""

PANELS = (("cd_recon",), ("hd_recon",), ("cd_mat", "cd_mat_computed"), ("hd_mat", "hd_mat_computed"))
"""Metrics of the panels: of those to an axis, that to given axes if there is one, else that to axes of the run."""

LINE_HEIGHT = 0.066
"""Inches of the line of one method within the row of a category."""

ROW_GAP = 1.6
"""Lines between two categories."""

MARGINS = 1.45
"""Inches above and below the rows."""

WIDE = 80.0
"""Ratio of the ends of an axis from which on only powers of ten are written."""


@dataclass(frozen=True)
class Dots:
    """The values of one method for one metric, by category or average.

    Parameters
    ----------
    name
        For the mark.
    title
        For readers.
    measured, published
        Values by group; those that do not exist are absent.
    absence
        What the legend says of a method without own values, see :func:`morphoskel.reporting.figures.curves.absence`.
    """

    name: str
    title: str
    measured: dict[str, float] = field(default_factory=dict)
    published: dict[str, float] = field(default_factory=dict)
    absence: str = NOT_RUN


def plot_distances(figure: Figure, groups: Sequence[str], panels: Sequence[tuple[str, Sequence[Dots]]]) -> None:
    """Draw one row of dots a group, with a line for each method in it.

    Parameters
    ----------
    figure
        An empty figure.
    groups
        Categories, then averages, from top to bottom.
    panels
        A title and the methods, the same ones in every panel.
    """
    tiles = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
    methods = panels[0][1]
    height = len(methods) + ROW_GAP
    for axes, (title, of_panel) in zip(tiles, panels, strict=True):
        for line, dots in enumerate(of_panel):
            _plot_line(axes, dots, groups, height, line - (len(methods) - 1) / 2)
        axes.set_title(title)
        _distance_axis(axes)
        for row in range(1, len(groups)):
            separates = groups[row] in AVERAGES and groups[row - 1] not in AVERAGES
            axes.axhline((row - 0.5) * height, color="0.4" if separates else "0.88", linewidth=0.6, zorder=0.5)
        axes.tick_params(axis="y", length=0)
    tiles[0].set_yticks(np.arange(len(groups)) * height, [group.replace(" over ", "\nover ") for group in groups])
    tiles[0].set_ylim((len(groups) - 0.5) * height, -0.5 * height)
    figure.supxlabel("distance (units of the data set), lower is better", fontsize="medium")
    figure.legend(handles=_entries(panels), loc="outside upper center", ncols=4, columnspacing=1.6, handlelength=1.2)


def _entries(panels: Sequence[tuple[str, Sequence[Dots]]]) -> list[Artist]:
    """Return the legend: the methods, then what filled and hollow markers are."""
    from matplotlib.lines import Line2D

    run = {dots.name for _, of_panel in panels for dots in of_panel if dots.measured}
    entries = [_entry(dots, dots.name in run) for dots in panels[0][1]]
    grey = Mark(GREY, "o")
    if run:
        entries.append(Line2D([], [], label="this run", **grey.dot))
    if any(dots.published for _, of_panel in panels for dots in of_panel):
        entries.append(legend_line(grey, "published", hollow=True))
    return entries


def _plot_line(axes: Axes, dots: Dots, groups: Sequence[str], height: float, offset: float) -> None:
    """Draw the values of one method, each at its line in the row of its group, joined with the published one."""
    mark = mark_of(dots.name)
    for row, group in enumerate(groups):
        place = row * height + offset
        ours, printed = dots.measured.get(group), dots.published.get(group)
        if ours is not None and printed is not None:
            axes.plot([ours, printed], [place, place], color=mark.colour, linewidth=0.6, zorder=1)
        if printed is not None:
            axes.plot([printed], [place], **mark.hollow)
        if ours is not None:
            axes.plot([ours], [place], **mark.dot)


def _distance_axis(axes: Axes) -> None:
    """Make the horizontal axis logarithmic, with plain numbers."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axes.set_xscale("log")
    low, high = axes.get_xlim()
    axes.xaxis.set_major_locator(LogLocator(base=10, subs=(1.0, 2.0, 5.0) if high < WIDE * low else (1.0,)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(True, axis="x", which="major", color="0.88", linewidth=0.6)
    axes.set_axisbelow(True)


def _entry(dots: Dots, run: bool) -> Artist:
    """Return a method's entry of the legend."""
    from matplotlib.lines import Line2D

    mark = mark_of(dots.name)
    return Line2D(
        [], [], label=dots.title if run else f"{dots.title} ({dots.absence})", **(mark.dot if run else mark.hollow)
    )


def choose_panels(frame: pd.DataFrame, rows: dict[str, str]) -> list[tuple[str, list[Dots]]]:
    """Return the panels of a result table.

    Distances to axes of the run stand alone: the published ones are to other axes.

    Parameters
    ----------
    frame
        As returned by :func:`morphoskel.reporting.table.read_table`.
    rows
        The row of the table by mark, :data:`SKELETON_ROWS` or :data:`SURFACE_ROWS`.
    """
    panels = []
    drawn = frame[frame["method"].isin(rows.values())]
    for metrics in PANELS:
        measured = [metric for metric in metrics if drawn.loc[drawn["metric"] == metric, "value"].notna().any()]
        metric = next(iter(measured), metrics[0])
        of_metric = drawn[drawn["metric"] == metric]
        dots = [
            Dots(name, row, _by_group(rows_of, "value"), _by_group(rows_of, "paper"), absence(rows_of))
            for name, row in rows.items()
            for rows_of in [of_metric[of_metric["method"] == row]]
        ]
        panels.append((find_metric(metric).title, dots))
    return panels


def _by_group(rows: pd.DataFrame, column: str) -> dict[str, float]:
    """Return the values of one row of the table by group, without those that are missing."""
    values = zip(rows["group"], rows[column], strict=True)
    return {str(group): float(value) for group, value in values if not math.isnan(value)}


def draw_distances_from_files(paths: Sequence[Path], table: Path, *, kind: Literal["skeletons", "surfaces"]) -> None:
    """Draw the distances of a result table.

    Parameters
    ----------
    paths
        Files to write, see :func:`morphoskel.reporting.figure_page.figure_page`.
    table
        The CSV file of the table of skeletons or of surfaces.
    kind
        Which of the two it is: :data:`SKELETON_ROWS` or :data:`SURFACE_ROWS` are drawn.

    Raises
    ------
    InputError
        If the file cannot be read or has none of the rows.
    """
    rows = SURFACE_ROWS if kind == "surfaces" else SKELETON_ROWS
    panels = choose_panels(read_table(table), rows)
    dots = [of for _, of_panel in panels for of in of_panel]
    named = dict.fromkeys(group for of in dots for group in (*of.published, *of.measured))
    if not named:
        raise InputError(f"{table}: no value of any of the rows {', '.join(rows.values())}; expected one to draw")
    groups = [*(group for group in named if group not in AVERAGES), *(group for group in AVERAGES if group in named)]
    height = MARGINS + LINE_HEIGHT * (len(panels[0][1]) + ROW_GAP) * len(groups)
    with figure_page(paths, TEXT_WIDTH, height) as figure:
        plot_distances(figure, groups, panels)
