"""Numbers in the lines of text formats, with errors that name the line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray

_MOST_DIGITS = 18
"""Of a count: what is larger does not fit into 64 bits, and from 4300 on Python itself refuses."""


class Line(NamedTuple):
    """A line of a file: its number, counted from 1, and its text."""

    number: int
    text: str


def significant_lines(content: bytes, *, comments: Sequence[str] = ("#",), first_number: int = 1) -> list[Line]:
    """Return the lines that hold anything after comments are cut off; any kind of line end is understood.

    Raises
    ------
    InputError
        If the content is binary.
    """
    if b"\0" in content:
        raise InputError("expected text, found binary data; check that the file's suffix matches its format")
    lines: list[Line] = []
    for number, raw in enumerate(content.decode("utf-8-sig", errors="replace").splitlines(), start=first_number):
        text = raw
        for mark in comments:
            text = text.partition(mark)[0]
        text = text.strip()
        if text:
            lines.append(Line(number, text))
    return lines


def parse_table(lines: Sequence[Line], columns: int | None = None) -> FloatArray:
    """Return the numbers of `lines`, which must all have the same number of columns.

    Parameters
    ----------
    lines
        Numbers separated by white space, commas or semicolons.
    columns
        Expected number of columns; ``None`` takes it from the first line.

    Returns
    -------
    FloatArray
        ``(len(lines), columns)``.

    Raises
    ------
    InputError
        If a line has another number of columns or holds something else than numbers.
    """
    if not lines:
        return np.empty((0, columns or 0))
    rows = [split_fields(line.text) for line in lines]
    width = len(rows[0]) if columns is None else columns
    for line, row in zip(lines, rows, strict=True):
        if len(row) != width:
            raise InputError(f"line {line.number}: expected {width} numbers, got {len(row)}: {shorten(line.text)}")
    try:
        return np.array(rows, dtype=np.float64)
    except ValueError:
        for line, row in zip(lines, rows, strict=True):
            parse_numbers(line, row)
        raise


def parse_numbers(line: Line, fields: Sequence[str]) -> list[float]:
    """Return `fields`, which stem from `line`, as numbers.

    Raises
    ------
    InputError
        If a field is not a number.
    """
    try:
        return [float(field) for field in fields]
    except ValueError as error:
        raise InputError(f"line {line.number}: expected only numbers: {shorten(line.text)}") from error


def parse_count(line: Line, field: str, what: str) -> int:
    """Return `field`, which stems from `line`, as a count of `what`.

    Raises
    ------
    InputError
        If it is not a whole number of at least 0.
    """
    if not (field.isascii() and field.isdecimal() and len(field) <= _MOST_DIGITS):
        raise InputError(f"line {line.number}: expected the number of {what}, got {shorten(field)}")
    return int(field)


def split_fields(text: str) -> list[str]:
    """Split at white space, commas and semicolons."""
    return text.replace(",", " ").replace(";", " ").split()


def shorten(text: str, length: int = 60) -> str:
    """Return `text` in quotation marks, cut to `length` characters."""
    return repr(text if len(text) <= length else f"{text[:length]}...")
