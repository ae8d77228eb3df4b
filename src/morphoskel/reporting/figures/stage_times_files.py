"""Draw the seconds of every stage from the times of a run."""

from __future__ import annotations

from collections.abc import Sequence, Set
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.csv_frame import read_csv_frame
from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES, MEAN_OVER_SHAPES
from morphoskel.reporting.figure_page import TEXT_WIDTH, figure_page
from morphoskel.reporting.figures.stage_times import plot_stage_times, stage_times
from morphoskel.reporting.published import derive_mean_times, read_published
from morphoskel.reporting.time_table import TIME_COLUMNS

if TYPE_CHECKING:
    import pandas as pd

ROW_HEIGHT, MARGINS = 0.3, 0.95
"""Inches of the row of a bar, and of what is around the rows."""


def draw_stage_times_from_files(paths: Sequence[Path], times: Sequence[Path], published_folder: Path) -> None:
    """Draw the mean seconds of each stage.

    The published means are drawn if they are over the same categories.

    Parameters
    ----------
    paths
        Files to write, see :func:`morphoskel.reporting.figure_page.figure_page`.
    times
        CSV files of per-shape times, one a surface reconstruction, with the columns
        :data:`morphoskel.reporting.time_table.TIME_COLUMNS`.
    published_folder
        The folder ``config/paper``.

    Raises
    ------
    InputError
        If there is no file, one cannot be read, or a shape has two times for a stage.
    """
    rows = read_times(times)
    bars, published = stage_times(rows), published_means(set(rows["category"]), published_folder)
    with figure_page(paths, TEXT_WIDTH, MARGINS + ROW_HEIGHT * (len(bars) + bool(published))) as figure:
        plot_stage_times(figure, bars, published)


def published_means(categories: Set[str], published_folder: Path) -> dict[str, float]:
    """Return the published mean seconds over shapes, by column of the table.

    Parameters
    ----------
    categories
        Those of the run; if they are not the published ones, no mean is returned, for it would be over other shapes.
    published_folder
        The folder ``config/paper``.
    """
    means = derive_mean_times(read_published(published_folder, "processing_time"))
    if set(means["group"]) - set(AVERAGES) != categories:
        return {}
    of_shapes = means[means["group"] == MEAN_OVER_SHAPES]
    return {str(name): float(value) for name, value in zip(of_shapes["method"], of_shapes["value"], strict=True)}


def read_times(paths: Sequence[Path]) -> pd.DataFrame:
    """Read the times of several surface reconstructions.

    Parameters
    ----------
    paths
        CSV files with the columns :data:`morphoskel.reporting.time_table.TIME_COLUMNS`.

    Returns
    -------
    pandas.DataFrame
        The rows of all files, in their order; the times of stages that failed are NaN.

    Raises
    ------
    InputError
        If there is no file, one cannot be read, or a shape has two times for a stage.
    """
    import pandas as pd

    if not paths:
        raise InputError("expected at least one file of times, one a surface reconstruction; got none")
    rows = pd.concat([_read_file(path) for path in paths], ignore_index=True)
    twice = rows[rows.duplicated(list(TIME_COLUMNS[:-1]))]
    if len(twice):
        row = twice.iloc[0]
        raise InputError(
            f"{', '.join(map(str, paths))}: {row['id']}, {row['surface']}, {row['stage']}: a second time; "
            "expected one a shape and stage"
        )
    return rows


def _read_file(path: Path) -> pd.DataFrame:
    """Read the times of one surface reconstruction; those of stages that failed are NaN."""
    types = {name: float if name == "seconds" else str for name in TIME_COLUMNS}
    frame = read_csv_frame(path, TIME_COLUMNS, dtype=types, keep_default_na=False, na_values={"seconds": [""]})
    return frame[list(TIME_COLUMNS)]
