"""The manifest: every shape of a data set, in a fixed order, cut into shards and pinned by a checksum."""

from __future__ import annotations

import csv
import hashlib
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from morphoskel.checksums import checked_file, intact
from morphoskel.csv_lines import QUOTED_ENDS, LineFeeds
from morphoskel.errors import DatasetError
from morphoskel.progress import count_up, track

COLUMNS = ("id", "category", "split", "shard", "path", "sha256")
"""Columns of a manifest file, in order."""

SAFE_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9._+-]{0,199}")
"""What an id or a split may look like, so that it can be part of a file name on every system."""

_BLOCK = 1 << 20


@dataclass(frozen=True)
class Entry:
    """One shape as a data set lists it.

    Parameters
    ----------
    id
        Unique in the data set over all splits, and safe as a file name.
    category
        Class of the shape, for example ``Chair``.
    split
        ``train``, ``val`` or ``test``.
    path
        The file that the data set's `load` takes.
    companions
        Further files of the same shape, for example its labels.
    """

    id: str
    category: str
    split: str
    path: Path
    companions: tuple[Path, ...] = ()


@dataclass(frozen=True)
class ShapeRecord:
    """One row of a manifest.

    Parameters
    ----------
    id, category, split, path
        As in :class:`Entry`.
    shard
        Which slice of the split the shape belongs to, counted from 0.
    sha256
        Checksum over the shape's files, see :func:`checksum`.
    """

    id: str
    category: str
    split: str
    shard: int
    path: Path
    sha256: str


def build_manifest(entries: Iterable[Entry], *, shard_size: int, progress: bool = False) -> list[ShapeRecord]:
    """Sort the shapes, cut each split into shards and take the checksums.

    Parameters
    ----------
    entries
        The shapes, in any order.
    shard_size
        Number of shapes in a shard, at least 1; the last shard of a split may hold fewer.
    progress
        Show a progress bar.

    Returns
    -------
    list of ShapeRecord
        Sorted by (split, id), so that it does not depend on the order of `entries`.

    Raises
    ------
    DatasetError
        If there is no shape, an id occurs twice or is unsafe as a file name, or a file is missing.
    """
    if shard_size < 1:
        raise DatasetError(f"shard_size: expected at least 1 shape in a shard, got {shard_size}")
    ordered = sorted(entries, key=lambda entry: (entry.split, entry.id))
    _check_entries(ordered)
    records: list[ShapeRecord] = []
    position: dict[str, int] = {}
    for entry in track(ordered, "checksums", show=progress):
        index = position.get(entry.split, 0)
        position[entry.split] = index + 1
        digest = checksum(entry.path, *entry.companions)
        shard = index // shard_size
        records.append(ShapeRecord(entry.id, entry.category, entry.split, shard, entry.path, digest))
    return records


def checksum(*paths: Path, progress: bool = False) -> str:
    """Return the SHA-256 (hexadecimal) of the contents of `paths`, one after the other.

    It equals what ``cat FILES | sha256sum`` prints. The files are streamed, so their size does not matter.

    Parameters
    ----------
    *paths
        Files.
    progress
        Show how many bytes are done.

    Raises
    ------
    DatasetError
        If a file cannot be read.
    """
    digest = hashlib.sha256()
    for path in paths:
        try:
            with (
                path.open("rb") as stream,
                count_up(f"checksum of {path.name}", unit="B", total=path.stat().st_size, show=progress) as advance,
            ):
                while block := stream.read(_BLOCK):
                    digest.update(block)
                    advance(len(block))
        except OSError as error:
            raise DatasetError(f"{path}: cannot be read ({error.strerror}); restore the file") from error
    return digest.hexdigest()


def write_manifest(path: Path, records: Iterable[ShapeRecord]) -> None:
    """Write `records` as CSV (UTF-8, line feeds only): equal records give equal bytes."""
    with checked_file(path) as partial, partial.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(LineFeeds(stream), lineterminator=QUOTED_ENDS)
        writer.writerow(COLUMNS)
        for record in records:
            row = (record.id, record.category, record.split, record.shard, record.path.as_posix(), record.sha256)
            writer.writerow(row)


