"""Clouds and meshes as NumPy arrays: NPY, NPZ."""

from __future__ import annotations

import io
import zipfile
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_whole_numbers, assemble_shape
from morphoskel.formats.text import cloud_of_columns
from morphoskel.shapes import Mesh, PointCloud

_DAMAGE = (ValueError, TypeError, EOFError, OSError, RuntimeError, MemoryError, zipfile.BadZipFile, zlib.error)
"""What NumPy and zipfile raise on files that are damaged or hold no numbers."""


def parse_npy(content: bytes) -> PointCloud | Mesh:
    """Parse an NPY file with one array ``(N, 3)``, ``(N, 4)``, ``(N, 6)`` or ``(N, 7)``, columns as in text files.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If it is no NPY file, or the array has another shape.
    """
    try:
        array = np.lib.format.read_array(io.BytesIO(content), allow_pickle=False)
        table = np.asarray(array, dtype=np.float64)
    except _DAMAGE as error:
        raise InputError(f"expected an NPY file with numbers ({error}); fetch or save it again") from error
    if table.ndim != 2:
        raise InputError(f"expected an array of shape (N, 3) or (N, 6), got {table.shape}")
    return cloud_of_columns(table)


def parse_npz(content: bytes) -> PointCloud | Mesh:
    """Parse an NPZ file with ``points`` and optionally ``normals``, ``labels``, or with ``vertices``, ``triangles``.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If it is no NPZ file, or lacks these arrays.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            arrays = {name.removesuffix(".npy"): _read_member(archive, name) for name in archive.namelist()}
    except _DAMAGE as error:
        raise InputError(f"expected an NPZ file with arrays of numbers ({error}); fetch or save it again") from error
    if "points" in arrays:
        return assemble_shape(arrays["points"], normals=arrays.get("normals"), labels=arrays.get("labels"))
    if "vertices" not in arrays or "triangles" not in arrays:
        have = ", ".join(arrays) or "nothing"
        raise InputError(f"expected arrays 'points' or 'vertices' and 'triangles', the file holds {have}")
    corners = as_whole_numbers(arrays["triangles"], "triangles")
    if corners.ndim != 2 or corners.shape[1] != 3:
        raise InputError(f"triangles: expected shape (T, 3), got {corners.shape}")
    return assemble_shape(arrays["vertices"], Polygons(np.full(len(corners), 3), corners.reshape(-1)))


def _read_member(archive: zipfile.ZipFile, name: str) -> npt.NDArray[Any]:
    """Return one array of an NPZ file; pickled objects, which could run code, are refused."""
    with archive.open(name) as stream:
        array: npt.NDArray[Any] = np.lib.format.read_array(stream, allow_pickle=False)
    return array
