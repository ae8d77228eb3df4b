"""Curves over numbers of points: own values with their deviations, and published ones beside them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.reporting.figures.marks import Mark, mark_of
from morphoskel.reporting.matrix import FAILED, NOT_RUN
from morphoskel.shapes import FloatArray

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

BAND = 0.14
"""Opacity of a band, so little that several can overlap."""

GREY = "#777777"
"""Of what belongs to no curve."""


@dataclass(frozen=True, eq=False)
class Curve:
    """The values of one sampler.

    Parameters
    ----------
    name
        Of the configuration, for the mark.
    title
        For readers.
    measured
        ``(R, 3)`` float64: number of points, value, and its standard deviation, NaN where there is none; without a row
        if it was not run.
    published
        ``(P, 2)`` float64: number of points and value.
    absence
        What a legend says of a sampler without own values, see :func:`absence`.
    """

    name: str
    title: str
    measured: FloatArray
    published: FloatArray
    absence: str = NOT_RUN

    @classmethod
    def of(
        cls,
        name: str,
        title: str,
        measured: Sequence[Sequence[float]],
        published: Sequence[Sequence[float]],
        absence: str = NOT_RUN,
    ) -> Curve:
        """Make a curve of rows in any order."""
        ours, printed = (sorted(rows, key=lambda row: row[0]) for rows in (measured, published))
        return cls(
            name, title, np.reshape(ours, (-1, 3)).astype(float), np.reshape(printed, (-1, 2)).astype(float), absence
        )

    @property
    def entry(self) -> str:
        """Its name in a legend."""
        return self.title if len(self.measured) else f"{self.title} ({self.absence})"


def absence(rows: pd.DataFrame) -> str:
    """Return why rows of a result table have no own value: they were not run, or every shape failed."""
    return FAILED if (rows["n"] + rows["n_failed"] > 0).any() else NOT_RUN


def plot_curve(axes: Axes, curve: Curve) -> Artist:
    """Draw a curve, and return what stands for it in a legend."""
    mark = mark_of(curve.name)
    points, values, deviations = curve.measured.T
    spread = np.nan_to_num(deviations)
    if spread.any():
        band: dict[str, Any] = {"color": mark.colour, "alpha": BAND, "linewidth": 0, "zorder": 1}
        axes.fill_between(points, values - spread, values + spread, **band)
    axes.plot(points, values, **mark.line)
    axes.plot(*curve.published.T, color=mark.colour, linewidth=0.8, linestyle=":", zorder=mark.order - 0.4)
    axes.plot(*curve.published.T, **mark.hollow)
    return legend_line(mark, curve.entry, hollow=not len(curve.measured))


def legend_line(mark: Mark, title: str, *, hollow: bool = False) -> Artist:
    """Return an entry of a legend: a line with the marker, or the hollow marker of what is only published."""
    from matplotlib.lines import Line2D

    return Line2D([], [], label=title, **(mark.hollow if hollow else mark.line))


def reading_guide(*, deviations: bool, published: bool, level: str = "") -> list[Artist]:
    """Return entries of a legend that say how to read the curves, in grey.

    Parameters
    ----------
    deviations, published
        Whether there is any band, and any published value.
    level
        What a dashed horizontal line is; empty if there is none.
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    mark = Mark(GREY, "o")
    entries: list[Artist] = [legend_line(mark, "this run")]
    if deviations:
        entries.append(Patch(color=GREY, alpha=0.25, linewidth=0, label="± one standard deviation"))
    if published:
        dotted: dict[str, Any] = {**mark.hollow, "linestyle": ":", "linewidth": 0.8}
        entries.append(Line2D([], [], label="published", **dotted))
    if level:
        entries.append(Line2D([], [], label=level, color=GREY, linewidth=0.8, linestyle="--"))
    return entries


def has_deviations(curves: Iterable[Curve]) -> bool:
    """Tell whether any of the curves gets a band."""
    return any(np.nan_to_num(curve.measured[:, 2]).any() for curve in curves)


def has_published(curves: Iterable[Curve]) -> bool:
    """Tell whether any of the curves has a published value."""
    return any(len(curve.published) > 0 for curve in curves)


def numbers_of_points(curves: Sequence[Curve]) -> list[int]:
    """Return the powers of two next to the numbers of points of all curves, ascending."""
    points = np.concatenate(
        [np.empty(0), *(rows[:, 0] for curve in curves for rows in (curve.measured, curve.published))]
    )
    return sorted({2 ** int(power) for power in np.rint(np.log2(points))})


def count_axis(axes: Axes, counts: Sequence[int], label: str) -> None:
    """Make the horizontal axis one of numbers of points, logarithmic to the base 2, with ticks at `counts`."""
    from matplotlib.ticker import FixedLocator, NullLocator

    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_locator(FixedLocator(counts))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xticks(counts, [str(count) for count in counts])
    axes.set_xlabel(label)
    if counts:
        axes.set_xlim(counts[0] / 1.25, counts[-1] * 1.25)


def light_grid(axes: Axes, axis: str = "y") -> None:
    """Lay thin grey lines behind the curves."""
    axes.grid(True, axis=axis, color="0.92", linewidth=0.6)  # type: ignore[arg-type]
    axes.set_axisbelow(True)
