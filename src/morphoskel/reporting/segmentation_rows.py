"""The per-shape results of part segmentation, as the table expects them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES
from morphoskel.reporting.segmentation_names import STRATEGY_NAMES

if TYPE_CHECKING:
    import pandas as pd

SETTING = ["strategy", "ratio", "seed"]

SEGMENTATION_COLUMNS = (*SETTING, "id", "category", "status", "iou", "accuracy", "labels")
"""Columns of the per-shape rows: `ratio` is text, `seed` the number of the training, `iou` the mean over the parts of
the category and `accuracy` the share of the points that are right, both in [0, 1], and `labels` the mean number of
different labelled points of a training shape. A failed shape has the status ``failed`` and neither of the two."""

_SHARES = ("iou", "accuracy")


def check_segmentation_rows(shapes: pd.DataFrame) -> None:
    """Raise unless per-shape rows are complete and legal.

    Parameters
    ----------
    shapes
        Columns :data:`SEGMENTATION_COLUMNS`.

    Raises
    ------
    InputError
        If columns are missing, a name is unknown, a number is illegal, a shape appears twice in a setting, it is absent
        for one of the trainings, or a training has two numbers of labels.
    """
    missing = [column for column in SEGMENTATION_COLUMNS if column not in shapes.columns]
    if missing:
        raise InputError(f"per-shape rows: the columns {', '.join(missing)} are missing")
    ok = shapes["status"] == "ok"
    row = ["strategy", "ratio"]
    trainings = shapes.groupby(row)["seed"].transform("nunique")
    of_shape = shapes.groupby([*row, "category", "id"])["seed"].transform("nunique")
    problems = {
        f"unknown strategy; known are {', '.join(STRATEGY_NAMES)}": ~shapes["strategy"].isin(STRATEGY_NAMES),
        "expected a whole number of at least 1 as ratio": ~shapes["ratio"].astype(str).str.fullmatch("[1-9][0-9]*"),
        "expected a whole number of at least 0 as seed": ~shapes["seed"].astype(str).str.fullmatch("[0-9]+"),
        "id and category must not be empty": shapes[["id", "category"]].isna().any(axis="columns"),
        "its category has the name of an average; rename it": shapes["category"].isin(AVERAGES),
        "expected the status ok or failed": ~shapes["status"].isin(["ok", "failed"]),
        **{f"status is ok, but {name} is not in [0, 1]": ok & ~shapes[name].between(0, 1) for name in _SHARES},
        "the status is failed, but there are numbers": ~ok & shapes[list(_SHARES)].notna().any(axis="columns"),
        "the number of labels is not at least 1": ~(shapes["labels"] >= 1),
        "its training has another number of labels too": shapes.groupby(SETTING)["labels"].transform("nunique") > 1,
        "a second row; expected one a shape and setting": shapes.duplicated([*SETTING, "category", "id"]),
        "not every training has this shape; evaluate the missing ones, or leave the training out": of_shape < trainings,
    }
    for problem, concerned in problems.items():
        if concerned.any():
            first = shapes[concerned].iloc[0]
            setting = ", ".join(f"{name} {first[name]}" for name in SETTING)
            raise InputError(f"shape {first['id']} ({setting}): {problem}")
