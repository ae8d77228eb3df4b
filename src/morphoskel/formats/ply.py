"""PLY files: ASCII or binary, either byte order, any elements and properties.

Source of the format: G. Turk, *The PLY Polygon File Format*, 1994.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_numbers, as_whole_numbers, assemble_shape
from morphoskel.formats.lines import Line, parse_count, shorten, significant_lines
from morphoskel.formats.ply_body import Column, Element, Property, RaggedList, parse_ascii, parse_binary
from morphoskel.shapes import Mesh, PointCloud

_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
}
_BYTE_ORDER = {"binary_little_endian": "<", "binary_big_endian": ">"}


def parse_ply(content: bytes) -> PointCloud | Mesh:
    """Parse a PLY file: a mesh if it has faces, else a cloud.

    Of a cloud, the properties ``nx ny nz`` become normals and ``label`` becomes labels; all others are ignored.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If the file is no PLY, holds less or more than its header declares, or has no vertices.
    """
    elements = parse_ply_elements(content)
    vertex = elements.get("vertex", {})
    vertices = stack_properties(vertex, ("x", "y", "z"))
    face = elements.get("face", {})
    indices = face.get("vertex_indices", face.get("vertex_index"))
    polygons = None
    if isinstance(indices, RaggedList):
        polygons = Polygons(indices.counts, as_whole_numbers(indices.values, "vertex_indices"))
    elif "tristrips" in elements or any(map(len_of_column, face.values())):
        raise InputError("its faces are not lists named vertex_indices; export the mesh again as plain triangles")
    normals = stack_properties(vertex, ("nx", "ny", "nz")) if "nx" in vertex else None
    label = vertex.get("label")
    return assemble_shape(vertices, polygons, normals=normals, labels=None if isinstance(label, RaggedList) else label)


def parse_ply_elements(content: bytes) -> dict[str, dict[str, Column]]:
    """Return the columns of every element.

    Parameters
    ----------
    content
        The whole file.

    Returns
    -------
    dict
        From the element's name to its properties, each an array with one value a row, or a :class:`RaggedList`.

    Raises
    ------
    InputError
        If the header is not legal, or the body does not match it.
    """
    if not content.startswith(b"ply"):
        raise InputError("expected a PLY file, whose first line is 'ply'")
    end = re.search(rb"^end_header[ \t]*(\r\n|\n|\Z)", content, re.MULTILINE)
    if end is None:
        raise InputError("the PLY header has no line 'end_header'; the file is truncated, fetch it again")
    kind, elements = _parse_header(significant_lines(content[: end.start()], comments=()))
    body = content[end.end() :]
    if kind == "ascii":
        first_number = content.count(b"\n", 0, end.end()) + 1
        return parse_ascii(elements, significant_lines(body, comments=(), first_number=first_number))
    return parse_binary(elements, body, _BYTE_ORDER[kind])


def stack_properties(element: Mapping[str, Column], names: tuple[str, ...]) -> npt.NDArray[np.float64]:
    """Return the scalar properties `names` of an element as the columns of a float64 array.

    Raises
    ------
    InputError
        If one of them is missing.
    """
    columns = [element.get(name) for name in names]
    if any(column is None or isinstance(column, RaggedList) for column in columns):
        have = ", ".join(element) or "none"
        raise InputError(f"expected the vertex properties {', '.join(names)}; the file has {have}")
    return np.stack([as_numbers(np.asarray(column), ", ".join(names)) for column in columns], axis=1)


def len_of_column(column: Column) -> int:
    """Return the number of rows."""
    return len(column.counts) if isinstance(column, RaggedList) else len(column)


def _parse_header(lines: list[Line]) -> tuple[str, list[Element]]:
    """Return the kind of the body and the declared elements."""
    kind = ""
    elements: list[Element] = []
    for line in lines[1:]:
        match line.text.split():
            case ["comment" | "obj_info", *_]:
                continue
            case ["format", ("ascii" | "binary_little_endian" | "binary_big_endian") as kind, "1.0"]:
                continue
            case ["element", name, count]:
                elements.append(Element(name, parse_count(line, count, name)))
            case ["property", "list", count_type, item_type, name] if elements and {count_type, item_type} <= {*_TYPES}:
                elements[-1].properties.append(Property(name, _TYPES[item_type], _TYPES[count_type]))
            case ["property", item_type, name] if elements and item_type in _TYPES:
                elements[-1].properties.append(Property(name, _TYPES[item_type]))
            case _:
                raise InputError(f"line {line.number}: not a legal line of a PLY header: {shorten(line.text)}")
    for names in ([element.name for element in elements], *([p.name for p in e.properties] for e in elements)):
        if len({*names}) < len(names):
            raise InputError(f"the PLY header declares a name twice among {', '.join(names)}")
    if not kind:
        raise InputError("the PLY header has no line 'format ascii|binary_little_endian|binary_big_endian 1.0'")
    return kind, elements
