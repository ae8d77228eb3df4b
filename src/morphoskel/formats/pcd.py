"""Clouds of the Point Cloud Library: PCD, ASCII, binary or compressed."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.formats.assemble import assemble_shape
from morphoskel.formats.lines import parse_table, significant_lines
from morphoskel.shapes import Mesh, PointCloud

_KINDS = {"F": "f", "I": "i", "U": "u"}
_SIZES = {"1", "2", "4", "8"}
_MOST_VALUES = 1 << 16
"""Of a field and point; the longest descriptors in use have some thousands."""

_NORMALS = ("normal_x", "normal_y", "normal_z")


@dataclass(frozen=True)
class _Header:
    fields: tuple[tuple[str, str, int], ...]  # name, NumPy type, values a point
    points: int
    data: str


def parse_pcd(content: bytes) -> PointCloud | Mesh:
    """Parse a PCD file; ``normal_x normal_y normal_z`` become normals, ``label`` becomes labels.

    Parameters
    ----------
    content
        The whole file.

    Raises
    ------
    InputError
        If the header is not legal, or the data do not match it.
    """
    end = re.search(rb"^DATA[ \t]+(\w+)[ \t]*(\r\n|\n|\Z)", content, re.MULTILINE)
    if end is None:
        raise InputError("expected a PCD header that ends with a line 'DATA ascii|binary|binary_compressed'")
    header = _parse_header(content[: end.end()], end[1].decode())
    body = content[end.end() :]
    if header.data == "ascii":
        columns = _parse_ascii(header, body, content.count(b"\n", 0, end.end()) + 1)
    elif header.data == "binary":
        columns = _parse_binary(header, body)
    else:
        columns = _parse_compressed(header, body)
    absent = [name for name in "xyz" if name not in columns]
    if absent:
        raise InputError(f"expected the fields x, y and z; the file has {', '.join(columns)}")
    has_normals = all(name in columns for name in _NORMALS)
    return assemble_shape(
        np.stack([columns[name] for name in "xyz"], axis=1),
        normals=np.stack([columns[name] for name in _NORMALS], axis=1) if has_normals else None,
        labels=columns.get("label"),
    )


def _parse_header(content: bytes, data: str) -> _Header:
    entries: dict[str, list[str]] = {}
    for line in significant_lines(content):
        key, *values = line.text.split()
        entries[key] = values
    missing = [key for key in ("FIELDS", "SIZE", "TYPE") if key not in entries]
    if missing or not ({"POINTS"} <= entries.keys() or {"WIDTH", "HEIGHT"} <= entries.keys()):
        raise InputError(f"the PCD header lacks {', '.join(missing) or 'POINTS'}; the file is damaged, fetch it again")
    if data not in ("ascii", "binary", "binary_compressed"):
        raise InputError(f"DATA: expected ascii, binary or binary_compressed, got {data!r}")
    try:
        names, kinds = entries["FIELDS"], [_KINDS[kind] for kind in entries["TYPE"]]
        if not set(entries["SIZE"]) <= _SIZES:  # numpy would take a comma for the end of a field
            raise ValueError(f"a SIZE is none of {', '.join(sorted(_SIZES))}")
        counts = [int(count) for count in entries.get("COUNT", ["1"] * len(names))]
        types = [np.dtype(f"<{kind}{size}").str for kind, size in zip(kinds, entries["SIZE"], strict=True)]
        fields = tuple(zip(names, types, counts, strict=True))
        size = entries.get("POINTS") or [str(int(entries["WIDTH"][0]) * int(entries["HEIGHT"][0]))]
        if min(int(size[0]), *counts) < 0 or 0 in counts:
            raise ValueError("a count is not positive")
        if max(counts) > _MOST_VALUES:
            raise ValueError(f"a field has more than {_MOST_VALUES} values a point")
        return _Header(fields, int(size[0]), data)
    except (ValueError, KeyError, TypeError, IndexError) as error:
        raise InputError(
            f"the PCD header is not legal ({error}); check FIELDS, SIZE, TYPE, COUNT and POINTS"
        ) from error


def _parse_ascii(header: _Header, body: bytes, first_number: int) -> dict[str, npt.NDArray[Any]]:
    lines = significant_lines(body, first_number=first_number)
    if len(lines) != header.points:
        raise InputError(
            f"the header declares {header.points} points, but {len(lines)} lines follow; "
            "the file is truncated or damaged, fetch it again"
        )
    table = parse_table(lines, sum(count for _, _, count in header.fields))
    columns: dict[str, npt.NDArray[Any]] = {}
    position = 0
    for name, _, count in header.fields:
        columns[name] = table[:, position]
        position += count
    return columns


def _parse_binary(header: _Header, body: bytes) -> dict[str, npt.NDArray[Any]]:
    # Fields may share a name (padding is called "_"), so the rows are addressed by position.
    parts = [(f"{index}", kind, (count,)) for index, (_, kind, count) in enumerate(header.fields)]
    dtype = np.dtype(parts)
    _check_size(header, len(body), dtype.itemsize * header.points)
    rows = np.frombuffer(body, dtype, header.points)
    return {name: rows[f"{index}"][:, 0] for index, (name, _, _) in enumerate(header.fields)}


def _parse_compressed(header: _Header, body: bytes) -> dict[str, npt.NDArray[Any]]:
    """Read ``binary_compressed`` data: LZF, and field after field instead of point after point."""
    if len(body) < 8:
        raise InputError("the compressed data lack their sizes; the file is truncated, fetch it again")
    compressed_size, size = struct.unpack_from("<II", body)
    _check_size(header, len(body), 8 + compressed_size)
    data = decompress_lzf(body[8 : 8 + compressed_size], size)
    _check_size(header, size, sum(np.dtype(kind).itemsize * count for _, kind, count in header.fields) * header.points)
    columns: dict[str, npt.NDArray[Any]] = {}
    offset = 0
    for name, kind, count in header.fields:
        values = np.frombuffer(data, kind, header.points * count, offset)
        columns[name] = values.reshape(header.points, count)[:, 0]
        offset += values.nbytes
    return columns


def decompress_lzf(data: bytes, size: int) -> bytes:
    """Return the `size` bytes that `data` holds, compressed in the LZF format of M. Lehmann's LibLZF.

    Raises
    ------
    InputError
        If the data are damaged.
    """
    output = bytearray()
    position = 0
    try:
        while position < len(data):
            control = data[position]
            position += 1
            if control < 32:  # a run of control + 1 literal bytes
                output += data[position : position + control + 1]
                position += control + 1
                continue
            length = control >> 5  # otherwise a copy of length + 2 bytes that were already written
            if length == 7:
                length += data[position]
                position += 1
            start = len(output) - ((control & 31) << 8 | data[position]) - 1
            position += 1
            if start < 0:
                raise IndexError
            for index in range(start, start + length + 2):  # may overlap with what it writes
                output.append(output[index])
    except IndexError as error:
        raise InputError("the compressed data are damaged; fetch the file again") from error
    if len(output) != size:
        raise InputError(f"the compressed data hold {len(output)} instead of {size} bytes; fetch the file again")
    return bytes(output)


def _check_size(header: _Header, have: int, need: int) -> None:
    if have < need:
        raise InputError(
            f"the header declares {header.points} points, {need} bytes, but {have} bytes follow; "
            f"the file is truncated, fetch it again"
        )
