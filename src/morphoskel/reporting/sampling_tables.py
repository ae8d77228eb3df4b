"""The paper's three tables of samplers: classification, retrieval, and the skeleton behind the prior."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import Average
from morphoskel.evaluation.protocol import EvaluationProtocol
from morphoskel.reporting.comparison import compose_footnotes, measured_frame
from morphoskel.reporting.metrics import METRICS
from morphoskel.reporting.published import read_published
from morphoskel.reporting.sampling_footnotes import sampling_footnotes
from morphoskel.reporting.sampling_names import (
    ALL_POINTS,
    COMPARISONS,
    PRIOR_TABLE,
    SAMPLER_NAMES,
    SAMPLING_TABLES,
    belongs,
    difference_name,
    ordered_names,
    row_name,
)
from morphoskel.reporting.sampling_rows import check_draw_rows, check_shape_rows
from morphoskel.reporting.sampling_values import (
    deviation_over_draws,
    equality_test,
    interval_half_width,
    mean_over_shapes,
    subtract,
)
from morphoskel.reporting.table import ResultTable, assemble
from morphoskel.sampling.choice import ARGMAX, DRAWN
from morphoskel.sampling.samplers import TRAINING_FREE

if TYPE_CHECKING:
    import pandas as pd

CELL = ["sampler", "choice", "classifier", "ratio"]

MAIN_METRICS = {"object_classification": "oa", "point_cloud_retrieval": "map", PRIOR_TABLE: "oa"}
"""What each table is about; with the name of the table it is the name of the file of published values."""

COLUMNS_OF = {"oa": "correct", "map": "average_precision"}


def build_sampling_table(
    name: str,
    shapes: pd.DataFrame,
    draws: pd.DataFrame,
    published_folder: Path,
    *,
    dataset: str,
    protocol: EvaluationProtocol,
) -> ResultTable:
    """Build one of the sampling tables.

    Parameters
    ----------
    name
        One of :data:`morphoskel.reporting.sampling_names.SAMPLING_TABLES`.
    shapes
        Columns :data:`morphoskel.reporting.sampling_rows.SHAPE_COLUMNS`, one row a shape and setting, of any samplers:
        rows that the table does not have are left aside.
    draws
        Columns :data:`morphoskel.reporting.sampling_rows.DRAW_COLUMNS`, one row a draw of a whole test set. May have
        no row.
    published_folder
        The folder ``config/paper``.
    dataset
        Name of the data set.
    protocol
        Under either the main measure of retrieval counts the query itself, as published; ``correct`` adds the one that
        leaves it out. Nothing else depends on it: an accuracy is the share of the shapes that have one.

    Returns
    -------
    ResultTable
        Groups are sampling ratios. Values are means over shapes and trainings in %; `std` is over trainings, for
        random points over draws; `seeds` are the trainings of each row.

    Raises
    ------
    InputError
        If there is no such table, a column is missing, a row is illegal, appears twice or is absent for a training, or
        the published table cannot be read.
    """
    if name not in SAMPLING_TABLES:
        raise InputError(f"no such table {name!r}; legal are {', '.join(SAMPLING_TABLES)}")
    check_shape_rows(shapes)
    check_draw_rows(draws)
    metric = MAIN_METRICS[name]
    draws_of = dict(iter(draws.groupby(CELL)))
    rows: list[dict[str, object]] = []
    seeds: dict[tuple[str, str, str], set[int]] = {}
    for cell, of_cell in shapes.groupby(CELL, sort=False):
        sampler, choice, classifier, ratio = map(str, cell)
        if belongs(name, sampler, choice, classifier):
            key = (sampler, choice, classifier)
            seeds.setdefault(key, set()).update(of_cell["seed"])
            values = _cells(metric, protocol, key, ratio, of_cell, draws_of.get(cell, draws[:0]))
            rows.extend(_measured(row_name(*key), ratio, values))
    rows.extend(_all_points(shapes, metric, name))
    published = read_published(published_folder, f"{name}_{metric}")
    if name == PRIOR_TABLE:
        rows.extend(_differences(shapes))
        published = _with_difference(published)
    frame = assemble(measured_frame(rows), published, dataset=dataset, seeds=[], protocol=protocol)
    trainings = {row_name(*key): " ".join(map(str, sorted(of_row))) for key, of_row in seeds.items()}
    frame = _in_order(frame.assign(seeds=[trainings.get(method, "") for method in frame["method"]]))
    footnotes = sampling_footnotes(name, frame, shapes, draws, list(seeds), dataset)
    return ResultTable(frame, compose_footnotes(footnotes, published))


def _cells(
    metric: str,
    protocol: EvaluationProtocol,
    key: Sequence[str],
    ratio: str,
    shapes: pd.DataFrame,
    draws: pd.DataFrame,
) -> Iterator[tuple[str, Average]]:
    """Yield the values of one row at one ratio by metric."""
    sampler, choice, classifier = key
    column = COLUMNS_OF[metric]
    mean = mean_over_shapes(shapes, column)
    over_draws = deviation_over_draws(draws, metric)
    if sampler in TRAINING_FREE:
        mean = Average(mean.value, over_draws, mean.n, mean.n_failed)
    yield metric, mean
    yield f"{metric}_interval", _like(mean, interval_half_width(shapes, column, metric, *key, ratio))
    if metric == "map":
        if protocol == "correct":
            yield "map_excluded", mean_over_shapes(shapes, "average_precision_excluded")
        return
    if classifier == "dropout":
        if choice == DRAWN:
            yield "oa_draws", _like(mean, over_draws)
        yield "distinct_points", mean_over_shapes(shapes, "distinct", unit=1.0)


def _like(mean: Average, value: float) -> Average:
    """Return another value of the same shapes."""
    return Average(value, math.nan, mean.n, mean.n_failed)


def _measured(row: str, ratio: str, cells: Iterator[tuple[str, Average]]) -> Iterator[dict[str, object]]:
    """Yield measured rows; a companion that has no value is no row."""
    for metric, mean in cells:
        if not math.isnan(mean.value) or not (METRICS[metric].part_of or metric == "oa_draws"):
            yield {"method": row, "group": ratio, "metric": metric, **vars(mean)}


def _all_points(shapes: pd.DataFrame, metric: str, table: str) -> Iterator[dict[str, object]]:
    """Yield what the clouds themselves score, as a metric of its own: at this ratio there is no sampler to compare."""
    unsampled = shapes[shapes["sampler"] == ALL_POINTS]
    for (choice, classifier, ratio), rows in unsampled.groupby(["choice", "classifier", "ratio"], sort=False):
        if classifier == "dropout" or table != PRIOR_TABLE:
            mean = mean_over_shapes(rows, COLUMNS_OF[metric])
            cells = iter([(f"{metric}_all_points", mean)])
            yield from _measured(row_name(ALL_POINTS, str(choice), str(classifier)), str(ratio), cells)


def _differences(shapes: pd.DataFrame) -> Iterator[dict[str, object]]:
    """Yield the paired differences of the table of priors, with p-values where neither row has noise."""
    same = shapes[shapes["classifier"] == "dropout"]
    rows = {(str(s), str(c), str(r)): of for (s, c, r), of in same.groupby(["sampler", "choice", "ratio"], sort=False)}
    ratios = list(dict.fromkeys(map(str, same["ratio"])))
    for choice in (DRAWN, ARGMAX):
        for first, second in COMPARISONS:
            for ratio in ratios:
                left, right = (rows.get((sampler, choice, ratio)) for sampler in (first, second))
                if left is None or right is None:
                    continue
                cells = subtract(left, right, "correct", first, second, choice, ratio)
                p_value = equality_test(left, right) if choice == ARGMAX else None
                if p_value is not None:
                    cells["mcnemar_p"] = p_value
                yield from _measured(difference_name(first, second, choice), ratio, iter(cells.items()))


def _with_difference(published: pd.DataFrame) -> pd.DataFrame:
    """Add the difference of the two samplers that the paper prints."""
    import pandas as pd

    first, second = COMPARISONS[0]
    values = published.pivot(index="group", columns="method", values="value")
    difference = (values[SAMPLER_NAMES[first]] - values[SAMPLER_NAMES[second]]).rename("value").reset_index()
    added = difference.assign(
        table=PRIOR_TABLE, method=difference_name(first, second, DRAWN), metric="oa_difference", note=""
    )
    return pd.concat([published, added[list(published.columns)]], ignore_index=True)


def _in_order(frame: pd.DataFrame) -> pd.DataFrame:
    """Sort the rows by metric, by the order of the samplers, and by ratio."""
    names = ordered_names()
    ranks = frame.assign(
        metric=frame["metric"].map(list(METRICS).index),
        method=frame["method"].map(lambda name: names.index(name) if name in names else len(names)),
        group=frame["group"].map(int),
    )
    return frame.loc[ranks.sort_values(["metric", "method", "group"], kind="stable").index].reset_index(drop=True)
