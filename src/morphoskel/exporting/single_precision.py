"""Coordinates as the 32-bit numbers that graphics formats hold."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray


def as_float32(values: FloatArray, path: Path) -> npt.NDArray[np.float32]:
    """Return `values` rounded to little-endian float32.

    Raises
    ------
    InputError
        If one is too large; the message names the file `path`, for which they are meant.
    """
    with np.errstate(over="ignore", under="ignore"):
        narrow = values.astype("<f4")
    if not np.isfinite(narrow).all():
        raise InputError(f"{path}: coordinates beyond the range of float32 (3e38) cannot be written; rescale the shape")
    return narrow
