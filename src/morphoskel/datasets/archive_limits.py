"""How much an archive may become when it is unpacked."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

from morphoskel.errors import DatasetError


@dataclass(frozen=True)
class ArchiveLimits:
    """Bounds that published data sets keep by far, and archives made to fill a disk do not.

    Parameters
    ----------
    members
        Files and folders, at most, those counted too that only the names of others imply.
    growth
        Unpacked bytes for each byte of the archive, at most; clouds as text grow four- to sixfold.
    floor
        Bytes that are granted to the smallest archive.
    """

    members: int = 200_000
    growth: int = 50
    floor: int = 1 << 26


class UnpackingBudget:
    """Counts what one archive becomes, and refuses more than its limits.

    Parameters
    ----------
    archive
        The file.
    folder
        Where it is unpacked: not more than is free there.
    limits
        The bounds.
    """

    def __init__(self, archive: Path, folder: Path, limits: ArchiveLimits) -> None:
        self.archive = archive
        self.limits = limits
        self.growth_bytes = max(limits.floor, limits.growth * archive.stat().st_size)
        self.free_bytes = shutil.disk_usage(folder).free
        self._declared = 0
        self._written = 0

    def announce(self, size: int) -> None:
        """Count a member of `size` bytes before anything of it is unpacked.

        Raises
        ------
        DatasetError
            If too many bytes are declared in all.
        """
        self._declared += size
        self.check(self._declared)

    def write(self, size: int) -> None:
        """Count `size` bytes before they are written, whatever the archive declared.

        Raises
        ------
        DatasetError
            If they are too many.
        """
        self._written += size
        self.check(self._written)

    def check(self, total: int) -> None:
        """Raise if `total` unpacked bytes are more than allowed, or than the disk has room for."""
        if total > self.growth_bytes:
            raise DatasetError(
                f"{self.archive}: would become more than {self.growth_bytes} bytes, which is more than "
                f"{self.limits.growth} times its size; do not trust this archive"
            )
        if total > self.free_bytes:
            raise DatasetError(
                f"{self.archive}: would become more than the {self.free_bytes} bytes that are free on the disk; make "
                "room, or unpack it elsewhere and set dataset.root"
            )
