"""Write the table of part segmentation from the per-shape results of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from morphoskel.reporting.result_rows import read_result_rows
from morphoskel.reporting.segmentation_names import split_row
from morphoskel.reporting.segmentation_rows import SEGMENTATION_COLUMNS
from morphoskel.reporting.segmentation_table import build_segmentation_table
from morphoskel.reporting.table import compose_caption, write_table

TITLE = "Part segmentation by a network that is shown few labels, by the sampler that chooses the labelled points"


def write_segmentation_table(
    rows: Sequence[Path], published_folder: Path, stem: Path, provenance: Mapping[str, Any]
) -> None:
    """Write the table as CSV, Markdown and LaTeX.

    Parameters
    ----------
    rows
        CSV files of per-shape results, one a strategy, with the columns
        :data:`morphoskel.reporting.segmentation_rows.SEGMENTATION_COLUMNS`. Without any file the table says what was
        not run.
    published_folder
        The folder ``config/paper``.
    stem
        Path of the files without the suffix.
    provenance
        For the caption: ``dataset``, ``seed`` (of the experiment), ``seeds`` (number of trainings of each row),
        ``budget`` (text, how long a training is), ``protocol`` and ``config`` (hash). For the footnotes: ``decisions``
        (sentences, how what the paper leaves open was decided) and ``transferred_from`` (the data set that learned
        samplers were trained on).

    Raises
    ------
    InputError
        If a file cannot be read, or the rows are not what they should be.
    """
    table = build_segmentation_table(
        read_result_rows(rows, SEGMENTATION_COLUMNS),
        published_folder,
        dataset=provenance["dataset"],
        protocol=provenance["protocol"],
        decisions=provenance["decisions"],
        transferred_from=provenance["transferred_from"],
    )
    title = f"{TITLE}; trainings of each row: {provenance['seeds']}, {provenance['budget']}"
    means = table.frame[table.frame["metric"] == "miou"]
    counted = means.assign(method=[split_row(row)[0] for row in means["method"]], seeds=provenance["seed"])
    write_table(table.frame, stem, compose_caption(title, counted, provenance["config"]), table.footnotes)
