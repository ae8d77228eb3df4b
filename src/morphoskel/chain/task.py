"""What a stage of the chain receives for one shape."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from morphoskel.checksums import intact
from morphoskel.datasets.manifest import ShapeRecord


@dataclass(frozen=True)
class Task:
    """One stage of one shape.

    Parameters
    ----------
    record
        The shape's row of the manifest.
    inputs
        Folder of each earlier stage that this one reads, by the stage's name; files in it are named by shape.
    output
        Folder to write the shape's file to.
    settings
        The configuration sections of the stage.
    seed
        Derived from the global seed, the shape's id and the stage.
    threads
        Threads that the stage may use for this shape.
    """

    record: ShapeRecord
    inputs: Mapping[str, Path]
    output: Path
    settings: Mapping[str, Any]
    seed: int
    threads: int = 1

    def read(self, stage: str, suffix: str) -> Path:
        """Return the file that `stage` wrote for this shape.

        Raises
        ------
        StorageError
            If it is damaged.
        """
        return intact(self.inputs[stage] / f"{self.record.id}{suffix}")

    def write(self, suffix: str) -> Path:
        """Return the file that this stage has to write."""
        return self.output / f"{self.record.id}{suffix}"


Details = dict[str, int | float | str]
"""What a stage records about a shape beside its file, for example how many candidates lie inside."""
