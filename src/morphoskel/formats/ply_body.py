"""The body of a PLY file, once its header is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.formats.lines import Line, parse_count, parse_numbers, parse_table, shorten
from morphoskel.shapes import IntArray


@dataclass(frozen=True, eq=False)
class RaggedList:
    """The values of a list property.

    Parameters
    ----------
    counts
        ``(n,)`` int64, number of values in each row.
    values
        ``(counts.sum(),)``, the values of all rows, one after the other.
    """

    counts: IntArray
    values: npt.NDArray[Any]


Column = npt.NDArray[Any] | RaggedList
"""All values of one property."""


@dataclass(frozen=True)
class Property:
    """A declared property; types are NumPy codes without byte order, `count_type` is ``None`` for a scalar."""

    name: str
    type: str
    count_type: str | None = None


@dataclass
class Element:
    """A declared element: its name, the number of its rows and its properties."""

    name: str
    count: int
    properties: list[Property] = field(default_factory=list)

    @property
    def has_lists(self) -> bool:
        """Whether the rows may differ in length."""
        return any(item.count_type for item in self.properties)


def parse_ascii(elements: Sequence[Element], lines: Sequence[Line]) -> dict[str, dict[str, Column]]:
    """Return the columns of every element, one line a row.

    Raises
    ------
    InputError
        If there are fewer or more lines than declared, or a line does not match its element.
    """
    declared = sum(element.count for element in elements)
    if len(lines) != declared:
        wanted = " and ".join(f"{element.count} {element.name}" for element in elements)
        raise InputError(
            f"the header declares {wanted} lines, {declared} in all, but {len(lines)} follow; "
            "the file is truncated or damaged, fetch it again"
        )
    result: dict[str, dict[str, Column]] = {}
    for element in elements:
        own, lines = lines[: element.count], lines[element.count :]
        if element.has_lists:
            result[element.name] = _ascii_lists(element, own)
        else:
            table = parse_table(own, len(element.properties))
            result[element.name] = {item.name: table[:, column] for column, item in enumerate(element.properties)}
    return result


def parse_binary(elements: Sequence[Element], body: bytes, byte_order: str) -> dict[str, dict[str, Column]]:
    """Return the columns of every element.

    Parameters
    ----------
    elements
        As declared in the header.
    body
        All bytes after the header.
    byte_order
        ``<`` or ``>``.

    Raises
    ------
    InputError
        If there is less or more data than declared.
    """
    result: dict[str, dict[str, Column]] = {}
    offset = 0
    for element in elements:
        read = _binary_lists if element.has_lists else _binary_scalars
        result[element.name], offset = read(element, body, offset, byte_order)
    if body[offset:].strip(b" \r\n\t\0"):
        raise InputError(
            f"{len(body) - offset} bytes follow after all that the header declares; the file is damaged, fetch it again"
        )
    return result


def _ascii_lists(element: Element, lines: Sequence[Line]) -> dict[str, Column]:
    """Return the columns of an element whose rows may differ in length."""
    counts: dict[str, list[int]] = {item.name: [] for item in element.properties}
    values: dict[str, list[float]] = {item.name: [] for item in element.properties}
    for line in lines:
        fields = line.text.split()
        position = 0
        for item in element.properties:
            length = 1
            if item.count_type:
                length = parse_count(line, fields[position] if position < len(fields) else "", item.name)
                counts[item.name].append(length)
                position += 1
            values[item.name].extend(parse_numbers(line, fields[position : position + length]))
            position += length
        if position != len(fields):
            raise InputError(
                f"line {line.number}: does not match the declared properties of {element.name}: {shorten(line.text)}"
            )
    return {item.name: _as_column(item, counts[item.name], np.array(values[item.name])) for item in element.properties}


def _binary_scalars(element: Element, body: bytes, offset: int, byte_order: str) -> tuple[dict[str, Column], int]:
    """Return the columns of an element without lists, and where its data end."""
    if not element.properties:
        return {}, offset
    dtype = np.dtype([(item.name, byte_order + item.type) for item in element.properties])
    rows = _take(element, body, offset, dtype, element.count)
    return {item.name: rows[item.name] for item in element.properties}, offset + rows.nbytes


def _binary_lists(element: Element, body: bytes, offset: int, byte_order: str) -> tuple[dict[str, Column], int]:
    """Return the columns of an element with lists, and where its data end."""
    equal = _equal_rows(element, body, offset, byte_order) if element.count else None
    return equal or _walk_rows(element, element.count, body, offset, byte_order)


def _equal_rows(element: Element, body: bytes, offset: int, byte_order: str) -> tuple[dict[str, Column], int] | None:
    """Read all rows at once if each is as long as the first, as in a mesh of triangles; else return ``None``."""
    first, _ = _walk_rows(element, 1, body, offset, byte_order)
    parts: list[tuple[str, str, tuple[int, ...]]] = []
    for item in element.properties:
        column = first[item.name]
        if isinstance(column, RaggedList):
            parts.append((f"count of {item.name}", f"{byte_order}{item.count_type}", ()))
            parts.append((item.name, byte_order + item.type, (len(column.values),)))
        else:
            parts.append((item.name, byte_order + item.type, ()))
    dtype = np.dtype(parts)
    if offset + dtype.itemsize * element.count > len(body):
        return None
    rows = _take(element, body, offset, dtype, element.count)
    columns: dict[str, Column] = {}
    for item in element.properties:
        if item.count_type is None:
            columns[item.name] = rows[item.name]
            continue
        counts = rows[f"count of {item.name}"].astype(np.int64)
        if (counts != rows[item.name].shape[1]).any():
            return None
        columns[item.name] = RaggedList(counts, rows[item.name].reshape(-1))
    return columns, offset + rows.nbytes


def _walk_rows(
    element: Element, count: int, body: bytes, offset: int, byte_order: str
) -> tuple[dict[str, Column], int]:
    """Read `count` rows one after the other."""
    counts: dict[str, list[int]] = {item.name: [] for item in element.properties}
    values: dict[str, list[npt.NDArray[Any]]] = {item.name: [] for item in element.properties}
    for _ in range(count):
        for item in element.properties:
            length = 1
            if item.count_type:
                dtype = np.dtype(byte_order + item.count_type)
                length = int(_take(element, body, offset, dtype, 1)[0])
                if length < 0:
                    raise InputError(
                        f"a list {item.name} of {element.name} has the length {length}; the file is damaged"
                    )
                counts[item.name].append(length)
                offset += dtype.itemsize
            taken = _take(element, body, offset, np.dtype(byte_order + item.type), length)
            values[item.name].append(taken)
            offset += taken.nbytes
    columns = {
        item.name: _as_column(item, counts[item.name], np.concatenate([np.empty(0, item.type), *values[item.name]]))
        for item in element.properties
    }
    return columns, offset


def _as_column(item: Property, counts: list[int], values: npt.NDArray[Any]) -> Column:
    """Return `values` as they are for a scalar property, with their counts for a list."""
    return values if item.count_type is None else RaggedList(np.array(counts, dtype=np.int64), values)


def _take(element: Element, body: bytes, offset: int, dtype: np.dtype[Any], count: int) -> npt.NDArray[Any]:
    """Return `count` values at `offset`, or say that the data end too early."""
    if offset + dtype.itemsize * count > len(body):
        raise InputError(
            f"the header declares {element.count} {element.name} rows, but the data end before the last of them; "
            "the file is truncated, fetch it again"
        )
    return np.frombuffer(body, dtype, count, offset) if count else np.empty(0, dtype)
