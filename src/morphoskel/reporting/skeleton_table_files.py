"""Write the skeleton tables from the per-shape results of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from morphoskel.checksums import intact
from morphoskel.errors import InputError
from morphoskel.reporting.skeleton_tables import skeleton_reconstruction, surface_reconstruction
from morphoskel.reporting.table import compose_caption, write_table
from morphoskel.reporting.time_table import processing_time

TITLES = {
    "skeleton_reconstruction": "Distance between the surface and the balls of each skeleton method",
    "surface_reconstruction": "Distance between the surface and the balls of MS3D, by surface reconstruction",
    "processing_time": "Seconds a shape, by stage",
}


def write_skeleton_table(
    name: str, rows: Sequence[Path], published_folder: Path, stem: Path, provenance: Mapping[str, Any]
) -> None:
    """Write one of the tables in :data:`TITLES` as CSV, Markdown and LaTeX.

    Parameters
    ----------
    name
        Name of the table.
    rows
        CSV files of per-shape results, one a surface.
    published_folder
        The folder ``config/paper``.
    stem
        Path of the files without the suffix.
    provenance
        ``dataset``, ``seed``, ``protocol``, ``candidates`` (text), ``medial_axis`` (``given`` or ``computed``) and
        ``config`` (hash), for the caption.

    Raises
    ------
    InputError
        If there is no such table or the rows are not what they should be.
    """
    import pandas as pd

    if name not in TITLES:
        raise InputError(f"no such table {name!r}; legal are {', '.join(TITLES)}")
    frame = pd.concat([pd.read_csv(intact(path), keep_default_na=True) for path in rows], ignore_index=True)
    common: dict[str, Any] = {"dataset": provenance["dataset"], "seeds": [provenance["seed"]]}
    title = f"{TITLES[name]} ({provenance['candidates']} candidates)"
    if name == "processing_time":
        table = processing_time(frame, published_folder, **common)
        threads = ", ".join(map(str, sorted(frame["threads"].unique())))
        title = f"{title}; {threads} threads after the watertight conversion, 1 before"
    else:
        build = skeleton_reconstruction if name == "skeleton_reconstruction" else surface_reconstruction
        table = build(
            frame, published_folder, **common, protocol=provenance["protocol"], axis=provenance["medial_axis"]
        )
    caption = compose_caption(title, table.frame, provenance["config"])
    write_table(table.frame, stem, caption, table.footnotes)
