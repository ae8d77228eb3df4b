"""Which shapes of a run failed and why, from the files ``status.csv`` of its stages."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from morphoskel.chain.status import FILE_NAME, Status, read_status
from morphoskel.reporting.names import surface_name
from morphoskel.reporting.page.privacy import without_absolute_paths

NUMBER = re.compile(r"\d+(?:\.\d+)?")
VARYING = "…"
"""Stands for a number that is not the same for all shapes of a group."""

EXAMPLES = 3
"""Shapes that a group names."""

Shape = tuple[str, str, str]
"""Data set, split and id."""


@dataclass(frozen=True)
class FailureGroup:
    """Shapes that failed at the same stage for the same reason.

    Parameters
    ----------
    stage
        Where.
    reason
        Why, without absolute paths; an ellipsis stands for numbers that differ among the shapes.
    surfaces
        The surface reconstructions on which they failed, by their names for readers; ``cloud`` stands for methods that
        need none. Empty for a stage that has no such choice.
    shapes
        Number of shapes.
    examples
        Ids of the first ones.
    """

    stage: str
    reason: str
    surfaces: tuple[str, ...]
    shapes: int
    examples: tuple[str, ...]


@dataclass(frozen=True)
class Failures:
    """How the shapes of a run fared.

    Parameters
    ----------
    shapes, failed, retried
        Number of shapes, of those that failed somewhere, and of those that needed a second attempt somewhere, which
        then succeeded.
    groups
        The largest first.
    """

    shapes: int
    failed: int
    retried: int
    groups: tuple[FailureGroup, ...]


def collect_failures(run_folder: Path) -> Failures:
    """Read every ``status.csv`` in the folder of a run: ``{kind}/{dataset}/{split}/.../{shard}/status.csv``.

    A shape that failed is carried on by the stages behind; it counts once for the stage at which it failed.
    """
    shapes: set[Shape] = set()
    retried: set[Shape] = set()
    groups: dict[tuple[str, str], list[tuple[Shape, str, Status]]] = {}
    for path in sorted(run_folder.rglob(FILE_NAME)):
        folders = path.relative_to(run_folder).parts[:-1]
        # A stage that is still being written, or was killed, has not said its last word.
        if len(folders) < 4 or any(name.endswith(".partial") for name in folders):
            continue
        surface = folders[3] if len(folders) > 4 else ""
        for row in read_status(path.parent):
            shape = (folders[1], folders[2], row.id)
            shapes.add(shape)
            if row.status == "failed":
                key = (row.stage, NUMBER.sub("\0", row.reason))
                groups.setdefault(key, []).append((shape, surface, row))
            elif row.attempts > 1:
                retried.add(shape)
    failed = {shape for rows in groups.values() for shape, _, _ in rows}
    described = [_described(stage, rows) for (stage, _), rows in groups.items()]
    described.sort(key=lambda group: (-group.shapes, group.stage, group.reason))
    return Failures(len(shapes), len(failed), len(retried), tuple(described))


def _described(stage: str, rows: Sequence[tuple[Shape, str, Status]]) -> FailureGroup:
    ids = sorted({shape for shape, _, _ in rows})
    return FailureGroup(
        stage,
        without_absolute_paths(_common_reason([row.reason for _, _, row in rows])),
        tuple(sorted({surface_name(surface) for _, surface, _ in rows if surface}, key=str.lower)),
        len(ids),
        tuple(name for _, _, name in ids[:EXAMPLES]),
    )


def _common_reason(reasons: Sequence[str]) -> str:
    """Return the reason with the numbers that all share, and an ellipsis for each other one."""
    numbers = list(zip(*(NUMBER.findall(reason) for reason in reasons), strict=True))
    shown = iter([each[0] if len(set(each)) == 1 else VARYING for each in numbers])
    return NUMBER.sub(lambda _: next(shown), reasons[0])
