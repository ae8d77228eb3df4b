"""The paper's table of processing times, with our own breakdown by stage and by surface reconstruction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import MEAN_OVER_SHAPES, averages
from morphoskel.reporting.comparison import (
    compose_footnotes,
    measured_frame,
    measured_rows,
    origin_footnote,
    weight_footnote,
    withhold_averages,
)
from morphoskel.reporting.names import skeleton_name, surface_name
from morphoskel.reporting.published import derive_mean_times, published_shape_counts, read_published
from morphoskel.reporting.table import ResultTable, assemble
from morphoskel.stages import SKELETON_STAGES, TIMED_STAGES

if TYPE_CHECKING:
    import pandas as pd

TIME_COLUMNS = ("id", "category", "surface", "stage", "seconds")
"""Columns of the per-shape rows."""

MACHINE = "The paper's times were measured on an Intel Core i7-12800H with 32 GB, ours on the machine of this run."


def processing_time(times: pd.DataFrame, published_folder: Path, *, dataset: str, seeds: Sequence[int]) -> ResultTable:
    """Build the table of seconds a shape by category: the paper's columns, then each stage and every surface.

    The paper's Poisson and Watertight are our stages ``reconstruct`` and ``watertight``, its MS3D is the sum of
    :data:`morphoskel.stages.SKELETON_STAGES`, all on the Poisson surface. A mean time is always divided by the number
    of shapes, as it is in the paper, so the rows say ``correct`` under either protocol.

    Parameters
    ----------
    times
        Columns :data:`TIME_COLUMNS`, one row a shape, surface and stage. `surface` is the name of the configuration;
        `seconds` is NaN if the stage failed. A shape without a row for a stage counts as failed there.
    published_folder
        The folder ``config/paper``.
    dataset, seeds
        How the rows came to be.

    Returns
    -------
    ResultTable
        The metric is seconds.

    Raises
    ------
    InputError
        If a column is missing, a row is illegal or appears twice, or the published table cannot be read.
    """
    _check(times)
    rows: list[dict[str, object]] = []
    categories: dict[str, list[str]] = {}
    for surface, of_surface in times.groupby("surface", sort=False):
        shapes = _seconds_by_stage(of_surface)
        for method, stages in _methods(surface_name(str(surface))).items():
            # A sum over stages is NaN, that is failed, as soon as one of them has no time.
            values = [math.fsum(seconds.get(stage, math.nan) for stage in stages) for seconds in shapes.values()]
            categories[method] = [category for category, _ in shapes]
            rows.extend(measured_rows(method, "seconds", averages(values, categories[method], "correct")))

    counts = published_shape_counts(published_folder)
    published = derive_mean_times(read_published(published_folder, "processing_time"))
    published, withheld = withhold_averages(published, categories)
    frame = assemble(measured_frame(rows), published, dataset=dataset, seeds=seeds, protocol="correct")
    weights = "" if withheld else weight_footnote(categories, counts)
    footnotes = [origin_footnote(dataset, counts), MACHINE, withheld, weights, _failures(frame)]
    return ResultTable(frame, compose_footnotes(footnotes, published))


def _methods(surface: str) -> dict[str, tuple[str, ...]]:
    """Return the rows of one surface: their names, and the stages that each sums up."""
    ms3d = skeleton_name("ms3d")
    after = "" if surface == surface_name("poisson") else f" after {surface}"
    return {
        surface: ("reconstruct",),
        f"Watertight{after}": ("watertight",),
        f"{ms3d}{after}": SKELETON_STAGES,
        **{f"{ms3d}{after}: {stage}": (stage,) for stage in SKELETON_STAGES},
        f"{skeleton_name('ms3d_coverage')}{after}: selection": ("cover_skeleton",),
    }


def _seconds_by_stage(times: pd.DataFrame) -> dict[tuple[str, str], dict[str, float]]:
    """Return the seconds of each stage, by category and id of the shape."""
    shapes: dict[tuple[str, str], dict[str, float]] = {}
    for row in times.to_dict("records"):
        key = (str(row["category"]), str(row["id"]))
        shapes.setdefault(key, {})[str(row["stage"])] = float(row["seconds"])
    return shapes


def _failures(frame: pd.DataFrame) -> str:
    """Count the shapes without a time."""
    failed = frame[(frame["group"] == MEAN_OVER_SHAPES) & (frame["n_failed"] > 0)]
    counted = [
        f"{row['method']} {row['n_failed']} of {row['n'] + row['n_failed']}" for row in failed.to_dict("records")
    ]
    return f"Shapes without a time, which are left out of the means: {', '.join(counted)}." if counted else ""


def _check(times: pd.DataFrame) -> None:
    """Raise unless the rows have their columns, known stages, legal times, and appear once."""
    missing = [column for column in TIME_COLUMNS if column not in times.columns]
    if missing:
        raise InputError(f"rows of times: the columns {', '.join(missing)} are missing")
    problems = {
        "id, category and surface must not be empty": times[["id", "category", "surface"]].isna().any(axis=1),
        f"unknown stage; expected one of {', '.join(TIMED_STAGES)}": ~times["stage"].isin(TIMED_STAGES),
        "expected a finite number of seconds, at least 0": (times["seconds"] < 0) | (times["seconds"] == math.inf),
        "a second time; expected one a shape, surface and stage": times.duplicated(list(TIME_COLUMNS[:-1])),
    }
    for problem, concerned in problems.items():
        if concerned.any():
            row = times[concerned].iloc[0]
            raise InputError(f"times of shape {row['id']}, {row['surface']}, {row['stage']}: {problem}")
