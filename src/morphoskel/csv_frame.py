"""Read a CSV file as a data frame, with errors that name the file."""

from __future__ import annotations

import warnings
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.checksums import intact
from morphoskel.errors import InputError

if TYPE_CHECKING:
    import pandas as pd


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
