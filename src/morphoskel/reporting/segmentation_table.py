"""The paper's table of part segmentation from few labels."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.evaluation.averages import MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES, Average
from morphoskel.evaluation.protocol import EvaluationProtocol
from morphoskel.reporting.comparison import (
    compose_footnotes,
    measured_frame,
    measured_rows,
    weight_footnote,
    withhold_averages,
)
from morphoskel.reporting.metrics import METRICS
from morphoskel.reporting.published import read_published
from morphoskel.reporting.sampling_values import (
    by_training,
    interval_half_width,
    mean_over_categories,
    mean_over_shapes,
    subtract,
)
from morphoskel.reporting.segmentation_footnotes import PUBLISHED_SHAPES, segmentation_footnotes
from morphoskel.reporting.segmentation_names import (
    COMPARISONS,
    STRATEGY_NAMES,
    difference_name,
    row_name,
    row_order,
    split_row,
)
from morphoskel.reporting.segmentation_rows import check_segmentation_rows
from morphoskel.reporting.table import ResultTable, assemble

if TYPE_CHECKING:
    import pandas as pd

PUBLISHED_TABLE = "part_segmentation_miou"


def build_segmentation_table(
    shapes: pd.DataFrame,
    published_folder: Path,
    *,
    dataset: str,
    protocol: EvaluationProtocol,
    decisions: Sequence[str] = (),
    transferred_from: str = "",
) -> ResultTable:
    """Build the table of part segmentation.

    Parameters
    ----------
    shapes
        Columns :data:`morphoskel.reporting.segmentation_rows.SEGMENTATION_COLUMNS`, one row a test shape and training,
        of any strategies. May have no row.
    published_folder
        The folder ``config/paper``.
    dataset
        Name of the data set.
    protocol
        Written to every row; no value depends on it, since the paper's means are divided as they should be.
    decisions
        Sentences: how what the paper leaves open was decided in this run.
    transferred_from
        The data set that learned samplers were trained on.

    Returns
    -------
    ResultTable
        Groups are categories and the two averages. Values are means over shapes and trainings in %; `std` is over
        trainings; `seeds` are the trainings of each row. Of the metric ``labels``, `n` is the number of trainings.

    Raises
    ------
    InputError
        If a column is missing, a row is illegal, appears twice or is absent for a training, or the published table
        cannot be read.
    """
    check_segmentation_rows(shapes)
    of_rows = {(str(s), str(r)): of for (s, r), of in shapes.groupby(["strategy", "ratio"], sort=False)}
    measured: list[dict[str, object]] = []
    for (strategy, ratio), of_row in of_rows.items():
        measured.extend(_row(strategy, ratio, of_row))
    measured.extend(_differences(of_rows))
    categories = {row_name(*key): _categories(of_row) for key, of_row in of_rows.items()}
    published, withheld = withhold_averages(read_published(published_folder, PUBLISHED_TABLE), categories)
    weights = "" if withheld else weight_footnote(categories, PUBLISHED_SHAPES)
    frame = assemble(measured_frame(measured), _completed(published), dataset=dataset, seeds=[], protocol=protocol)
    trainings = {row_name(*key): " ".join(map(str, sorted(set(of["seed"])))) for key, of in of_rows.items()}
    frame = _in_order(frame.assign(seeds=[trainings.get(method, "") for method in frame["method"]]))
    footnotes = segmentation_footnotes(frame, shapes, dataset, decisions, transferred_from)
    return ResultTable(frame, compose_footnotes([*footnotes, withheld, weights], published))


def _categories(shapes: pd.DataFrame) -> list[str]:
    """Return the category of every shape of one row."""
    return [str(category) for category, _ in by_training(shapes, "iou").index]


def _row(strategy: str, ratio: str, shapes: pd.DataFrame) -> Iterator[dict[str, object]]:
    """Yield the measured values of one row."""
    row = row_name(strategy, ratio)
    mean = mean_over_shapes(shapes, "iou")
    means = {str(category): mean_over_shapes(of, "iou") for category, of in shapes.groupby("category")}
    means |= {MEAN_OVER_CATEGORIES: mean_over_categories(shapes, "iou"), MEAN_OVER_SHAPES: mean}
    yield from measured_rows(row, "miou", means)
    half_width = interval_half_width(shapes, "iou", "miou", strategy, ratio)
    if not math.isnan(half_width):
        interval = Average(half_width, math.nan, mean.n, mean.n_failed)
        yield from measured_rows(row, "miou_interval", {MEAN_OVER_SHAPES: interval})
    labels = shapes.groupby("seed")["labels"].first()
    of_trainings = Average(float(labels.mean()), float(labels.std()), len(labels), 0)
    yield from measured_rows(row, "labels", {MEAN_OVER_SHAPES: of_trainings})


def _differences(of_rows: dict[tuple[str, str], pd.DataFrame]) -> Iterator[dict[str, object]]:
    """Yield the paired differences between strategies at each ratio."""
    for ratio in dict.fromkeys(ratio for _, ratio in of_rows):
        for first, second in COMPARISONS:
            left, right = (of_rows.get((strategy, ratio)) for strategy in (first, second))
            if left is None or right is None:
                continue
            cells = subtract(left, right, "iou", "part segmentation", first, second, ratio, metric="miou")
            for metric, cell in cells.items():
                if not (METRICS[metric].part_of and math.isnan(cell.value)):
                    yield from measured_rows(difference_name(first, second, ratio), metric, {MEAN_OVER_SHAPES: cell})


def _completed(published: pd.DataFrame) -> pd.DataFrame:
    """Add cells for the averages that the paper does not print, and its differences between the two strategies."""
    import pandas as pd

    first, second = COMPARISONS[0]
    means = published[published["group"] == MEAN_OVER_SHAPES].set_index("method")["value"]
    added = [(method, MEAN_OVER_CATEGORIES, "miou", math.nan) for method in means.index]
    for name, ratio in map(split_row, means.index):
        if name == STRATEGY_NAMES[first]:
            difference = float(means[row_name(first, ratio)]) - float(means[row_name(second, ratio)])
            added.append((difference_name(first, second, ratio), MEAN_OVER_SHAPES, "miou_difference", difference))
    columns = ["method", "group", "metric", "value"]
    return pd.concat([published[columns], pd.DataFrame(added, columns=columns)], ignore_index=True)


def _in_order(frame: pd.DataFrame) -> pd.DataFrame:
    """Sort the rows by metric, then ratio by ratio; the groups keep their order."""
    ranks = [
        (list(METRICS).index(metric), *row_order(method))
        for metric, method in zip(frame["metric"], frame["method"], strict=True)
    ]
    order = sorted(range(len(frame)), key=ranks.__getitem__)
    return frame.iloc[order].reset_index(drop=True)
