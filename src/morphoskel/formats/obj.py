"""Meshes and clouds in the Wavefront OBJ format."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, assemble_shape
from morphoskel.formats.lines import Line, parse_numbers, shorten, significant_lines
from morphoskel.shapes import Mesh, PointCloud

_IGNORED = {"vt", "vp", "g", "o", "s", "l", "p", "mtllib", "usemtl", "mg", "lod"}
"""Keywords of lines that say nothing about the surface."""

_LARGEST_INDEX = 2**62
"""Fits into 64 bits, also when counted back from."""


def parse_obj(content: bytes) -> PointCloud | Mesh:
    """Parse an OBJ file: a mesh if it has faces, else a cloud.

    Normals (``vn``) are kept for a cloud that has one for each vertex, in the same order. Colours, textures,
    materials, groups, lines and single points are ignored.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If a line is damaged or of a kind that describes curved surfaces, or a face refers to a vertex that is not
        in the file. The format declares no counts, so a file cut off between two lines after the vertices of all its
        faces cannot be told from a whole one.
    """
    # A backslash continues a line; the joined line keeps the number of its last part.
    lines = significant_lines(content.replace(b"\\\r\n", b" ").replace(b"\\\n", b" "))
    vertices: list[list[float]] = []
    normals: list[list[float]] = []
    counts: list[int] = []
    corners: list[int] = []
    for line in lines:
        keyword, *fields = line.text.split()
        if keyword == "v":
            vertices.append(_three_numbers(line, fields))
        elif keyword == "vn":
            normals.append(_three_numbers(line, fields))
        elif keyword == "f":
            counts.append(len(fields))
            corners.extend(_corner(line, field, len(vertices)) for field in fields)
        elif keyword not in _IGNORED:
            raise InputError(f"line {line.number}: expected OBJ vertices and faces, got {shorten(line.text)}")
    if not vertices:
        raise InputError("expected an OBJ file with vertices (lines 'v x y z'), found none")
    polygons = Polygons(np.array(counts, dtype=np.int64), np.array(corners, dtype=np.int64))
    return assemble_shape(vertices, polygons, normals=normals if len(normals) == len(vertices) else None)


def _three_numbers(line: Line, fields: list[str]) -> list[float]:
    """Return the first three numbers; a weight or a colour may follow."""
    if len(fields) < 3:
        raise InputError(f"line {line.number}: expected three numbers, got {shorten(line.text)}")
    return parse_numbers(line, fields)[:3]


def _corner(line: Line, field: str, known: int) -> int:
    """Return the vertex index, counted from 0, of one corner ``v``, ``v/vt``, ``v//vn`` or ``v/vt/vn``."""
    try:
        index = int(field.split("/")[0])
    except ValueError as error:
        raise InputError(f"line {line.number}: expected vertex numbers, got {shorten(line.text)}") from error
    if abs(index) > _LARGEST_INDEX:
        raise InputError(f"line {line.number}: vertex number {shorten(field)} does not exist; the file is damaged")
    # Negative numbers count back from the vertex read last.
    zero_based = index - 1 if index > 0 else known + index
    if index == 0 or zero_based < 0:
        raise InputError(f"line {line.number}: vertex number {index} does not exist; numbers start at 1")
    return zero_based
