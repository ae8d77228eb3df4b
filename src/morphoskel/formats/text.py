"""Clouds as plain columns of numbers: XYZ, TXT, PTS, CSV."""

from __future__ import annotations

from morphoskel.errors import InputError
from morphoskel.formats.assemble import assemble_shape
from morphoskel.formats.lines import parse_count, parse_table, significant_lines
from morphoskel.shapes import FloatArray, Mesh, PointCloud

_COLUMNS = "3 (x y z), 4 (x y z label), 6 (x y z nx ny nz) or 7 (x y z nx ny nz label)"


def parse_text(content: bytes) -> PointCloud | Mesh:
    """Parse a cloud with one point in a line.

    The columns are ``x y z``, then optionally a normal ``nx ny nz``, then optionally an integer label, separated by
    white space, commas or semicolons. ``#`` and ``//`` start a comment. A first line with one whole number, as laser
    scanners write it into PTS files, is the number of points.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If the lines are not such columns, or there are not as many as the first line says.
    """
    lines = significant_lines(content, comments=("#", "//"))
    if lines and lines[0].text.isdecimal():
        declared, lines = parse_count(lines[0], lines[0].text, "points"), lines[1:]
        if len(lines) != declared:
            raise InputError(
                f"the first line declares {declared} points, but {len(lines)} follow; the file is truncated or damaged"
            )
    return cloud_of_columns(parse_table(lines)) if lines else _refuse_width(0)


def cloud_of_columns(table: FloatArray) -> PointCloud | Mesh:
    """Return the cloud whose coordinates, normals and labels are the columns of `table`, ``(N, 3 | 4 | 6 | 7)``.

    Raises
    ------
    InputError
        If the number of columns has no meaning, or the last of 4 or 7 columns holds no whole numbers.
    """
    columns = table.shape[1]
    if columns not in (3, 4, 6, 7):
        return _refuse_width(columns)
    return assemble_shape(
        table[:, :3],
        normals=table[:, 3:6] if columns >= 6 else None,
        labels=table[:, -1] if columns in (4, 7) else None,
    )


def _refuse_width(columns: int) -> PointCloud:
    raise InputError(f"expected {_COLUMNS} columns of numbers, got {columns}")
