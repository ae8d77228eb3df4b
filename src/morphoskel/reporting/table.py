"""The tidy result table: what was measured joined with what the paper prints, and the files made of it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.atomic import atomic_file
from morphoskel.csv_frame import csv_text, read_csv_frame
from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES
from morphoskel.evaluation.protocol import EvaluationProtocol, check_protocol
from morphoskel.reporting.latex import render_latex
from morphoskel.reporting.markdown import render_markdown
from morphoskel.reporting.matrix import FAILED, NOT_RUN, metric_matrices
from morphoskel.reporting.metrics import METRICS, find_metric

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = (
    *("dataset", "method", "group", "metric", "value", "std", "paper"),
    *("n", "n_failed", "seeds", "protocol"),
)
"""Columns of a result table: one row a combination of method, group and metric."""

MEASURED_COLUMNS = ("method", "group", "metric", "value", "std", "n", "n_failed")
"""Columns of the measured rows that :func:`assemble` joins with the published ones."""

KEY = ["method", "group", "metric"]


@dataclass(frozen=True, eq=False)
class ResultTable:
    """A result table and what its reader must know.

    Parameters
    ----------
    frame
        The columns :data:`COLUMNS`; a cell that was not computed has a NaN `value` and n = n failed = 0.
    footnotes
        Sentences.
    """

    frame: pd.DataFrame
    footnotes: tuple[str, ...]


def assemble(
    measured: pd.DataFrame,
    published: pd.DataFrame,
    *,
    dataset: str,
    seeds: Sequence[int],
    protocol: EvaluationProtocol,
) -> pd.DataFrame:
    """Join measured with published values, so that every printed and every computed cell appears.

    Parameters
    ----------
    measured
        The columns :data:`MEASURED_COLUMNS`, in the units of the metrics; may have no row.
    published
        At least the columns ``method, group, metric, value``; a NaN value keeps the cell, but shows no number of the
        paper. May have no row.
    dataset, seeds, protocol
        How the measured values came to be; written to every row.

    Returns
    -------
    pandas.DataFrame
        The columns :data:`COLUMNS`. Metrics are in the order of the registry; methods and groups in order of
        appearance, published before measured, with the averages as the last groups. `value` and `paper` are NaN
        where there is none.

    Raises
    ------
    InputError
        If columns are missing, a metric is unknown, or a cell appears twice.
    """
    import pandas as pd

    check_protocol(protocol)
    _check_cells(measured, MEASURED_COLUMNS, "measured rows")
    _check_cells(published, (*KEY, "value"), "published rows")
    left = measured[list(MEASURED_COLUMNS)].astype({"value": float, "std": float})
    right = published[[*KEY, "value"]].rename(columns={"value": "paper"}).astype({"paper": float})
    frame = left.merge(right, how="outer", on=KEY, validate="one_to_one")
    counts = {name: frame[name].fillna(0).astype("int64") for name in ("n", "n_failed")}
    frame = frame.assign(dataset=dataset, seeds=" ".join(str(seed) for seed in seeds), protocol=protocol, **counts)
    keys = pd.concat([right[KEY], left[KEY]])
    groups = list(dict.fromkeys(keys["group"]))
    order = {
        "metric": list(METRICS),
        "method": list(dict.fromkeys(keys["method"])),
        "group": [group for group in groups if group not in AVERAGES] + list(AVERAGES),
    }
    ranks = pd.DataFrame({name: frame[name].map(_rank(values)) for name, values in order.items()})
    sorted_rows = ranks.sort_values(["metric", "method", "group"], kind="stable").index
    return frame.loc[sorted_rows, list(COLUMNS)].reset_index(drop=True)


def compose_caption(title: str, frame: pd.DataFrame, config_hash: str) -> str:
    """Return `title` followed by data set, numbers of shapes, seeds, protocol and configuration hash.

    Parameters
    ----------
    title
        What the table shows, without a full stop.
    frame
        As returned by :func:`assemble`.
    config_hash
        Hash of the resolved configuration.
    """
    shapes: dict[tuple[int, int], list[str]] = {}
    computed = frame[(frame["n"] > 0) | (frame["n_failed"] > 0)]
    for method, rows in computed.groupby("method", sort=False):
        counts = [(int(n), int(failed)) for n, failed in zip(rows["n"], rows["n_failed"], strict=True)]
        shapes.setdefault(max(counts, key=sum), []).append(str(method))
    listed = [
        f"n = {n}, n failed = {failed}" + (f" ({', '.join(methods)})" if len(shapes) > 1 else "")
        for (n, failed), methods in shapes.items()
    ]
    facts = {
        name: ", ".join(dict.fromkeys(map(str, frame[name]))) or "none" for name in ("dataset", "seeds", "protocol")
    }
    return (
        f"{title}. Data set {facts['dataset']}; {'; '.join(listed) or 'nothing was run'}; seeds {facts['seeds']}; "
        f"protocol {facts['protocol']}; configuration {config_hash}."
    )


def write_table(frame: pd.DataFrame, stem: Path, caption: str, footnotes: Sequence[str]) -> None:
    """Write a result table as ``{stem}.csv``, ``{stem}.md`` and ``{stem}.tex``.

    The CSV file holds every column in full precision, with ``not run`` as the value of a cell that was not computed
    and ``failed`` where shapes that it needs failed. The others show paper, ours and the difference (ours - paper),
    with the best of our values in bold. Each file is written whole or not at all, and equal tables make equal bytes.

    Parameters
    ----------
    frame
        As returned by :func:`assemble`.
    stem
        Path of the files without the suffix; the folder is created if need be.
    caption, footnotes
        Plain text; special characters are escaped.

    Raises
    ------
    InputError
        If `frame` does not have the columns :data:`COLUMNS`.
    """
    if tuple(frame.columns) != COLUMNS:
        raise InputError(f"{stem}: a result table has the columns {', '.join(COLUMNS)}, got {', '.join(frame.columns)}")
    matrices = metric_matrices(frame)
    contents = {
        "csv": csv_text(_csv_frame(frame)),
        "md": render_markdown(matrices, caption, footnotes),
        "tex": render_latex(matrices, caption, footnotes),
    }
    for suffix, content in contents.items():
        with atomic_file(stem.with_name(f"{stem.name}.{suffix}")) as path:
            path.write_text(content, encoding="utf-8", newline="\n")


def read_table(path: Path) -> pd.DataFrame:
    """Read the CSV file of :func:`write_table` back; ``not run`` and ``failed`` become NaN.

    Raises
    ------
    InputError
        If the file is absent or is not such a table.
    """
    frame = read_csv_frame(path, COLUMNS, exactly=True, dtype=str, keep_default_na=False)
    try:
        numbers = {
            name: [math.nan if text in (NOT_RUN, FAILED, "") else float(text) for text in frame[name]]
            for name in ("value", "std", "paper")
        }
        return frame.assign(**numbers).astype({"n": "int64", "n_failed": "int64"})
    except (ValueError, OverflowError) as error:
        raise InputError(f"{path}: a value is not a number: {error}") from error


def _csv_frame(frame: pd.DataFrame) -> pd.DataFrame:
    """Return `frame` with words for the values that are missing."""
    computed = frame["value"].notna()
    words = (frame["n"] + frame["n_failed"] > 0).map({True: FAILED, False: NOT_RUN})
    return frame.assign(value=frame["value"].map(lambda value: repr(float(value))).where(computed, words))


def _check_cells(frame: pd.DataFrame, columns: Iterable[str], name: str) -> None:
    """Raise unless `frame` has these columns, known metrics, and no cell twice."""
    missing = [column for column in columns if column not in frame.columns]
    if missing:
        raise InputError(f"{name}: the columns {', '.join(missing)} are missing")
    for metric in frame["metric"].unique():
        find_metric(metric)
    twice = frame[frame.duplicated(KEY)]
    if len(twice):
        raise InputError(f"{name}: a second value for {', '.join(map(str, twice[KEY].iloc[0]))}; expected one a cell")


def _rank(names: Sequence[str]) -> dict[str, int]:
    """Return the position of each name."""
    return {name: position for position, name in enumerate(names)}
