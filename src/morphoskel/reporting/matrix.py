"""The layout of a result table, common to its Markdown and its LaTeX form: what stands in which cell, as plain text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from morphoskel.evaluation.averages import AVERAGES
from morphoskel.reporting.metrics import METRICS, Metric
from morphoskel.reporting.sampling_names import PLAIN_CLASSIFIER

if TYPE_CHECKING:
    import pandas as pd

NOT_RUN = "not run"
"""What stands for a value that was not computed."""

FAILED = "failed"
"""What stands for a value that could not be computed, since shapes that it needs failed."""

WIDEST = 12
"""Columns of values that fit on a page side by side."""


@dataclass(frozen=True)
class Line:
    """One line of a method: ``paper``, ``ours`` or ``difference``.

    Parameters
    ----------
    label
        Which of the three it is.
    cells
        Text of each column; ``None`` where there is nothing to show.
    best
        Whether each cell is the best of its column.
    """

    label: str
    cells: tuple[str | None, ...]
    best: tuple[bool, ...]


@dataclass(frozen=True)
class MethodBlock:
    """The lines of one method. A line without any value is left out, but ``ours`` never is."""

    method: str
    lines: tuple[Line, ...]


@dataclass(frozen=True)
class MetricMatrix:
    """The values of one metric: methods as blocks of rows, groups as columns.

    Parameters
    ----------
    metric, groups, blocks
        What is shown.
    companions
        The metrics written behind the values of `metric`.
    part
        Which columns these are, if not all fit on a page.
    """

    metric: Metric
    groups: tuple[str, ...]
    blocks: tuple[MethodBlock, ...]
    companions: tuple[Metric, ...] = ()
    part: str = ""

    @property
    def heading(self) -> str:
        """Heading of the metric, which part it is, then what its companions are."""
        first = f"{self.metric.heading}: {self.part}" if self.part else self.metric.heading
        return ", ".join([first, *(companion.title for companion in self.companions if companion.title)])


@dataclass(frozen=True)
class _Cell:
    """Numbers of one cell, NaN where there is none, and the text of the companions behind its value."""

    value: float
    paper: float
    n: int
    n_failed: int
    behind: str = ""


def metric_matrices(frame: pd.DataFrame) -> list[MetricMatrix]:
    """Lay out a result table, one matrix a metric, or several if it has more than :data:`WIDEST` columns.

    Parameters
    ----------
    frame
        As returned by :func:`morphoskel.reporting.table.assemble`, whose order of methods and groups is kept.

    Returns
    -------
    list
        A matrix for each metric of `frame` that is no part of another, in the order of the registry. One that is too
        wide has a matrix of its averages, then some of equally many columns for the others.
    """
    return [
        matrix
        for name, metric in METRICS.items()
        if not metric.part_of and (frame["metric"] == name).any()
        for matrix in _matrices_of(metric, frame)
    ]


def rivals(method: str) -> str:
    """Return what a row's name says of the conditions that it shares with its rivals; empty for the usual ones.

    Only rows under the same conditions are compared for the best value: an equal number of balls, an equal share of
    labelled points, or another classifier than that of the other rows.
    """
    found = re.search(rf", \d+ balls$|, ratio \d+$|{re.escape(PLAIN_CLASSIFIER)}$", method)
    return found.group() if found else ""


def cell_text(value: float, n: int, n_failed: int, metric: Metric) -> str:
    """Return a computed value as readers see it, or why there is none."""
    if metric.never_zero and 0 < value < 0.5 * 10**-metric.decimals:
        return f"< {10**-metric.decimals:.{metric.decimals}f}"
    if not math.isnan(value):
        return _signless_zero(f"{value:.{metric.decimals}f}")
    return NOT_RUN if n == 0 and n_failed == 0 else FAILED


def _matrices_of(metric: Metric, frame: pd.DataFrame) -> Iterator[MetricMatrix]:
    """Lay out the rows of one metric, with those of its companions behind them."""
    rows = frame[frame["metric"] == metric.name]
    companions = [other for other in METRICS.values() if other.part_of == metric.name]
    behind = _texts_behind(frame, companions)
    # A method may have groups that the methods before it lack, so that appearance alone would put them behind averages,
    # and a small ratio behind a large one.
    groups = tuple(sorted(dict.fromkeys(map(str, rows["group"])), key=_order_of_groups))
    cells: dict[str, dict[str, _Cell]] = {}
    columns = ("method", "group", "value", "paper", "n", "n_failed")
    for method, group, value, paper, n, n_failed in zip(*(rows[column] for column in columns), strict=True):
        cells.setdefault(str(method), {})[str(group)] = _Cell(
            float(value), float(paper), int(n), int(n_failed), behind.get((str(method), str(group)), "")
        )
    best = {
        condition: {group: _best([row[group].value for row in compared if group in row], metric) for group in groups}
        for condition in {rivals(name) for name in cells}
        for compared in [[row for name, row in cells.items() if rivals(name) == condition]]
    }
    for part, shown in _parts(groups):
        blocks = tuple(_method_block(method, row, shown, best[rivals(method)], metric) for method, row in cells.items())
        present = set(frame.loc[frame["group"].isin(shown), "metric"])
        yield MetricMatrix(metric, shown, blocks, tuple(other for other in companions if other.name in present), part)


def _parts(groups: tuple[str, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield groups that fit on a page side by side, with a name for them if those are not all."""
    if len(groups) <= WIDEST:
        yield "", groups
        return
    averages = tuple(group for group in groups if group in AVERAGES)
    if averages:
        yield "averages", averages
    others = groups[: len(groups) - len(averages)]
    width = math.ceil(len(others) / math.ceil(len(others) / WIDEST))
    for start in range(0, len(others), width):
        part = others[start : start + width]
        yield f"{part[0]} to {part[-1]}", part


