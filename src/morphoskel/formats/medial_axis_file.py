"""Published medial axes: MA files, and the PLY files that come with the Point2Skeleton shapes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_whole_numbers, triangulate_fans
from morphoskel.formats.lines import Line, parse_count, parse_table, shorten, significant_lines
from morphoskel.formats.ply import parse_ply_elements, stack_properties
from morphoskel.formats.ply_body import RaggedList
from morphoskel.shapes import FloatArray, IntArray, Skeleton

_RECORDS = {"v": ("vertices", 4, "x y z r"), "e": ("edges", 2, "i j"), "f": ("faces", 3, "i j k")}
"""First field of a line of an MA file: what it lists, how many numbers follow, and their names."""


def read_medial_axis(path: Path | str) -> Skeleton:
    """Read a medial axis.

    Parameters
    ----------
    path
        ``.ma``: a line with the numbers of vertices, edges and faces, then lines ``v x y z r``, ``e i j`` and
        ``f i j k`` with indices from 0. Numbers behind these are flags of the program that wrote the file, and are
        left out. ``.ply``: vertices, with or without faces and edges.

    Returns
    -------
    Skeleton
        In the units and the order of the file. A PLY file has its radii in a property ``radius`` or ``r``; where it
        has none they are 0, and only the centres mean anything. Distances between a skeleton and a medial axis are
        taken with all radii 0 in any case.

    Raises
    ------
    InputError
        If the file is missing, damaged, of another format, or has no vertices. The message names the file and, where
        there is one, the line.
    """
    path = Path(path)
    parsers: dict[str, Callable[[bytes], Skeleton]] = {".ma": _parse_ma, ".ply": _parse_ply}
    parse = parsers.get(path.suffix.lower())
    if parse is None:
        raise InputError(f"{path}: expected a medial axis as .ma or .ply, got {path.suffix!r}; convert the file")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from error
    try:
        skeleton = parse(content)
        if len(skeleton) == 0:
            raise InputError("the medial axis has no vertices; fetch the file again")
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    return skeleton


def _parse_ma(content: bytes) -> Skeleton:
    lines = significant_lines(content)
    if not lines:
        raise InputError("expected a line with the numbers of vertices, edges and faces, found no data")
    header, body = lines[0], lines[1:]
    fields = header.text.split()
    if len(fields) != len(_RECORDS):
        raise InputError(
            f"line {header.number}: expected the numbers of vertices, edges and faces, got {shorten(header.text)}"
        )
    records = _group_records(body)
    tables: dict[str, FloatArray] = {}
    for (letter, (what, columns, _)), field in zip(_RECORDS.items(), fields, strict=True):
        declared = parse_count(header, field, what)
        if len(records[letter]) != declared:
            raise InputError(
                f"line {header.number}: declares {declared} {what}, but {len(records[letter])} lines {letter!r} "
                "follow; the file is truncated or damaged, fetch it again"
            )
        tables[letter] = parse_table(records[letter], columns)
    vertices = tables["v"]
    _refuse_rows(records["v"], np.isfinite(vertices).all(axis=1) & (vertices[:, 3] >= 0), "a point and its radius")
    edges, triangles = (_as_indices(records[letter], tables[letter], len(vertices)) for letter in ("e", "f"))
    return Skeleton(vertices[:, :3], vertices[:, 3], edges=edges, triangles=triangles)


def _group_records(body: list[Line]) -> dict[str, list[Line]]:
    """Return the lines by their first field, cut to the numbers that have a meaning."""
    records: dict[str, list[Line]] = {letter: [] for letter in _RECORDS}
    for line in body:
        letter, *numbers = line.text.split()
        if letter not in records:
            raise InputError(f"line {line.number}: expected a line 'v', 'e' or 'f', got {shorten(line.text)}")
        _, columns, names = _RECORDS[letter]
        if len(numbers) < columns:
            raise InputError(f"line {line.number}: expected '{letter} {names}', got {shorten(line.text)}")
        records[letter].append(Line(line.number, " ".join(numbers[:columns])))
    return records


def _as_indices(lines: list[Line], table: FloatArray, vertices: int) -> IntArray:
    """Return `table`, which stems from `lines`, as indices of vertices."""
    legal = (table == np.trunc(table)) & (table >= 0) & (table < vertices)
    _refuse_rows(lines, legal.all(axis=1), f"vertex indices from 0 to {vertices - 1}")
    return table.astype(np.int64)


def _refuse_rows(lines: list[Line], legal: npt.NDArray[np.bool_], expected: str) -> None:
    """Name the first line that is not legal, if there is one."""
    bad = np.flatnonzero(~legal)
    if len(bad):
        line = lines[bad[0]]
        raise InputError(f"line {line.number}: expected {expected}, got {shorten(line.text)}")


def _parse_ply(content: bytes) -> Skeleton:
    elements = parse_ply_elements(content)
    vertex = elements.get("vertex", {})
    points = stack_properties(vertex, ("x", "y", "z"))
    radius = next((name for name in ("radius", "r") if name in vertex), None)
    radii = np.zeros(len(points)) if radius is None else stack_properties(vertex, (radius,))[:, 0]
    edges, triangles = np.empty((0, 2), dtype=np.int64), np.empty((0, 3), dtype=np.int64)
    if "edge" in elements:
        edges = as_whole_numbers(stack_properties(elements["edge"], ("vertex1", "vertex2")), "edges")
    face = elements.get("face", {})
    corners = face.get("vertex_indices", face.get("vertex_index"))
    if isinstance(corners, RaggedList):
        triangles = triangulate_fans(Polygons(corners.counts, as_whole_numbers(corners.values, "faces")))
    return Skeleton(points, radii, edges=edges, triangles=triangles)