def read_manifest(path: Path, *, split: str | None = None, shard: int | None = None) -> list[ShapeRecord]:
    """Read a manifest, or only one split or shard of it.

    Parameters
    ----------
    path
        A file that :func:`write_manifest` wrote.
    split, shard
        Keep only the shapes of this split and shard; ``None`` keeps all.

    Returns
    -------
    list of ShapeRecord
        In the order of the file.

    Raises
    ------
    DatasetError
        If the file is missing or not a manifest, or if nothing is left while a split or shard was asked for.
    StorageError
        If the file is damaged.
    """
    try:
        with intact(path).open(encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise DatasetError(f"{path}: cannot be read as a manifest ({error}); build the manifest first") from error
    if not rows or tuple(rows[0]) != COLUMNS:
        raise DatasetError(f"{path}:1: expected the columns {','.join(COLUMNS)}; delete the file to have it rebuilt")
    records = [_parse_row(path, line, row) for line, row in enumerate(rows[1:], start=2)]
    kept = [
        record
        for record in records
        if (split is None or record.split == split) and (shard is None or record.shard == shard)
    ]
    if not kept and (split is not None or shard is not None):
        have = sorted({(record.split, record.shard) for record in records})
        raise DatasetError(
            f"{path}: holds no shape of split {split!r}, shard {shard!r}; it holds {_list_shards(have)}. "
            "If the data set or shard_size changed, delete the manifest to have it rebuilt"
        )
    return kept


def _check_entries(ordered: Sequence[Entry]) -> None:
    """Raise if the entries, as a whole, cannot become a manifest."""
    if not ordered:
        raise DatasetError("the data set holds no shape; check its root folder and the categories chosen")
    seen: dict[str, Entry] = {}
    for entry in ordered:
        for what, name in (("id", entry.id), ("split", entry.split)):
            if not SAFE_NAME.fullmatch(name) or name.endswith((".", ".partial")):
                raise DatasetError(
                    f"{entry.path}: its {what} {name!r} is unsafe as a file name; rename the file so that it has "
                    "at most 200 letters a-z, digits and _ . + -, starts with a letter, digit or _, and does not end "
                    "with a dot"
                )
        if not _is_text(entry.path):
            raise DatasetError(
                f"{str(entry.path)!r}: its name is not encoded as UTF-8, so that it cannot be listed; rename the file"
            )
        other = seen.setdefault(entry.id, entry)
        if other is not entry:
            raise DatasetError(
                f"id {entry.id!r} occurs twice: {other.path} (split {other.split}) and {entry.path} (split "
                f"{entry.split}); a shape must be listed once, and in one split only"
            )
    missing = [path for entry in ordered for path in (entry.path, *entry.companions) if not path.is_file()]
    if missing:
        raise DatasetError(
            f"{missing[0]}: file is missing, {len(missing)} missing in all; fetch the data set again, or repair "
            "its split lists"
        )


def _is_text(path: Path) -> bool:
    """Tell whether a path can be written to a text file; names in other encodings than UTF-8 cannot."""
    try:
        str(path).encode()
    except UnicodeEncodeError:
        return False
    return True


def _parse_row(path: Path, line: int, row: list[str]) -> ShapeRecord:
    """Return one row of a manifest as a record."""
    legal = len(row) == len(COLUMNS) and re.fullmatch(r"[0-9]{1,18}", row[3]) and re.fullmatch(r"[0-9a-f]{64}", row[5])
    if not legal:
        raise DatasetError(
            f"{path}:{line}: expected {','.join(COLUMNS)} with a whole number as shard and 64 hexadecimal digits as "
            f"sha256, got {','.join(row)!r}; delete the file to have it rebuilt"
        )
    return ShapeRecord(row[0], row[1], row[2], int(row[3]), Path(row[4]), row[5])


def _list_shards(shards: Sequence[tuple[str, int]]) -> str:
    """Return a short text on the splits and the number of their shards."""
    splits = sorted({split for split, _ in shards})
    counted = (f"{split} (shards 0 to {max(number for name, number in shards if name == split)})" for split in splits)
    return ", ".join(counted) or "nothing"


def first_of_each_category(records: Iterable[ShapeRecord]) -> list[ShapeRecord]:
    """Return the first shape of every category, in order of appearance."""
    first: dict[str, ShapeRecord] = {}
    for record in records:
        first.setdefault(record.category, record)
    return list(first.values())
