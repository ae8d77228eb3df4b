"""Arrays in NPY and NPZ files, read without trust in what their headers declare."""

from __future__ import annotations

import io
import math
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError

Arrays = dict[str, npt.NDArray[Any]]

Layout = Mapping[str, tuple[str, str]]
"""Kind of each array's type, as in ``dtype.kind``, and a letter or digit for each of its axes."""


def parse_npy_array(content: bytes) -> npt.NDArray[Any]:
    """Return the array in an NPY file; pickled objects, which could run code, are refused.

    NumPy's own reader makes room for what the header declares before it looks for the data.

    Raises
    ------
    InputError
        If it is no NPY file, or declares more than it holds.
    """
    stream = io.BytesIO(content)
    try:
        version = np.lib.format.read_magic(stream)
        # Version 3 differs from 2 in the encoding of the fields' names, which no array of ours has.
        read_header = np.lib.format.read_array_header_1_0 if version[0] == 1 else np.lib.format.read_array_header_2_0
        declared, fortran_order, dtype = read_header(stream)
        shape = tuple(map(int, declared))  # NumPy lets True pass for 1 here, and stumbles over it later
    except Exception as error:  # whatever NumPy meets in a damaged header
        raise InputError(f"expected an NPY file ({_brief(error)}); fetch or save it again") from error
    if dtype.hasobject or dtype.itemsize == 0:
        raise InputError(f"expected numbers or text, found values of the type {dtype}; save the array anew")
    need, have = math.prod(shape) * dtype.itemsize, len(content) - stream.tell()
    if min(shape, default=0) < 0 or need > have or len(shape) > 32:
        raise InputError(
            f"the header declares an array of shape {shape}, {need} bytes, but {have} bytes follow; "
            "the file is truncated or damaged, fetch or save it again"
        )
    order: Literal["C", "F"] = "F" if fortran_order else "C"
    try:
        array: npt.NDArray[Any] = np.ndarray(shape, dtype, content, stream.tell(), order=order)
    except ValueError as error:  # an array without elements, but with more rows than can be counted
        raise InputError(f"the header declares an array of shape {shape} ({error}); fetch or save it again") from error
    return array.copy(order="K")


def parse_npz_arrays(content: bytes) -> Arrays:
    """Return the arrays in an NPZ file by their names.

    Raises
    ------
    InputError
        If it is no NPZ file, or one of its members is no array, see :func:`parse_npy_array`.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = {name.removesuffix(".npy"): archive.read(name) for name in archive.namelist()}
    except Exception as error:  # whatever zipfile and its decompressors meet in damaged data
        raise InputError(
            f"expected an NPZ file with arrays of numbers ({_brief(error)}); fetch or save it again"
        ) from error
    arrays: Arrays = {}
    for name, data in members.items():
        try:
            arrays[name] = parse_npy_array(data)
        except InputError as error:
            raise InputError(f"expected an NPZ file with arrays of numbers ({name}: {error})") from error
    return arrays


def read_arrays(path: Path, layout: Layout | None = None, what: str | None = None) -> Arrays:
    """Read the arrays of an NPZ file, and see that they are what is expected.

    Parameters
    ----------
    path
        The file.
    layout
        What must be in it; for example ``{"points": ("f", "SN3"), "labels": ("i", "S")}`` is a float array of S times N
        times 3 values and an integer array of as many values as the first has rows. Other arrays are left as they are.
    what
        Names what the file is expected to be, in errors, if it is one that we make.

    Raises
    ------
    InputError
        If the file is missing or damaged, or an array is missing, of another type or of another shape.
    """
    try:
        arrays = parse_npz_arrays(path.read_bytes())
        _check(arrays, layout or {})
    except (OSError, InputError) as error:
        reason = f"cannot be read ({error.strerror}); check the path" if isinstance(error, OSError) else str(error)
        message = reason if what is None else f"expected {what} ({reason}); make it again"
        raise InputError(f"{path}: {message}") from error
    return arrays


def _check(arrays: Arrays, layout: Layout) -> None:
    sizes: dict[str, int] = {str(digit): digit for digit in range(10)}
    for name, (kind, axes) in layout.items():
        if name not in arrays:
            raise InputError(f"the array {name!r} is missing; it holds {', '.join(arrays) or 'nothing'}")
        array = arrays[name]
        fits = array.ndim == len(axes) and all(
            sizes.setdefault(axis, size) == size for axis, size in zip(axes, array.shape, strict=True)
        )
        if array.dtype.kind != kind or not fits:
            shape = ", ".join(str(sizes.get(axis, axis)) for axis in axes)
            raise InputError(
                f"{name}: expected shape ({shape}) and a type of kind {kind!r}, got {array.shape} and {array.dtype}"
            )


def _brief(error: Exception) -> str:
    """Return the first line of a message; NumPy repeats whole headers in its own."""
    return str(error).partition("\n")[0][:200] or type(error).__name__
