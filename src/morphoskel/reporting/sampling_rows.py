"""The per-shape and per-draw results of samplers, as the tables expect them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.reporting.sampling_names import CHOICE_SUFFIXES, CLASSIFIER_SUFFIXES, SAMPLER_NAMES

if TYPE_CHECKING:
    import pandas as pd

SETTING = ["sampler", "ratio", "seed", "choice", "classifier"]

SHAPE_COLUMNS = (
    *SETTING,
    *("id", "category", "status", "reason"),
    *("correct", "average_precision", "average_precision_excluded", "distinct"),
)
"""Columns of the per-shape rows: `ratio` is text, `seed` that of the training (0 without one), `correct` the share of
the draws that were classified correctly, the average precisions lie in [0, 1] with the query counted and left out, and
`distinct` is the mean number of distinct points. A failed shape has the status ``failed``, a reason and no numbers."""

DRAW_COLUMNS = (*SETTING, "draw", "oa", "map", "map_excluded")
"""Columns of the per-draw rows: accuracy and mean average precisions of one draw of the whole test set, in [0, 1]."""


def check_shape_rows(shapes: pd.DataFrame) -> None:
    """Raise unless per-shape rows are complete and legal.

    Parameters
    ----------
    shapes
        Columns :data:`SHAPE_COLUMNS`.

    Raises
    ------
    InputError
        If columns are missing, a name is unknown, a number is illegal, a shape appears twice in a setting, or it is
        absent for one of the trainings.
    """
    _check_columns(shapes, SHAPE_COLUMNS, "per-shape rows")
    ok = shapes["status"] == "ok"
    shares = {column: _is_share(shapes[column]) for column in ("correct", "average_precision")}
    excluded = shapes["average_precision_excluded"]
    problems = {
        **_setting_problems(shapes),
        "id and category must not be empty": shapes[["id", "category"]].isna().any(axis="columns"),
        "expected the status ok or failed": ~shapes["status"].isin(["ok", "failed"]),
        **{f"status is ok, but {name} is not in [0, 1]": ok & ~legal for name, legal in shares.items()},
        "average_precision_excluded is neither in [0, 1] nor empty": ok & ~(_is_share(excluded) | excluded.isna()),
        "status is ok, but the number of distinct points is not at least 1": ok & ~(shapes["distinct"] >= 1),
        "the status is failed, but there are numbers": ~ok & shapes["correct"].notna(),
        "a second row; expected one a shape and setting": shapes.duplicated([*SETTING, "category", "id"]),
    }
    _raise_first(shapes, problems, "shape", "id")
    row = [column for column in SETTING if column != "seed"]
    trainings = shapes.groupby(row)["seed"].transform("nunique")
    of_shape = shapes.groupby([*row, "category", "id"])["seed"].transform("nunique")
    problem = "not every training has this shape; evaluate the missing ones, or leave the training out"
    _raise_first(shapes, {problem: of_shape < trainings}, "shape", "id")


def check_draw_rows(draws: pd.DataFrame) -> None:
    """Raise :class:`InputError` unless per-draw rows, columns :data:`DRAW_COLUMNS`, are legal and appear once."""
    _check_columns(draws, DRAW_COLUMNS, "per-draw rows")
    problems = {
        **_setting_problems(draws),
        **{
            f"{name} is neither in [0, 1] nor empty": ~(_is_share(draws[name]) | draws[name].isna())
            for name in ("oa", "map")
        },
        "a second row; expected one a draw and setting": draws.duplicated([*SETTING, "draw"]),
    }
    _raise_first(draws, problems, "draw", "draw")


def _setting_problems(rows: pd.DataFrame) -> dict[str, pd.Series[bool]]:
    """Return which rows have illegal names of a setting, by problem."""
    known = {"sampler": SAMPLER_NAMES, "choice": CHOICE_SUFFIXES, "classifier": CLASSIFIER_SUFFIXES}
    return {
        **{f"unknown {name}; known are {', '.join(names)}": ~rows[name].isin(names) for name, names in known.items()},
        "expected a whole number of at least 1 as ratio": ~rows["ratio"].astype(str).str.fullmatch("[1-9][0-9]*"),
        "expected a whole number of at least 0 as seed": ~rows["seed"].astype(str).str.fullmatch("[0-9]+"),
    }


def _is_share(values: pd.Series[float]) -> pd.Series[bool]:
    """Return which values lie in [0, 1]."""
    return values.between(0, 1)


def _check_columns(rows: pd.DataFrame, columns: tuple[str, ...], name: str) -> None:
    """Raise if columns are missing."""
    missing = [column for column in columns if column not in rows.columns]
    if missing:
        raise InputError(f"{name}: the columns {', '.join(missing)} are missing")


def _raise_first(rows: pd.DataFrame, problems: dict[str, pd.Series[bool]], what: str, column: str) -> None:
    """Raise with the first row that has a problem."""
    for problem, concerned in problems.items():
        if concerned.any():
            row = rows[concerned].iloc[0]
            setting = ", ".join(f"{name} {row[name]}" for name in SETTING)
            raise InputError(f"{what} {row[column]} ({setting}): {problem}")
