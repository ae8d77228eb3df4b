"""Results by shape or by draw as a run writes them, one CSV file a sampler."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.csv_frame import read_csv_frame

if TYPE_CHECKING:
    import pandas as pd

TEXT = ("sampler", "strategy", "ratio", "choice", "classifier", "id", "category", "status", "reason")
"""Columns that are read as they stand: a category may be called nan, and a ratio is a name here."""

WHOLE = ("seed", "draw")
"""Columns of whole numbers; all others hold floating-point numbers, NaN where a cell is empty."""


def read_result_rows(paths: Sequence[Path], columns: Sequence[str]) -> pd.DataFrame:
    """Read CSV files of the same columns one below the other.

    Parameters
    ----------
    paths
        The files; without any there are no rows.
    columns
        Those to read; others in the files are left aside.

    Raises
    ------
    InputError
        If a file or one of its columns is missing, or a value is not a number where one is expected.
    """
    import pandas as pd

    types: dict[str, Any] = {name: str if name in TEXT else int if name in WHOLE else float for name in columns}
    frames = [pd.DataFrame({name: pd.Series(dtype=kind) for name, kind in types.items()})]
    empty = {name: ["", "nan"] for name, kind in types.items() if kind is float}
    for path in paths:
        frame = read_csv_frame(path, columns, dtype=types, keep_default_na=False, na_values=empty)
        frames.append(frame[list(columns)])
    return pd.concat(frames[1:] or frames, ignore_index=True)
