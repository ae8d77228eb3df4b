"""Meshes in the STL format, ASCII or binary."""

from __future__ import annotations

import struct

import numpy as np

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_numbers, assemble_shape
from morphoskel.formats.lines import parse_table, significant_lines
from morphoskel.shapes import FloatArray, Mesh, PointCloud

_HEADER_SIZE = 84
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def parse_stl(content: bytes) -> PointCloud | Mesh:
    """Parse an STL file; corners at exactly the same place become one vertex.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If the file does not hold as many facets as it declares, or none.
    """
    corners = _parse_ascii(content) if _is_ascii(content) else _parse_binary(content)
    if not len(corners):
        raise InputError("expected an STL file with facets, found none")
    vertices, indices = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return assemble_shape(vertices, Polygons(np.full(len(corners), 3), indices.reshape(-1).astype(np.int64)))


def _is_ascii(content: bytes) -> bool:
    """Tell the two kinds apart: headers of binary files may start with "solid", too, but these hold zero bytes."""
    return content.lstrip().startswith(b"solid") and b"\0" not in content


def _parse_binary(content: bytes) -> FloatArray:
    """Return the corners, ``(facets, 3, 3)``."""
    if len(content) < _HEADER_SIZE:
        raise InputError(
            f"a binary STL file has at least {_HEADER_SIZE} bytes, this one {len(content)}; fetch it again"
        )
    (declared,) = struct.unpack_from("<I", content, _HEADER_SIZE - 4)
    need = _HEADER_SIZE + declared * _FACET.itemsize
    if len(content) != need:
        state = "truncated" if len(content) < need else "damaged"
        raise InputError(
            f"the header declares {declared} facets, {need} bytes, but the file has {len(content)}; "
            f"it is {state} or no STL file, fetch it again"
        )
    return as_numbers(np.frombuffer(content, _FACET, declared, _HEADER_SIZE)["corners"], "corners")


def _parse_ascii(content: bytes) -> FloatArray:
    """Return the corners, ``(facets, 3, 3)``."""
    lines = significant_lines(content, comments=())
    if not lines[-1].text.startswith("endsolid"):
        raise InputError("the last line is not 'endsolid'; the file is truncated, fetch it again")
    facets = sum(line.text.startswith("facet") for line in lines)
    corners = [line._replace(text=line.text[6:]) for line in lines if line.text.startswith("vertex")]
    if len(corners) != 3 * facets:
        raise InputError(f"{facets} facets need {3 * facets} vertex lines, but the file has {len(corners)}")
    return parse_table(corners, 3).reshape(-1, 3, 3)
