"""Write a skeleton, and if wanted the surface around it, in the format that a file's suffix names."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.shapes import Mesh, Skeleton

EXPORT_SUFFIXES = (".ply", ".obj", ".glb", ".npz")
"""Suffixes of the files that can be written; upper case is fine, too."""


def export_skeleton(
    path: Path, skeleton: Skeleton, surface: Mesh | None = None, *, subdivisions: int | None = None
) -> None:
    """Write a skeleton, and if wanted the surface around it.

    Parameters
    ----------
    path
        ``.glb``, ``.obj``, ``.ply``: the balls as meshes coloured by radius, the sheets and curves between them, and
        the surface, see :func:`~morphoskel.exporting.coloured_parts.coloured_parts`. ``.npz``: the arrays ``points``,
        ``radii``, ``residues``, ``edges``, ``triangles``, ``surface_vertices`` and ``surface_triangles``, as far as
        there are any, exactly as they are; :func:`~morphoskel.formats.skeleton_file.read_skeleton` reads them back.
    skeleton, surface
        What is written.
    subdivisions
        Of the balls' meshes; by default as many as keep the file small. An NPZ file has none.

    Raises
    ------
    InputError
        If the suffix is unknown, or there is nothing that the format can show.
    """
    suffix = check_export_suffix(path)
    if suffix == ".npz":
        _write_npz(path, skeleton, surface)
        return
    from morphoskel.exporting.coloured_obj import write_coloured_obj
    from morphoskel.exporting.coloured_parts import coloured_parts
    from morphoskel.exporting.coloured_ply import write_coloured_ply
    from morphoskel.exporting.glb import write_glb

    writers = {".ply": write_coloured_ply, ".obj": write_coloured_obj, ".glb": write_glb}
    writers[suffix](path, coloured_parts(skeleton, surface, subdivisions=subdivisions))


def check_export_suffix(path: Path) -> str:
    """Return the suffix in lower case, or raise :class:`InputError` if no format has it."""
    suffix = path.suffix.lower()
    if suffix not in EXPORT_SUFFIXES:
        raise InputError(f"{path}: cannot write {suffix or 'a file without suffix'}; expected one of "
                         f"{', '.join(EXPORT_SUFFIXES)}, rename the output")  # fmt: skip
    return suffix


def _write_npz(path: Path, skeleton: Skeleton, surface: Mesh | None) -> None:
    arrays: dict[str, Any] = {"points": skeleton.points, "radii": skeleton.radii}
    optional: dict[str, Any] = {name: getattr(skeleton, name) for name in ("residues", "edges", "triangles")}
    if surface is not None:
        optional |= {"surface_vertices": surface.vertices, "surface_triangles": surface.triangles}
    arrays |= {name: array for name, array in optional.items() if array is not None and len(array)}
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez(stream, **arrays)