def _order_of_groups(group: str) -> tuple[bool, int]:
    """Sort ratios by size and averages last; categories keep their places."""
    return group in AVERAGES, int(group) if group.isdecimal() else 0


def _texts_behind(frame: pd.DataFrame, companions: Sequence[Metric]) -> dict[tuple[str, str], str]:
    """Return the text of all companions by method and group; a companion without a value has none."""
    texts: dict[tuple[str, str], str] = {}
    for companion in companions:
        rows = frame[(frame["metric"] == companion.name) & frame["value"].notna()]
        for method, group, value in zip(rows["method"], rows["group"], rows["value"], strict=True):
            key = (str(method), str(group))
            texts[key] = texts.get(key, "") + companion.form.format(cell_text(float(value), 1, 0, companion))
    return texts


def _best(values: list[float], metric: Metric) -> str | None:
    """Return the best of the values as shown; ``None`` if there are no rivals to be better than."""
    computed = [value for value in values if not math.isnan(value)]
    if metric.better is None or len(computed) < 2:
        return None
    return cell_text(min(computed) if metric.better == "lower" else max(computed), 1, 0, metric)


def _method_block(
    method: str, row: dict[str, _Cell], groups: tuple[str, ...], best: dict[str, str | None], metric: Metric
) -> MethodBlock:
    """Lay out the lines of one method."""
    none = _Cell(math.nan, math.nan, 0, 0)
    cells = [row.get(group, none) for group in groups]
    paper = tuple(None if math.isnan(cell.paper) else cell_text(cell.paper, 1, 0, metric) for cell in cells)
    ours = tuple(
        cell_text(row[group].value, row[group].n, row[group].n_failed, metric) if group in row else None
        for group in groups
    )
    difference = tuple(
        None
        if math.isnan(cell.value - cell.paper)
        else _signless_zero(f"{cell.value - cell.paper:+.{metric.decimals}f}")
        for cell in cells
    )
    plain = (False,) * len(groups)
    is_best = tuple(text is not None and text == best[group] for text, group in zip(ours, groups, strict=True))
    complete = tuple(None if text is None else text + cell.behind for text, cell in zip(ours, cells, strict=True))
    lines = (
        Line("paper", paper, plain),
        Line("ours", complete, is_best),
        Line("difference", difference, plain),
    )
    return MethodBlock(method, tuple(line for line in lines if line.label == "ours" or any(line.cells)))


def _signless_zero(text: str) -> str:
    """Return `text` without a sign if it is a rounded zero."""
    return text.lstrip("+-") if float(text) == 0 else text
