"""The numbers that the paper prints, read from ``config/paper``.

Each of its files holds one table with the columns ``table, method, group, metric, value, note``: the values as they
are printed, the known slips only as notes. A group is a category, a sampling ratio or an average.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.csv_frame import read_csv_frame
from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES, MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES
from morphoskel.reporting.metrics import find_metric

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("table", "method", "group", "metric", "value", "note")
"""Columns of a file of published values."""

DERIVED = "recomputed from the printed categories"
"""Note of an average that the paper does not print."""

DERIVED_FROM_TOTALS = "recomputed from the printed totals"
"""Note of a mean time that the paper does not print."""


def read_published(folder: Path, table: str) -> pd.DataFrame:
    """Read one table of the paper.

    Parameters
    ----------
    folder
        The folder ``config/paper``.
    table
        Name of the table, that of its file without the suffix.

    Returns
    -------
    pandas.DataFrame
        The columns :data:`COLUMNS`, one row a printed value, in the order of the file; `value` is float64, everything
        else text.

    Raises
    ------
    InputError
        If there is no such table, or the file does not have this form.
    """
    path = folder / f"{table}.csv"
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in folder.glob("*.csv"))) or "none"
        raise InputError(f"{path}: no such file; the published tables in {folder} are: {known}")
    frame = read_csv_frame(path, COLUMNS, exactly=True, dtype=str, keep_default_na=False)
    keys: set[tuple[str, str, str]] = set()
    for line, row in enumerate(frame.to_dict("records"), start=2):
        if row["table"] != table:
            raise InputError(f"{path}, line {line}: expected the table {table!r}, got {row['table']!r}")
        if row["metric"] == "" or row["method"] == "" or row["group"] == "":
            raise InputError(f"{path}, line {line}: method, group and metric must not be empty")
        try:
            find_metric(row["metric"])
        except InputError as error:
            raise InputError(f"{path}, line {line}: {error}") from error
        key = (row["method"], row["group"], row["metric"])
        if key in keys:
            raise InputError(f"{path}, line {line}: a second value for {', '.join(key)}; remove one")
        keys.add(key)
        _check_number(row["value"], f"{path}, line {line}")
    return frame.astype({"value": float})


def published_shape_counts(folder: Path) -> dict[str, int]:
    """Return the number of test shapes in each category of the skeleton tables, as printed in the time table."""
    time = read_published(folder, "processing_time")
    counts = time[time["metric"] == "shapes"]
    return {str(group): int(value) for group, value in zip(counts["group"], counts["value"], strict=True)}


def derive_averages(published: pd.DataFrame, shape_counts: Mapping[str, int] | None = None) -> pd.DataFrame:
    """Add the averages that the paper does not print, so that every method has both.

    The paper prints one "Average" a method, which is a mean over categories for L1 and a mean over shapes for the
    other methods, so that its averages are not comparable as they stand.

    Parameters
    ----------
    published
        As returned by :func:`read_published`.
    shape_counts
        Number of shapes in each category, the weights of a mean over shapes. Without them only means over categories
        are added.

    Returns
    -------
    pandas.DataFrame
        `published`, then the added rows, whose note is :data:`DERIVED`. Tables without categories gain nothing.

    Raises
    ------
    InputError
        If `shape_counts` lacks a printed category.
    """
    import pandas as pd

    added: list[dict[str, object]] = []
    for (method, metric), rows in published.groupby(["method", "metric"], sort=False):
        values = {str(g): float(v) for g, v in zip(rows["group"], rows["value"], strict=True)}
        printed = set(values)
        categories = {group: value for group, value in values.items() if group not in AVERAGES}
        if all(group.isdigit() for group in categories):  # sampling ratios, over which nobody averages
            continue
        derived = {MEAN_OVER_CATEGORIES: math.fsum(categories.values()) / len(categories)}
        if shape_counts is not None:
            derived[MEAN_OVER_SHAPES] = weighted_mean(categories, shape_counts)
        added.extend(
            {"table": rows["table"].iloc[0], "method": method, "group": group, "metric": metric, "value": value}
            for group, value in derived.items()
            if group not in printed
        )
    if not added:
        return published.copy()
    return pd.concat([published, pd.DataFrame(added, columns=list(COLUMNS)).assign(note=DERIVED)], ignore_index=True)


def derive_mean_times(published: pd.DataFrame) -> pd.DataFrame:
    """Return the time table's seconds a shape, with a mean over shapes from the printed totals for every stage.

    The totals are exact to a hundredth of a second, whereas one printed mean a shape is a slip.
    """
    import pandas as pd

    seconds = published[published["metric"] == "seconds"]
    shapes = float(published.loc[published["metric"] == "shapes", "value"].sum())
    totals = published[published["metric"] == "seconds_total"].groupby("method", sort=False)["value"].sum()
    added = pd.DataFrame(
        {
            "table": seconds["table"].iloc[0],
            "method": list(totals.index),
            "group": MEAN_OVER_SHAPES,
            "metric": "seconds",
            "value": totals.to_numpy() / shapes,
            "note": DERIVED_FROM_TOTALS,
        }
    )
    return pd.concat([seconds, added], ignore_index=True)


def weighted_mean(values: Mapping[str, float], counts: Mapping[str, int]) -> float:
    """Return the mean of the categories' values, each weighted by the category's number of shapes."""
    missing = [category for category in values if category not in counts]
    if missing:
        raise InputError(f"the number of shapes is not known for the categories {', '.join(missing)}")
    return math.fsum(counts[category] * value for category, value in values.items()) / sum(
        counts[category] for category in values
    )


def published_footnotes(published: pd.DataFrame) -> list[str]:
    """Return the notes of the published values, each once, with the cells that it concerns."""
    cells: dict[tuple[str, tuple[str, ...], tuple[str, ...]], list[str]] = {}
    for (note, method), rows in published[published["note"] != ""].groupby(["note", "method"], sort=False):
        groups, metrics = (tuple(dict.fromkeys(map(str, rows[column]))) for column in ("group", "metric"))
        cells.setdefault((str(note), groups, metrics), []).append(str(method))
    footnotes = []
    for (note, groups, metrics), methods in cells.items():
        concerned = published[published["method"].isin(methods) & published["metric"].isin(metrics)]
        everywhere = set(concerned["group"]) == set(groups)
        titles = [find_metric(metric).title for metric in metrics]
        where = [", ".join(methods), "all columns" if everywhere else ", ".join(groups), ", ".join(titles)]
        footnotes.append(f"Paper, {'; '.join(where)}: {note}.")
    return footnotes


def _check_number(text: str, where: str) -> None:
    """Raise unless `text` is a finite number."""
    try:
        finite = math.isfinite(float(text))
    except ValueError:
        finite = False
    if not finite:
        raise InputError(f"{where}: expected a finite number as value, got {text!r}")
