"""The result of a run in one sentence, computed from its tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.matrix import cell_text, rivals
from morphoskel.reporting.metrics import Metric, find_metric
from morphoskel.reporting.names import skeleton_name

if TYPE_CHECKING:
    import pandas as pd

OURS = skeleton_name("ms3d")
"""The method that the paper is about; rows that begin with its name are variants of it, and no rivals."""

VARIANT = skeleton_name("ms3d_coverage")
"""Our own selection of its balls."""

NOTHING = "The tables of this run hold no value that MS3D and another method share, so there is nothing to compare yet."


@dataclass(frozen=True)
class Comparison:
    """MS3D beside the best other method, under the same conditions.

    Parameters
    ----------
    metric
        What is compared.
    ours, paper
        The value of MS3D, and what the paper prints for it; NaN where it prints nothing.
    other, method
        The value of the best other method, and which that is.
    shapes
        Number of shapes behind our value.
    """

    metric: Metric
    ours: float
    paper: float
    other: float
    method: str
    shapes: int

    def shown(self, value: float) -> str:
        """Return a value as the tables show it, with a unit that is a sign, which stays on its line."""
        text = cell_text(value, 1, 0, self.metric)
        return f"{text}\N{NO-BREAK SPACE}%" if self.metric.unit == "%" else text

    @property
    def verdict(self) -> str:
        """What the values as shown say of MS3D."""
        if self.shown(self.ours) == self.shown(self.other):
            return "as good as"
        better = (self.ours < self.other) == (self.metric.better == "lower")
        return "better than" if better else "worse than"

    def told(self, shapes: str, kind: str) -> str:
        """Return our value, the paper's, and the other one.

        Parameters
        ----------
        shapes
            Behind our value: how the shapes enter it, with ``{}`` for their number.
        kind
            What the other method is.
        """
        paper = "" if math.isnan(self.paper) else f" (paper: {self.shown(self.paper)})"
        number = shapes.format(f"{self.shapes:,}\N{NO-BREAK SPACE}shapes")
        return (
            f"{self.shown(self.ours)} {number}{paper}, {self.verdict} {_told_surface(self.method)}, the best other "
            f"{kind}, with {self.shown(self.other)}"
        )


def summarise(frames: Mapping[str, pd.DataFrame]) -> str:
    """Return one sentence that sets MS3D beside the best other method, for each table that allows it.

    Parameters
    ----------
    frames
        Result tables by name, as :func:`morphoskel.reporting.table.read_table` returns them.
    """
    clauses = list(_clauses(frames))
    if not clauses:
        return NOTHING
    sentence = "; ".join(clauses) + "."
    return sentence[0].upper() + sentence[1:]


def compare(frame: pd.DataFrame, metric: str, group: str, condition: str = "") -> Comparison | None:
    """Set MS3D beside the best other method in one column of a table.

    Parameters
    ----------
    frame
        The table.
    metric, group
        Which column.
    condition
        End of the names of the methods that are rivals, see :func:`morphoskel.reporting.matrix.rivals`.

    Returns
    -------
    Comparison or None
        ``None`` if MS3D or all others lack a value.
    """
    rows = frame[(frame["metric"] == metric) & (frame["group"] == group) & frame["value"].notna()]
    rows = rows[rows["method"].map(rivals) == condition]
    own = rows[rows["method"] == OURS + condition]
    others = rows[~rows["method"].str.startswith(OURS)]
    if own.empty or others.empty:
        return None
    kind = find_metric(metric)
    best = others.sort_values("value", ascending=kind.better == "lower", kind="stable").iloc[0]
    row = own.iloc[0]
    method = str(best["method"]).removesuffix(condition)
    return Comparison(kind, float(row["value"]), float(row["paper"]), float(best["value"]), method, int(row["n"]))


def _clauses(frames: Mapping[str, pd.DataFrame]) -> Iterator[str]:
    if "skeleton_reconstruction" in frames:
        found = compare(frames["skeleton_reconstruction"], "cd_recon", MEAN_OVER_SHAPES)
        if found:
            variant = _best_variant(frames["skeleton_reconstruction"], found, MEAN_OVER_SHAPES)
            yield f"the balls of {OURS} have a mean CD-Recon of {found.told('over {}', 'skeleton method')}{variant}"
    if "object_classification" in frames:
        yield from _of_classification(frames["object_classification"])
    if "part_segmentation" in frames:
        yield from _of_segmentation(frames["part_segmentation"])


def _best_variant(frame: pd.DataFrame, found: Comparison, group: str) -> str:
    """Return the smallest value of our own selection, if MS3D and all others have larger ones; else nothing."""
    rows = frame[(frame["metric"] == found.metric.name) & (frame["group"] == group) & frame["value"].notna()]
    rows = rows[rows["method"].str.startswith(VARIANT) & (rows["method"].map(rivals) == "")]
    if rows.empty:
        return ""
    best = rows.sort_values("value", kind="stable").iloc[0]
    value = float(best["value"])
    if value >= min(found.ours, found.other):
        return ""
    return f"; our own selection of its balls, {_told_surface(str(best['method']))}, has {found.shown(value)}"


def _told_surface(method: str) -> str:
    """Return the name of a row, which says behind a comma on which surface it works."""
    name, comma, surface = method.partition(", ")
    return f"{name} ({surface})" if comma else name


def _of_classification(frame: pd.DataFrame) -> Iterator[str]:
    """Yield the comparison at the largest ratio, where samplers differ most."""
    ratios = sorted({int(group) for group in frame["group"] if str(group).isdecimal()}, reverse=True)
    for ratio in ratios:
        found = compare(frame, "oa", str(ratio))
        if found:
            points = f"one point in {ratio}, chosen by {OURS}"
            yield f"from {points}, a classifier recognises {found.told('of {}', 'sampler')}"
            return


def _of_segmentation(frame: pd.DataFrame) -> Iterator[str]:
    """Yield the comparison at the largest ratio at which MS3D has a rival."""
    conditions = {rivals(method) for method in frame["method"]} - {""}
    for condition in sorted(conditions, key=lambda words: -int(words.split()[-1])):
        found = compare(frame, "miou", MEAN_OVER_SHAPES, condition)
        if found:
            labels = f"one label in {condition.split()[-1]}, placed by {OURS}"
            yield f"taught with {labels}, part segmentation has a mean IoU of {found.told('over {}', 'sampler')}"
            return
