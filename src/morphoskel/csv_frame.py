"""Write a data frame as CSV, whatever text it holds, and read one, with errors that name the file."""

from __future__ import annotations

import io
import warnings
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.checksums import intact
from morphoskel.csv_lines import QUOTED_ENDS, LineFeeds
from morphoskel.errors import InputError

if TYPE_CHECKING:
    import pandas as pd


def write_csv_frame(frame: pd.DataFrame, path: Path) -> None:
    """Write a frame without its index: UTF-8, line feeds, and text quoted wherever a reader would misread it."""
    path.write_text(csv_text(frame), encoding="utf-8", newline="")


def csv_text(frame: pd.DataFrame) -> str:
    """Return what :func:`write_csv_frame` writes."""
    stream = io.StringIO(newline="")
    lines: Any = LineFeeds(stream)  # pandas asks for more than it uses
    frame.to_csv(lines, index=False, lineterminator=QUOTED_ENDS)
    return stream.getvalue()


def read_csv_frame(path: Path, columns: Collection[str], *, exactly: bool = False, **options: Any) -> pd.DataFrame:
    """Read a CSV file with a header.

    Parameters
    ----------
    path
        The file.
    columns
        Those that it must have.
    exactly
        It must have no others, and these in this order.
    options
        Further arguments of :func:`pandas.read_csv`.

    Raises
    ------
    InputError
        If the file is missing or no such table, or a value is not of the type asked for.
    StorageError
        If a checksum lies beside it, and the file is not what was written.
    """
    import pandas as pd

    expected = f"expected a table with the columns {', '.join(columns)}"
    if not path.is_file():
        raise InputError(f"{path}: no such file; {expected}")
    intact(path)
    try:
        with warnings.catch_warnings():
            # Of a row with more fields than the header, pandas drops the last ones and warns.
            warnings.simplefilter("error", pd.errors.ParserWarning)
            # An infinite number in a column of whole ones would become an arbitrary one.
            warnings.simplefilter("error", RuntimeWarning)
            frame: pd.DataFrame = pd.read_csv(path, index_col=False, **options)
    except (
        OSError,
        UnicodeDecodeError,
        pd.errors.ParserError,
        pd.errors.EmptyDataError,
        pd.errors.ParserWarning,
    ) as error:
        raise InputError(f"{path}: cannot be read as a table ({error}); {expected}") from error
    except (ValueError, OverflowError, RuntimeWarning) as error:
        raise InputError(f"{path}: a value is not a number: {error}") from error
    if exactly and tuple(frame.columns) != tuple(columns):
        raise InputError(f"{path}: expected the columns {', '.join(columns)}, got {', '.join(map(str, frame.columns))}")
    missing = [name for name in columns if name not in frame.columns]
    if missing:
        raise InputError(f"{path}: the columns {', '.join(missing)} are missing; {expected}")
    return frame
