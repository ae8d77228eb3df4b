"""Write the sampling tables from the per-shape and per-draw results of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.errors import InputError
from morphoskel.reporting.result_rows import read_result_rows
from morphoskel.reporting.sampling_names import SAMPLING_TABLES
from morphoskel.reporting.sampling_rows import DRAW_COLUMNS, SHAPE_COLUMNS
from morphoskel.reporting.sampling_tables import build_sampling_table
from morphoskel.reporting.table import compose_caption, write_table

if TYPE_CHECKING:
    import pandas as pd

TITLES = {
    "object_classification": "Accuracy of the task network on the points that each sampler chooses",
    "point_cloud_retrieval": "Retrieval by the task network's descriptors of the points that each sampler chooses",
    "skeleton_prior": "Accuracy on the points that the skeleton-aware sampler chooses, by the skeleton of its prior",
}
NOT_SHAPES = ("oa_difference", "oa_difference_low", "oa_difference_high", "mcnemar_p")
"""Metrics of differences between rows."""


def write_sampling_table(
    name: str,
    shape_rows: Sequence[Path],
    draw_rows: Sequence[Path],
    published_folder: Path,
    stem: Path,
    provenance: Mapping[str, Any],
) -> None:
    """Write one of the tables in :data:`TITLES` as CSV, Markdown and LaTeX.

    Parameters
    ----------
    name
        Name of the table.
    shape_rows, draw_rows
        CSV files of per-shape and of per-draw results, one a sampler, with the columns
        :data:`morphoskel.reporting.sampling_rows.SHAPE_COLUMNS` and
        :data:`morphoskel.reporting.sampling_rows.DRAW_COLUMNS`. Without any file the table says what was not run.
    published_folder
        The folder ``config/paper``.
    stem
        Path of the files without the suffix.
    provenance
        For the caption: ``dataset``, ``seed`` (of the experiment), ``seeds`` (number of trainings of each learned
        sampler), ``draws`` (number), ``budget`` (text, how long a training is), ``protocol`` and ``config`` (hash).

    Raises
    ------
    InputError
        If there is no such table, a file cannot be read, or the rows are not what they should be.
    """
    if name not in SAMPLING_TABLES:
        raise InputError(f"no such table {name!r}; legal are {', '.join(SAMPLING_TABLES)}")
    table = build_sampling_table(
        name,
        read_result_rows(shape_rows, SHAPE_COLUMNS),
        read_result_rows(draw_rows, DRAW_COLUMNS),
        published_folder,
        dataset=provenance["dataset"],
        protocol=provenance["protocol"],
    )
    title = (
        f"{TITLES[name]}; draws: {provenance['draws']}; trainings of each learned sampler: {provenance['seeds']}, "
        f"{provenance['budget']}"
    )
    caption = compose_caption(title, _counted(table.frame, provenance["seed"]), provenance["config"])
    write_table(table.frame, stem, caption, table.footnotes)


def _counted(frame: pd.DataFrame, seed: int) -> pd.DataFrame:
    """Return what a caption counts: samplers, however they choose and are judged, with the seed of the run."""
    rows = frame[~frame["metric"].isin(NOT_SHAPES)]
    return rows.assign(method=rows["method"].str.split(", ").str[0], seeds=seed)
