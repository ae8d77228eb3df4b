"""From per-shape results of a sampler to the cells of its row: means over shapes and trainings, and their spread."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import Average
from morphoskel.evaluation.classification import Interval, mcnemar_p_value, mean_interval, paired_difference
from morphoskel.seeds import derive_generator

if TYPE_CHECKING:
    import pandas as pd

PERCENT = 100.0


def by_training(rows: pd.DataFrame, column: str) -> pd.DataFrame:
    """Return one column as a table of shapes (rows, by category and id) and trainings (columns, by seed)."""
    return rows.pivot(index=["category", "id"], columns="seed", values=column).sort_index()


def by_shape(rows: pd.DataFrame, column: str) -> pd.Series[float]:
    """Return the mean over trainings of each shape, by category and id; NaN if the shape failed under one of them."""
    return by_training(rows, column).mean(axis="columns", skipna=False)


def mean_over_shapes(rows: pd.DataFrame, column: str, unit: float = PERCENT) -> Average:
    """Average the results of one row and one ratio over shapes and trainings.

    Parameters
    ----------
    rows
        Per-shape results, every shape once for each training.
    column
        What to average; NaN where it failed or is not defined.
    unit
        What the values are multiplied by.

    Returns
    -------
    Average
        `std` is the standard deviation (divisor n - 1) over trainings of their means over shapes, NaN for one
        training. A shape without a value under one training is left out of all, so that they average the same shapes;
        `n_failed` counts only shapes that failed.
    """
    table = by_training(rows, column).dropna()
    of_trainings = [unit * _mean(list(table[seed])) for seed in table.columns]
    failed = rows.loc[rows["status"] == "failed", ["category", "id"]].drop_duplicates()
    return Average(
        value=_mean(of_trainings),
        std=_deviation(of_trainings) if len(table) else math.nan,
        n=len(table),
        n_failed=len(failed),
    )


def mean_over_categories(rows: pd.DataFrame, column: str) -> Average:
    """Average the results of one row and one ratio in %, every category weighing the same.

    Parameters
    ----------
    rows, column
        As for :func:`mean_over_shapes`.

    Returns
    -------
    Average
        `std` is over trainings likewise. The value is NaN if every shape of some category failed: without it, the
        average would be one over other categories.
    """
    table = by_training(rows, column).dropna()
    of_categories = table.groupby(level="category").mean().reindex(sorted(set(rows["category"])))
    of_trainings = [PERCENT * _mean(list(of_categories[seed])) for seed in of_categories.columns]
    overall = mean_over_shapes(rows, column)
    return Average(_mean(of_trainings), _deviation(of_trainings), overall.n, overall.n_failed)


def deviation_over_draws(draws: pd.DataFrame, column: str) -> float:
    """Return the standard deviation over draws (divisor n - 1) in %, pooled over trainings; NaN without two draws."""
    variances = [_deviation(list(of_seed[column])) ** 2 for _, of_seed in draws.groupby("seed")]
    return PERCENT * math.sqrt(_mean([variance for variance in variances if not math.isnan(variance)]))


def interval_half_width(rows: pd.DataFrame, column: str, *names: str) -> float:
    """Return half the width, in %, of the 95 % interval of the mean over shapes; NaN for fewer than two shapes.

    Parameters
    ----------
    rows, column
        As for :func:`mean_over_shapes`.
    names
        What the interval is for; together with nothing else they seed the bootstrap.
    """
    values = np.asarray(by_shape(rows, column).dropna(), dtype=np.float64)
    if len(values) < 2:
        return math.nan
    interval = mean_interval(values, derive_generator(0, "interval over shapes", *names))
    return PERCENT * (interval.high - interval.low) / 2


def subtract(
    first: pd.DataFrame, second: pd.DataFrame, column: str, *names: str, metric: str = "oa"
) -> dict[str, Average]:
    """Subtract the mean of one row from that of another over the shapes that have a value in both.

    Parameters
    ----------
    first, second
        Per-shape results of the two rows at one ratio.
    column
        What to subtract.
    names
        As for :func:`interval_half_width`.
    metric
        The metric of the two rows.

    Returns
    -------
    dict
        The difference (first minus second) in points of %, and the ends of its 95 % interval from a paired bootstrap
        over shapes, by the names ``{metric}_difference``, ``{metric}_difference_low`` and ``{metric}_difference_high``.
    """
    left, right, n_failed = _pairs(first, second, column)
    numbers = Interval(math.nan, math.nan, math.nan)
    if len(left):
        generator = derive_generator(0, "paired difference", *names)
        numbers = paired_difference(np.asarray(left, np.float64), np.asarray(right, np.float64), generator)
    return {
        f"{metric}_difference{end}": Average(PERCENT * number, math.nan, len(left), n_failed)
        for end, number in zip(("", "_low", "_high"), numbers, strict=True)
    }


def equality_test(first: pd.DataFrame, second: pd.DataFrame) -> Average | None:
    """Return the p-value of McNemar's exact test on two rows of single predictions.

    Parameters
    ----------
    first, second
        Per-shape results of two rows without noise at one ratio.

    Returns
    -------
    Average or None
        ``None`` if there are several trainings, whose predictions are not independent shapes, or no common shape.

    Raises
    ------
    InputError
        If a shape is neither correct nor wrong, as in a mean over draws.
    """
    if first["seed"].nunique() > 1 or second["seed"].nunique() > 1:
        return None
    left, right, n_failed = _pairs(first, second, "correct")
    if not len(left):
        return None
    shares = left[~(left.isin([0, 1]) & right.isin([0, 1]))].index
    if len(shares):
        category, shape = shares[0]
        raise InputError(
            f"shape {shape} (category {category}): expected correct to be 0 or 1 without noise, got a share; "
            "record one prediction"
        )
    p_value = mcnemar_p_value(left.to_numpy() == 1, right.to_numpy() == 1)
    return Average(p_value, math.nan, len(left), n_failed)


def _pairs(first: pd.DataFrame, second: pd.DataFrame, column: str) -> tuple[pd.Series[float], pd.Series[float], int]:
    """Return the values of the shapes that have one in both rows, and how many shapes of both rows have not."""
    left, right = by_shape(first, column).align(by_shape(second, column), join="inner")
    known = left.notna() & right.notna()
    return left[known], right[known], int((~known).sum())


def _mean(values: list[float]) -> float:
    """Return the mean, NaN of nothing."""
    return math.fsum(values) / len(values) if values else math.nan


def _deviation(values: list[float]) -> float:
    """Return the standard deviation (divisor n - 1), NaN of fewer than two values."""
    if len(values) < 2:
        return math.nan
    mean = _mean(values)
    return math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1))
