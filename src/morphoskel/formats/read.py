"""Read a shape from a file of any supported format."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from morphoskel.errors import InputError
from morphoskel.formats.numpy_arrays import parse_npy, parse_npz
from morphoskel.formats.obj import parse_obj
from morphoskel.formats.off import parse_off
from morphoskel.formats.pcd import parse_pcd
from morphoskel.formats.ply import parse_ply
from morphoskel.formats.sample import sample_surface
from morphoskel.formats.stl import parse_stl
from morphoskel.formats.text import parse_text
from morphoskel.shapes import Mesh, PointCloud

_PARSERS: dict[str, Callable[[bytes], PointCloud | Mesh]] = {
    ".ply": parse_ply,
    ".pcd": parse_pcd,
    ".obj": parse_obj,
    ".off": parse_off,
    ".stl": parse_stl,
    ".xyz": parse_text,
    ".txt": parse_text,
    ".pts": parse_text,
    ".csv": parse_text,
    ".npy": parse_npy,
    ".npz": parse_npz,
}

SUPPORTED_SUFFIXES = tuple(_PARSERS)
"""Suffixes of the files that can be read; upper case is fine, too."""


def read_shape(path: Path | str) -> PointCloud | Mesh:
    """Read a file: a :class:`Mesh` if it holds faces, else a :class:`PointCloud`.

    Parameters
    ----------
    path
        A file with one of the :data:`SUPPORTED_SUFFIXES`.

    Returns
    -------
    PointCloud or Mesh
        In the units of the file. Normals are scaled to unit length, zero rows stay; a mesh has neither normals nor
        labels. Polygons are cut into fans of triangles.

    Raises
    ------
    InputError
        If the file is missing, empty, truncated, of an unknown format, holds NaN or infinite values, or fewer than
        four distinct points. The message names the file, what was expected and how to mend it.
    """
    path = Path(path)
    parse = _PARSERS.get(path.suffix.lower())
    if parse is None:
        raise InputError(
            f"{path}: unknown format {path.suffix!r}; expected one of {', '.join(SUPPORTED_SUFFIXES)}, convert the file"
        )
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from error
    if not content.strip():
        raise InputError(f"{path}: the file is empty; expected a {path.suffix[1:].upper()} file, fetch it again")
    try:
        return parse(content)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def read_point_cloud(path: Path | str) -> PointCloud:
    """Read a file that must hold a point cloud.

    Raises
    ------
    InputError
        As :func:`read_shape`, and if the file holds a mesh.
    """
    shape = read_shape(path)
    if isinstance(shape, Mesh):
        raise InputError(f"{path}: expected a point cloud, found a mesh of {len(shape.triangles)} triangles")
    return shape


def read_cloud(path: Path | str, *, samples: int, generator: np.random.Generator) -> PointCloud:
    """Read a file as a point cloud; a mesh is sampled uniformly by area.

    Parameters
    ----------
    path
        As for :func:`read_shape`.
    samples
        Number of points drawn from a mesh; a file that holds a cloud is returned whole.
    generator
        Source of randomness; not touched for a cloud.

    Returns
    -------
    PointCloud
        With the normals of the triangles if it stems from a mesh.

    Raises
    ------
    InputError
        As :func:`read_shape`, and if the mesh has no area.
    """
    shape = read_shape(path)
    if isinstance(shape, PointCloud):
        return shape
    try:
        return sample_surface(shape, samples, generator)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
