"""What data a run was made of: the splits of its manifests with their checksums."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from morphoskel.datasets.manifest import ShapeRecord, read_manifest


@dataclass(frozen=True)
class DataSplit:
    """A split of a data set.

    Parameters
    ----------
    dataset, split
        Their names.
    shapes, categories
        Numbers of them.
    sha256
        Over the shapes' own checksums, in the order of the manifest, one a line.
    """

    dataset: str
    split: str
    shapes: int
    categories: int
    sha256: str


def describe_manifest(path: Path) -> list[DataSplit]:
    """Return the splits of a manifest, in order of appearance.

    Parameters
    ----------
    path
        ``{dataset}.csv``.

    Raises
    ------
    DatasetError
        If it is absent or no manifest.
    """
    splits: dict[str, list[ShapeRecord]] = {}
    for record in read_manifest(path):
        splits.setdefault(record.split, []).append(record)
    return [
        DataSplit(
            path.stem,
            split,
            len(records),
            len({record.category for record in records}),
            hashlib.sha256("".join(f"{record.sha256}\n" for record in records).encode()).hexdigest(),
        )
        for split, records in splits.items()
    ]
