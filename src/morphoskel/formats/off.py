"""Meshes and clouds in the Object File Format."""

from __future__ import annotations

import re

import numpy as np

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_whole_numbers, assemble_shape
from morphoskel.formats.lines import Line, parse_count, parse_numbers, parse_table, shorten, significant_lines
from morphoskel.shapes import FloatArray, Mesh, PointCloud


def parse_off(content: bytes) -> PointCloud | Mesh:
    """Parse an ASCII OFF, COFF or NOFF file.

    Colours are ignored; the normals of NOFF are kept if there are no faces. Some files of ModelNet lack the line
    break after ``OFF`` (``OFF490 518 0``), which is understood.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If the header is not one of those, or the body does not hold what the header declares.
    """
    lines = significant_lines(content)
    if not lines:
        raise InputError("expected a line 'OFF', found no data")
    kind, counts, body = _parse_header(lines)
    vertex_count, face_count = counts
    if len(body) < vertex_count + face_count:
        raise InputError(
            f"the header declares {vertex_count} vertices and {face_count} faces, but only {len(body)} of these "
            f"{vertex_count + face_count} lines follow; the file is truncated, fetch it again"
        )
    if len(body) > vertex_count + face_count:
        extra = body[vertex_count + face_count]
        raise InputError(
            f"line {extra.number}: the header declares {vertex_count} vertices and {face_count} faces, but more lines "
            f"follow: {shorten(extra.text)}"
        )
    vertices = _parse_vertices(body[:vertex_count], 6 if kind == "NOFF" else 3)
    faces = _parse_faces(body[vertex_count:])
    return assemble_shape(vertices[:, :3], faces, normals=vertices[:, 3:] if kind == "NOFF" else None)


def _parse_header(lines: list[Line]) -> tuple[str, tuple[int, int], list[Line]]:
    """Return the kind, the numbers of vertices and faces, and the lines after the header."""
    first = lines[0]
    match = re.fullmatch(r"(OFF|COFF|NOFF)\s*((?:\d+\s*){0,3})", first.text)
    if match is None:
        raise InputError(f"line {first.number}: expected ASCII 'OFF', 'COFF' or 'NOFF', got {shorten(first.text)}")
    body = lines[1:]
    counts_line = first if match[2] else next(iter(body), None)
    if counts_line is None:
        raise InputError("expected a line with the numbers of vertices and faces; the file is truncated")
    fields = (match[2] or counts_line.text).split()
    if len(fields) not in (2, 3):
        raise InputError(
            f"line {counts_line.number}: expected the numbers of vertices, faces and edges, "
            f"got {shorten(counts_line.text)}"
        )
    counts = (parse_count(counts_line, fields[0], "vertices"), parse_count(counts_line, fields[1], "faces"))
    return match[1], counts, body if match[2] else body[1:]


def _parse_vertices(lines: list[Line], columns: int) -> FloatArray:
    """Return the first `columns` numbers of each line; what follows them are colours."""
    for line in lines:
        if len(line.text.split()) < columns:
            raise InputError(f"line {line.number}: expected {columns} numbers, got {shorten(line.text)}")
    return parse_table([Line(line.number, " ".join(line.text.split()[:columns])) for line in lines], columns)


def _parse_faces(lines: list[Line]) -> Polygons:
    """Return the polygons; the numbers behind a face's corners are colours."""
    counts = np.empty(len(lines), dtype=np.int64)
    corners: list[float] = []
    for index, line in enumerate(lines):
        fields = line.text.split()
        count = parse_count(line, fields[0], "corners")
        if len(fields) < 1 + count:
            raise InputError(f"line {line.number}: expected {count} vertex indices, got {shorten(line.text)}")
        counts[index] = count
        corners.extend(parse_numbers(line, fields[1 : 1 + count]))
    return Polygons(counts, as_whole_numbers(np.array(corners), "vertex indices of the faces"))
