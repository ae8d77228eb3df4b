"""Seconds a shape of every stage, one bar a surface reconstruction, and the published totals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from morphoskel.reporting.figures.marks import TOTAL, mark_of
from morphoskel.reporting.names import skeleton_name, surface_name
from morphoskel.stages import STAGES, TIMED_STAGES

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STAGE_TITLES = {
    "reconstruct": "surface reconstruction",
    "watertight": "watertight conversion",
    "occupancy": "occupancy",
    "udf": "UDF",
    "dilation": "dilation",
    "select_skeleton": "selection by residue",
    "cover_skeleton": "selection by coverage instead",
}

ALTERNATIVE = "cover_skeleton"
"""Takes the place of the last stage, and so stands apart from the bar."""

PUBLISHED_ROWS = {surface_name("poisson"): "reconstruct", "Watertight": "watertight", skeleton_name("ms3d"): TOTAL}
"""The columns of the paper's table, from the cloud to the skeleton, and the marks of what they time."""

TEXT_ROOM = 1.12
"""Length of the axis in that of the longest bar, for the numbers behind it."""

VISIBLE = 0.004
"""Share of the longest bar from which on a stage can be seen."""

BAR = 0.62
"""Height of a bar in rows."""


@dataclass(frozen=True)
class StageTimes:
    """The mean seconds of one bar.

    Parameters
    ----------
    title
        Of the surface reconstruction.
    seconds
        By stage; without any if every shape failed.
    failed, shapes
        Numbers of shapes: those that some stage failed for, which are in no mean, and all.
    """

    title: str
    seconds: Mapping[str, float]
    failed: int = 0
    shapes: int = 0

    @property
    def total(self) -> float:
        """Seconds from the cloud to the skeleton."""
        return math.fsum(self.seconds.get(stage, 0.0) for stage in STAGES)

    @property
    def label(self) -> str:
        """The title, and how many shapes are missing."""
        return f"{self.title}\n({self.failed} of {self.shapes} failed)" if self.failed else self.title


def plot_stage_times(figure: Figure, bars: Sequence[StageTimes], published: Mapping[str, float]) -> None:
    """Draw one horizontal bar a surface reconstruction, and an outlined one of the published means below.

    Parameters
    ----------
    figure
        An empty figure.
    bars
        From top to bottom.
    published
        Seconds by the names of :data:`PUBLISHED_ROWS`; empty for none.
    """
    axes = figure.subplots()
    longest = max([*(bar.total for bar in bars), math.fsum(published.values())])
    gap = 0.008 * longest
    for row, bar in enumerate(bars):
        _plot_bar(axes, row, bar, gap)
    labels = [bar.label for bar in bars]
    if published:
        _plot_published(axes, len(bars), published, gap)
        labels.append(f"{surface_name('poisson')}, published")
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    axes.set_xlim(0, axes.get_xlim()[1] * TEXT_ROOM)
    axes.set_xlabel("seconds a shape, mean over shapes")
    axes.grid(True, axis="x", color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    handles = _legend(bars, bool(published), longest)
    figure.legend(handles=handles, loc="outside upper center", ncols=4, handlelength=1.2, columnspacing=1.4)


def _plot_bar(axes: Axes, row: int, bar: StageTimes, gap: float) -> None:
    """Draw the stages one after the other, the total, and the alternative to the last stage after a gap."""
    start = 0.0
    for stage in STAGES:
        width = bar.seconds.get(stage, 0.0)
        axes.barh(row, width, BAR, left=start, **_style(stage))
        start += width
    if bar.seconds.get(ALTERNATIVE):
        start += gap
        axes.barh(row, bar.seconds[ALTERNATIVE], BAR, left=start, **_style(ALTERNATIVE))
        start += bar.seconds[ALTERNATIVE]
    _write(axes, start + gap, row, _totals(bar))


def _totals(bar: StageTimes) -> str:
    """Return the seconds in all with either selection."""
    if not bar.seconds:
        return "no shape has all stages"
    if ALTERNATIVE not in bar.seconds:
        return f"{bar.total:.2f} s"
    other = bar.total - bar.seconds.get(STAGES[-1], 0.0) + bar.seconds[ALTERNATIVE]
    return f"{bar.total:.2f} s, or {other:.2f} s"


def _plot_published(axes: Axes, row: int, published: Mapping[str, float], gap: float) -> None:
    """Draw the published means as outlines, and their sum."""
    start = 0.0
    for name, mark in PUBLISHED_ROWS.items():
        axes.barh(row, published[name] - gap / 2, BAR, left=start + gap / 4, **_outline(mark))
        start += published[name]
    _write(axes, start + gap, row, f"{start:.2f} s")


def _write(axes: Axes, place: float, row: int, text: str) -> None:
    """Write behind a bar, over the grid."""
    box = {"facecolor": "white", "linewidth": 0.0, "pad": 0.8}
    axes.text(place, row, text, va="center", fontsize=7, bbox=box)


def _style(stage: str) -> dict[str, Any]:
    """Return how a stage looks; the alternative is hatched, since it is no part of the bar."""
    colour = mark_of(stage).colour
    if stage == ALTERNATIVE:
        return {"facecolor": "white", "edgecolor": colour, "hatch": "//////", "linewidth": 0.0}
    return {"facecolor": colour, "linewidth": 0.0}


def _outline(mark: str) -> dict[str, Any]:
    return {"facecolor": "none", "edgecolor": mark_of(mark).colour, "linewidth": 1.2}


def _legend(bars: Sequence[StageTimes], published: bool, longest: float) -> list[Artist]:
    """Return the stages that were timed, with a word where they are too short to be seen."""
    from matplotlib.patches import Patch

    entries: list[Artist] = []
    for stage, title in STAGE_TITLES.items():
        seconds = max((bar.seconds.get(stage, 0.0) for bar in bars), default=0.0)
        if seconds:
            thin = "" if seconds > VISIBLE * longest else f" (at most {1000 * seconds:.2g} ms)"
            entries.append(Patch(label=f"{title}{thin}", **_style(stage)))
    if published:
        entries.append(Patch(label="published, occupancy to selection", **_outline(TOTAL)))
    return entries


def stage_times(times: pd.DataFrame) -> list[StageTimes]:
    """Return the bars of a run, one a surface reconstruction, over the shapes that have a time for every stage.

    Parameters
    ----------
    times
        Columns :data:`morphoskel.reporting.time_table.TIME_COLUMNS`, one row a shape, surface and stage.
    """
    bars = []
    for surface, rows in times.groupby("surface", sort=False):
        of_shapes = rows.pivot(index=["category", "id"], columns="stage", values="seconds")
        whole = of_shapes.reindex(columns=[stage for stage in TIMED_STAGES if stage in of_shapes]).dropna()
        seconds = {str(stage): float(whole[stage].mean()) for stage in whole} if len(whole) else {}
        bars.append(StageTimes(surface_name(str(surface)), seconds, len(of_shapes) - len(whole), len(of_shapes)))
    return bars
