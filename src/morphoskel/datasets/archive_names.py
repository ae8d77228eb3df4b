"""Names in an archive, which may try to lead elsewhere or to replace one another."""

from __future__ import annotations

import unicodedata
from pathlib import Path, PurePosixPath, PureWindowsPath

from morphoskel.errors import DatasetError

LONGEST_NAME = 1024
"""Characters of a member's name, at most."""


class MemberNames:
    """The members of one archive that were seen so far.

    Parameters
    ----------
    archive
        The file, named in errors.
    most
        Number of files and folders, at most, also of those that only the names of others imply.
    """

    def __init__(self, archive: Path, most: int) -> None:
        self.archive = archive
        self.most = most
        self._spelling: dict[str, PurePosixPath] = {}
        self._files: set[str] = set()

    def accept(self, name: str, *, is_folder: bool) -> PurePosixPath:
        """Return the place of a member below the folder that the archive is unpacked into.

        Names that differ only in case, or in how an accent is encoded, are one file on some systems; they are refused
        on all, so that an archive gives the same files everywhere.

        Parameters
        ----------
        name
            As the archive spells it.
        is_folder
            Whether the member is a folder; folders may be listed several times.

        Raises
        ------
        DatasetError
            If the name could lead out of that folder on any system, is empty, too long or holds a control character,
            if the member would take the place of another, or if there are too many.
        """
        place = PurePosixPath(name)
        self._check(name, place, is_folder)
        for path in [*reversed(place.parents[:-1]), *([place] if place.parts else [])]:
            is_file = path == place and not is_folder
            key = unicodedata.normalize("NFC", str(path)).casefold()
            other = self._spelling.setdefault(key, path)
            if other != path or key in self._files or (is_file and other is not path):
                raise DatasetError(
                    f"{self.archive}: members {str(other)!r} and {name!r} would take the same place; do not trust "
                    "this archive"
                )
            if is_file:
                self._files.add(key)
            if len(self._spelling) > self.most:
                raise DatasetError(f"{self.archive}: holds more than {self.most} members; do not trust this archive")
        return place

    def _check(self, name: str, place: PurePosixPath, is_folder: bool) -> None:
        for path in (place, PureWindowsPath(name)):
            if path.is_absolute() or path.drive or path.root or ".." in path.parts:
                raise DatasetError(
                    f"{self.archive}: member {name!r} would be written outside of the target folder; do not trust "
                    "this archive"
                )
        unwritable = any(unicodedata.category(letter) in ("Cc", "Cs") for letter in name)
        if len(name) > LONGEST_NAME or unwritable or not (place.parts or is_folder):
            raise DatasetError(
                f"{self.archive}: member {name[:80]!r} has an impossible name: expected up to {LONGEST_NAME} "
                "characters, none of them a control character; do not trust this archive"
            )
