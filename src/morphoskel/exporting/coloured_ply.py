"""Write coloured parts as one binary PLY file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.exporting.coloured_parts import ColouredPart
from morphoskel.exporting.single_precision import as_float32

_VERTEX = np.dtype([("place", "<f4", (3,)), ("normal", "<f4", (3,)), ("colour", "u1", (4,))])
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", (3,))])


def write_coloured_ply(path: Path, parts: Sequence[ColouredPart]) -> None:
    """Write all parts as one mesh: float32 places and normals, colours as bytes, faces, and segments as edges.

    Parameters
    ----------
    path
        File to write.
    parts
        One behind the other; the format has no names for them.

    Raises
    ------
    InputError
        If a coordinate is beyond the range of float32.
    """
    offsets = np.cumsum([0, *(len(part.vertices) for part in parts)])
    vertices = np.zeros(offsets[-1], dtype=_VERTEX)
    shifted = []
    for part, start, end in zip(parts, offsets, offsets[1:], strict=False):
        vertices["place"][start:end] = as_float32(part.vertices, path)
        if part.normals is not None:
            vertices["normal"][start:end] = part.normals
        vertices["colour"][start:end] = part.colours
        shifted.append(part.elements + start)
    triangles = np.concatenate([np.empty((0, 3), np.int64), *(rows for rows in shifted if rows.shape[1] == 3)])
    edges = np.concatenate([np.empty((0, 2), np.int64), *(rows for rows in shifted if rows.shape[1] == 2)])
    faces = np.empty(len(triangles), dtype=_FACE)
    faces["count"], faces["corners"] = 3, triangles
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    header += [f"property uchar {name}" for name in ("red", "green", "blue", "alpha")]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    if len(edges):
        header += [f"element edge {len(edges)}", "property int vertex1", "property int vertex2"]
    with atomic_file(path) as partial, partial.open("wb") as stream:
        stream.write("\n".join([*header, "end_header", ""]).encode("ascii"))
        stream.write(vertices.tobytes() + faces.tobytes() + edges.astype("<i4").tobytes())
