"""Read a skeleton from any of the files that hold one, and tell such files from clouds and meshes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from morphoskel.errors import InputError
from morphoskel.formats.assemble import as_numbers, as_rows, as_whole_numbers
from morphoskel.formats.medial_axis_file import read_medial_axis
from morphoskel.formats.read import SUPPORTED_SUFFIXES, read_shape
from morphoskel.formats.stored_arrays import read_arrays
from morphoskel.formats.write import read_skeleton_ply
from morphoskel.shapes import Mesh, PointCloud, Skeleton

READABLE_SUFFIXES = (*SUPPORTED_SUFFIXES, ".ma")
"""Suffixes of the files that hold a shape or a skeleton."""

WHAT_HOLDS_A_SKELETON = "a PLY file with the property radius, an NPZ file with points and radii, or an MA file"

_PARTS = {"residues": as_numbers, "edges": as_whole_numbers, "triangles": as_whole_numbers}


def read_skeleton(path: Path | str) -> Skeleton:
    """Read a file that must hold a skeleton.

    Parameters
    ----------
    path
        ``.ply`` with the vertex property ``radius`` (or ``r``), ``.npz`` with ``points`` and ``radii``, both as
        `morphoskel skeletonize` writes them, or ``.ma``.

    Returns
    -------
    Skeleton
        At least one ball; with residues, edges and triangles where the file has them.

    Raises
    ------
    InputError
        If the file is missing, damaged, holds something else, or no ball.
    """
    shape = read_skeleton_or_shape(path)
    if not isinstance(shape, Skeleton):
        raise InputError(f"{path}: expected a skeleton ({WHAT_HOLDS_A_SKELETON}), found {shape!r}")
    return shape


def read_skeleton_or_shape(path: Path | str) -> Skeleton | PointCloud | Mesh:
    """Read a skeleton if the file holds radii, else a mesh if it holds faces, else a cloud.

    Parameters
    ----------
    path
        A file that :func:`read_skeleton` or :func:`~morphoskel.formats.read.read_shape` can read.

    Raises
    ------
    InputError
        If the file is missing, damaged, of an unknown format, or holds a skeleton without balls.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in READABLE_SUFFIXES:
        raise InputError(
            f"{path}: unknown format {suffix!r}; expected one of {', '.join(READABLE_SUFFIXES)}, convert the file"
        )
    skeleton: Skeleton | None = None
    if suffix == ".ply":
        skeleton = _read_ply(path)
    elif suffix == ".npz":
        skeleton = _read_npz(path)
    elif suffix == ".ma":
        skeleton = read_medial_axis(path)
    if skeleton is None:
        return read_shape(path)
    if len(skeleton) == 0:
        raise InputError(f"{path}: the skeleton has no balls; make it anew")
    return skeleton


def _read_ply(path: Path) -> Skeleton | None:
    """Return the skeleton in a PLY file, or None if its header declares no radius."""
    try:
        with path.open("rb") as stream:
            header = stream.read(1 << 16).partition(b"end_header")[0].decode("latin-1")
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from error
    declared = set(re.findall(r"^property\s+\w+\s+(\w+)\s*$", header, re.MULTILINE))
    if "radius" in declared:
        return read_skeleton_ply(path)
    if "r" in declared and not {"g", "b"} & declared:  # beside these two it is a colour
        return read_medial_axis(path)
    return None


def _read_npz(path: Path) -> Skeleton | None:
    """Return the skeleton in an NPZ file, or None if it holds no radii."""
    arrays = read_arrays(path)
    if not {"points", "radii"} <= arrays.keys():
        return None
    try:
        parts: dict[str, Any] = {name: to(arrays[name], name) for name, to in _PARTS.items() if name in arrays}
        return Skeleton(as_rows(arrays["points"], "points"), as_numbers(arrays["radii"], "radii"), **parts)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
