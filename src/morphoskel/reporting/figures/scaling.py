"""How the seconds of MS3D grow with the number of candidates."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.evaluation.scaling import SCALED_STAGES, read_scaling
from morphoskel.reporting.figure_page import COLUMN_WIDTH, figure_page
from morphoskel.reporting.figures.curves import GREY, legend_line, light_grid
from morphoskel.reporting.figures.marks import TOTAL, mark_of
from morphoskel.reporting.figures.stage_times import STAGE_TITLES

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HEIGHT = 3.0

SLOPES = {1: "∝ n", 2: "∝ n²"}
"""Guides: cost in proportion to the number of candidates and to its square."""

GUIDE_LENGTH = 0.22
"""Of a guide, as a share of the axis."""


def plot_scaling(figure: Figure, times: pd.DataFrame) -> None:
    """Draw seconds against numbers of candidates, both logarithmic: one line a stage, and their sum.

    Parameters
    ----------
    figure
        An empty figure.
    times
        Columns :data:`morphoskel.evaluation.scaling.SCALING_COLUMNS`. Lines are medians over repetitions, bands reach
        from the fastest to the slowest.
    """
    from matplotlib.ticker import EngFormatter

    axes = figure.subplots()
    table = times.pivot(index=["candidates", "repeat"], columns="stage", values="seconds")[list(SCALED_STAGES)]
    table[TOTAL] = table.sum(axis="columns", skipna=False)
    entries = []
    for stage in (TOTAL, *SCALED_STAGES):
        mark = mark_of(stage)
        seconds = table[stage].groupby(level="candidates")
        middle = seconds.median()
        axes.fill_between(middle.index, seconds.min(), seconds.max(), color=mark.colour, alpha=0.2, linewidth=0)
        axes.plot(middle.index, middle, **mark.line)
        entries.append(legend_line(mark, STAGE_TITLES.get(stage, stage)))
    threads = ", ".join(map(str, sorted(set(times["threads"]))))
    unit = f"seconds, {threads} thread{'' if threads == '1' else 's'}"
    axes.set(xscale="log", yscale="log", xlabel="candidates in the bounding box, n", ylabel=unit)
    axes.xaxis.set_major_formatter(EngFormatter(sep=""))
    axes.yaxis.set_major_formatter("{x:g}")
    light_grid(axes, "both")
    _draw_guides(axes, (float(times["candidates"].min()), float(times["candidates"].max())))
    figure.legend(handles=entries, loc="outside upper center", ncols=len(entries), handlelength=1.4, columnspacing=0.9)


def _draw_guides(axes: Axes, counts: tuple[float, float]) -> None:
    """Draw short lines of known slopes in the corner at the lower right, where no stage is.

    Parameters
    ----------
    axes
        With all lines.
    counts
        The least and the largest number of candidates.
    """
    length = (counts[1] / counts[0]) ** GUIDE_LENGTH
    low, high = axes.get_ylim()
    start, floor = counts[1] / length, low * (high / low) ** 0.04
    for slope, label in SLOPES.items():
        end = (counts[1], floor * length**slope)
        axes.plot([start, end[0]], [floor, end[1]], color=GREY, linewidth=0.8, zorder=1)
        axes.annotate(label, end, (2, 0), textcoords="offset points", color=GREY, fontsize=7, va="center")
    axes.set_ylim(low, high)


def draw_scaling_from_files(paths: Sequence[Path], times: Path) -> None:
    """Draw what :func:`morphoskel.evaluation.scaling.write_scaling` measured.

    Parameters
    ----------
    paths
        Files to write, see :func:`morphoskel.reporting.figure_page.figure_page`.
    times
        The CSV file.

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    frame = read_scaling(times)
    with figure_page(paths, COLUMN_WIDTH, HEIGHT) as figure:
        plot_scaling(figure, frame)
