"""How each shape of a shard fared: the file ``status.csv`` in every stage's folder."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from morphoskel.checksums import LIST, intact, write_checksums
from morphoskel.csv_lines import QUOTED_ENDS, LineFeeds
from morphoskel.errors import InputError, StorageError

FILE_NAME = "status.csv"


@dataclass(frozen=True)
class Status:
    """One shape at one stage.

    Parameters
    ----------
    id, category
        From the manifest.
    status
        ``ok`` or ``failed``.
    stage
        The stage that wrote the row or, of a failed shape, the one that failed.
    reason
        Why it failed; empty otherwise.
    attempts
        1, or 2 if the shape was retried.
    seconds
        Wall time of the last attempt.
    seconds_so_far
        Together with the stages before it.
    details
        Counts that the stage records, as ``name=value`` joined by semicolons.
    log
        Where the stage that wrote the row logged.
    """

    id: str
    category: str
    status: str
    stage: str
    reason: str
    attempts: int
    seconds: float
    seconds_so_far: float
    details: str
    log: str = ""

    @property
    def failure(self) -> str:
        """Stage, reason and log of a shape that failed, in words."""
        return f"{self.stage}: {self.reason}" + (f" (log: {self.log})" if self.log else "")


def write_status(folder: Path, rows: Iterable[Status]) -> None:
    """Write the rows, sorted by shape id, to ``status.csv`` in `folder`, and the checksums of all files there.

    Called last: a file that is written later is damaged in the eyes of a reader.
    """
    with (folder / FILE_NAME).open("w", encoding="utf-8", newline="") as stream:
        names = [field.name for field in fields(Status)]
        writer = csv.DictWriter(LineFeeds(stream), names, lineterminator=QUOTED_ENDS)
        writer.writeheader()
        for row in sorted(rows, key=lambda row: row.id):
            times = {name: f"{getattr(row, name):.3f}" for name in ("seconds", "seconds_so_far")}
            writer.writerow({**asdict(row), **times})
    write_checksums(folder)


def read_status(folder: Path) -> list[Status]:
    """Read the rows of ``status.csv`` in `folder`.

    Raises
    ------
    StorageError
        If the file is damaged, or the folder has lost its checksums.
    InputError
        If the file holds no such rows.
    """
    if not (folder / LIST).exists():
        raise StorageError(f"{folder}: has no {LIST}, which every stage writes; remove the folder and run again")
    path = intact(folder / FILE_NAME)
    names = [field.name for field in fields(Status)]
    try:
        with path.open(encoding="utf-8", newline="") as stream:
            header, *rows = csv.reader(stream, strict=True)
        if header != names:
            raise ValueError(f"the columns are {','.join(header)}")
        return [_parse(dict(zip(names, row, strict=True))) for row in rows]
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(
            f"{path}: expected the status of shapes with the columns {','.join(names)} ({error}); delete the folder to "
            "have the stage run again"
        ) from error


def _parse(row: dict[str, str]) -> Status:
    numbers = {"attempts": int(row["attempts"]), **{name: float(row[name]) for name in ("seconds", "seconds_so_far")}}
    if row["status"] not in ("ok", "failed"):
        raise ValueError(f"{row['id']}: the status is {row['status']!r}")
    return Status(**{**row, **numbers})  # type: ignore[arg-type]
