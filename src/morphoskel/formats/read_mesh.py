"""Read a file that must hold a triangle mesh."""

from pathlib import Path

from morphoskel.errors import InputError
from morphoskel.formats.read import read_shape
from morphoskel.shapes import Mesh


def read_mesh(path: Path) -> Mesh:
    """Return the mesh in a file of any supported format.

    Raises
    ------
    InputError
        If the file is broken, or holds points without triangles.
    """
    shape = read_shape(path)
    if not isinstance(shape, Mesh):
        raise InputError(f"{path}: expected a mesh with triangles, found {shape!r}")
    return shape
