"""Clouds and meshes as NumPy arrays: NPY, NPZ."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_numbers, as_whole_numbers, assemble_shape
from morphoskel.formats.stored_arrays import parse_npy_array, parse_npz_arrays
from morphoskel.formats.text import cloud_of_columns
from morphoskel.shapes import Mesh, PointCloud


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
    table = as_numbers(parse_npy_array(content), "the array")
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
    arrays = parse_npz_arrays(content)
    if "points" in arrays:
        return assemble_shape(arrays["points"], normals=arrays.get("normals"), labels=arrays.get("labels"))
    if "vertices" not in arrays or "triangles" not in arrays:
        have = ", ".join(arrays) or "nothing"
        raise InputError(f"expected arrays 'points' or 'vertices' and 'triangles', the file holds {have}")
    corners = as_whole_numbers(arrays["triangles"], "triangles")
    if corners.ndim != 2 or corners.shape[1] != 3:
        raise InputError(f"triangles: expected shape (T, 3), got {corners.shape}")
    return assemble_shape(arrays["vertices"], Polygons(np.full(len(corners), 3), corners.reshape(-1)))
