"""How well the task network does with few points: accuracy or retrieval against the number of points, by sampler."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from morphoskel.errors import InputError
from morphoskel.reporting.figure_page import TEXT_WIDTH, figure_page
from morphoskel.reporting.figures.curves import (
    GREY,
    Curve,
    absence,
    count_axis,
    has_deviations,
    has_published,
    light_grid,
    numbers_of_points,
    plot_curve,
    reading_guide,
)
from morphoskel.reporting.metrics import find_metric
from morphoskel.reporting.result_rows import read_result_rows
from morphoskel.reporting.sampling_names import ALL_POINTS, PRIOR_TABLE, SAMPLER_NAMES, belongs
from morphoskel.reporting.sampling_rows import DRAW_COLUMNS, check_draw_rows
from morphoskel.reporting.sampling_values import deviation_over_draws
from morphoskel.reporting.table import read_table
from morphoskel.sampling.choice import DRAWN
from morphoskel.sampling.samplers import GENERATORS, PRIORS, TRAINING_FREE

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

PUBLISHED_POINTS = 1024
"""Points of the clouds that the paper samples from."""

OURS = "ms3d"

PANELS = {
    "Without learning": (OURS, *TRAINING_FREE),
    "Learned": (OURS, *GENERATORS, "skeleton_aware"),
    "Learned, by the skeleton of the prior": (OURS, *(prior for prior in PRIORS if prior != OURS)),
}
"""Which samplers share a panel; MS3D is in all of them."""

HEIGHT = 3.75

Score = Literal["oa", "map"]

TABLES: dict[Score, tuple[str, ...]] = {
    "oa": ("object_classification", PRIOR_TABLE),
    "map": ("point_cloud_retrieval",),
}
"""The tables of each metric."""


def plot_against_ratio(
    figure: Figure, curves: Mapping[str, Curve], *, label: str, all_points: float = math.nan
) -> None:
    """Draw the curves of all samplers in panels that share both axes.

    Parameters
    ----------
    figure
        An empty figure.
    curves
        By sampler; those of :data:`PANELS` that are absent are not compared.
    label
        Of the vertical axis.
    all_points
        The value of the clouds themselves, drawn as a horizontal line; NaN for none.
    """
    everything = list(curves.values())
    counts = numbers_of_points(everything)
    tiles = figure.subplots(1, len(PANELS), sharex=True, sharey=True)
    for axes, (title, samplers) in zip(tiles, PANELS.items(), strict=True):
        entries = [plot_curve(axes, curves[sampler]) for sampler in samplers if sampler in curves]
        if not math.isnan(all_points):
            axes.axhline(all_points, color=GREY, linewidth=0.8, linestyle="--", zorder=0.5)
        axes.set_title(title)
        count_axis(axes, counts, "points chosen")
        light_grid(axes)
        axes.legend(handles=entries, loc="upper left", bbox_to_anchor=(0.0, -0.24), labelspacing=0.35)
    tiles[0].set_ylabel(label)
    tiles[0].set_ylim(top=min(tiles[0].get_ylim()[1], 101.0))  # these are shares in %, only their bands go beyond
    guide = reading_guide(
        deviations=has_deviations(everything),
        published=has_published(everything),
        level="" if math.isnan(all_points) else "all points of a cloud",
    )
    figure.legend(handles=guide, loc="outside upper center", ncols=len(guide))


def sampler_curves(
    metric: Score, tables: Sequence[pd.DataFrame], draws: pd.DataFrame, cloud_points: int
) -> dict[str, Curve]:
    """Return the curve of every sampler that the paper's tables of this metric compare.

    Parameters
    ----------
    metric
        ``oa`` or ``map``.
    tables
        Result tables of samplers; where several have a value, the first counts.
    draws
        Columns :data:`morphoskel.reporting.sampling_rows.DRAW_COLUMNS`; deviations over draws, where the tables have
        none over trainings. May have no row.
    cloud_points
        Points of the clouds of this run.

    Raises
    ------
    InputError
        If the per-draw rows are illegal.
    """
    import pandas as pd

    check_draw_rows(draws)
    usual = draws[(draws["choice"] == DRAWN) & (draws["classifier"] == "dropout")]
    over_draws = {
        (str(sampler), str(ratio)): deviation_over_draws(rows, metric)
        for (sampler, ratio), rows in usual.groupby(["sampler", "ratio"])
    }
    rows = pd.concat([table[table["metric"] == metric] for table in tables])
    curves = {}
    for sampler, title in SAMPLER_NAMES.items():
        if not any(belongs(table, sampler, DRAWN, "dropout") for table in TABLES[metric]):
            continue
        found = rows[rows["method"] == title]
        measured: dict[int, tuple[float, float, float]] = {}
        published: dict[int, tuple[float, float]] = {}
        for row in found.to_dict("records"):
            ratio, value, deviation = int(row["group"]), float(row["value"]), float(row["std"])
            if math.isnan(deviation):
                deviation = over_draws.get((sampler, str(ratio)), math.nan)
            if not math.isnan(value):
                measured.setdefault(ratio, (cloud_points / ratio, value, deviation))
            if not math.isnan(row["paper"]):
                published.setdefault(ratio, (PUBLISHED_POINTS / ratio, float(row["paper"])))
        values = list(measured.values()), list(published.values())
        curves[sampler] = Curve.of(sampler, title, *values, absence(found))
    return curves


def draw_against_ratio_from_files(
    paths: Sequence[Path], tables: Sequence[Path], draw_rows: Sequence[Path], *, metric: Score, cloud_points: int
) -> None:
    """Draw overall accuracy or mean average precision against the number of points.

    Parameters
    ----------
    paths
        Files to write, see :func:`morphoskel.reporting.figure_page.figure_page`.
    metric
        ``oa`` or ``map``.
    tables
        CSV files of result tables: those of object classification and of the priors for ``oa``, that of retrieval for
        ``map``. Where several have a value, the first counts.
    draw_rows
        CSV files of per-draw results, one a sampler.
    cloud_points
        Points of the clouds of this run.

    Raises
    ------
    InputError
        If a file cannot be read, no sampler has a value, or the metric is another one.
    """
    if metric not in ("oa", "map"):
        raise InputError(f"metric: expected oa or map, got {metric!r}")
    if not tables:
        raise InputError("expected at least one table of samplers; got none")
    frames = [read_table(table) for table in tables]
    curves = sampler_curves(metric, frames, read_result_rows(draw_rows, DRAW_COLUMNS), cloud_points)
    if not any(len(curve.measured) + len(curve.published) for curve in curves.values()):
        listed = ", ".join(map(str, tables))
        raise InputError(f"{listed}: no value of the metric {metric!r} for any sampler; expected tables of samplers")
    unsampled = [
        float(value)
        for frame in frames
        for value in frame.loc[
            (frame["metric"] == f"{metric}_all_points") & (frame["method"] == SAMPLER_NAMES[ALL_POINTS]), "value"
        ]
    ]
    label = f"{find_metric(metric).title} ({find_metric(metric).unit})"
    with figure_page(paths, TEXT_WIDTH, HEIGHT) as figure:
        plot_against_ratio(figure, curves, label=label, all_points=next(iter(unsampled), math.nan))
