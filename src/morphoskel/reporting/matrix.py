"""The layout of a result table, common to its Markdown and its LaTeX form: what stands in which cell, as plain text."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from morphoskel.evaluation.averages import AVERAGES
from morphoskel.reporting.metrics import METRICS, Metric, find_metric

if TYPE_CHECKING:
    import pandas as pd

NOT_RUN = "not run"
"""What stands for a value that was not computed."""

FAILED = "failed"
"""What stands for a value that could not be computed, since shapes that it needs failed."""


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
    """All values of one metric: methods as blocks of rows, groups as columns."""

    metric: Metric
    groups: tuple[str, ...]
    blocks: tuple[MethodBlock, ...]


@dataclass(frozen=True)
class _Cell:
    """Numbers of one cell; NaN where there is none."""

    value: float
    paper: float
    n: int
    n_failed: int


def metric_matrices(frame: pd.DataFrame) -> list[MetricMatrix]:
    """Lay out a result table, one matrix a metric.

    Parameters
    ----------
    frame
        As returned by :func:`morphoskel.reporting.table.assemble`, whose order of methods and groups is kept.

    Returns
    -------
    list
        One matrix for each metric of `frame`, in the order of the registry.
    """
    return [
        _metric_matrix(find_metric(name), frame[frame["metric"] == name])
        for name in METRICS
        if (frame["metric"] == name).any()
    ]


def cell_text(value: float, n: int, n_failed: int, metric: Metric) -> str:
    """Return a computed value as readers see it, or why there is none."""
    if not math.isnan(value):
        return _signless_zero(f"{value:.{metric.decimals}f}")
    return NOT_RUN if n == 0 and n_failed == 0 else FAILED


def _metric_matrix(metric: Metric, rows: pd.DataFrame) -> MetricMatrix:
    """Lay out the rows of one metric."""
    # A method may have groups that the methods before it lack, so that appearance alone would put them behind averages.
    groups = tuple(sorted(dict.fromkeys(map(str, rows["group"])), key=lambda group: group in AVERAGES))
    cells: dict[str, dict[str, _Cell]] = {}
    columns = ("method", "group", "value", "paper", "n", "n_failed")
    for method, group, value, paper, n, n_failed in zip(*(rows[column] for column in columns), strict=True):
        cells.setdefault(str(method), {})[str(group)] = _Cell(float(value), float(paper), int(n), int(n_failed))
    best = {
        rivals: {
            group: _best([row[group].value for name, row in cells.items() if _balls(name) == rivals and group in row],
                         metric)
            for group in groups
        }
        for rivals in {_balls(name) for name in cells}
    }  # fmt: skip
    blocks = tuple(_method_block(method, row, groups, best[_balls(method)], metric) for method, row in cells.items())
    return MetricMatrix(metric, groups, blocks)


def _balls(method: str) -> str:
    """Return the equal count at the end of a row's name, if there is one: only such rows are rivals of each other."""
    found = re.search(r", \d+ balls$", method)
    return found.group() if found else ""


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
    lines = (
        Line("paper", paper, plain),
        Line("ours", ours, tuple(text is not None and text == best[g] for text, g in zip(ours, groups, strict=True))),
        Line("difference", difference, plain),
    )
    return MethodBlock(method, tuple(line for line in lines if line.label == "ours" or any(line.cells)))


def _signless_zero(text: str) -> str:
    """Return `text` without a sign if it is a rounded zero."""
    return text.lstrip("+-") if float(text) == 0 else text
