"""How each shape of a shard fared: the file ``status.csv`` in every stage's folder."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

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


def write_status(folder: Path, rows: Iterable[Status]) -> None:
    """Write the rows, sorted by shape id, to ``status.csv`` in `folder`."""
    with (folder / FILE_NAME).open("w", newline="") as stream:
        writer = csv.DictWriter(stream, [field.name for field in fields(Status)], lineterminator="\n")
        writer.writeheader()
        for row in sorted(rows, key=lambda row: row.id):
            times = {name: f"{getattr(row, name):.3f}" for name in ("seconds", "seconds_so_far")}
            writer.writerow({**asdict(row), **times})


def read_status(folder: Path) -> list[Status]:
    """Read the rows of ``status.csv`` in `folder`."""
    with (folder / FILE_NAME).open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    kinds = {"attempts": int, "seconds": float, "seconds_so_far": float}
    return [Status(**{name: kinds.get(name, str)(value) for name, value in row.items()}) for row in rows]
