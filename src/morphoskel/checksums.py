"""Checksums of what one job leaves for the next, so that a damaged file is never taken for a whole one.

They stand in files that ``sha256sum --check`` understands: ``SHA256SUMS`` in the folder of a shard, and
``NAME.sha256`` beside a file that has no folder of its own. Files that carry checksums in themselves (NPZ and networks,
both ZIP archives) need neither.
"""

from __future__ import annotations

import hashlib
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from morphoskel.atomic import atomic_file
from morphoskel.errors import StorageError

LIST = "SHA256SUMS"
"""Name of the list in a folder."""

MEND = "remove {} and run again: it is made anew, and so is what was made from it"


def write_checksums(folder: Path) -> None:
    """Write the list of all files in `folder`, not of those in folders below."""
    names = sorted(path.name for path in folder.iterdir() if path.is_file() and path.name != LIST)
    (folder / LIST).write_text("".join(_line(folder / name, name) for name in names), encoding="utf-8")


@contextmanager
def checked_file(path: Path) -> Iterator[Path]:
    """Write `path` whole or not at all, like :func:`~morphoskel.atomic.atomic_file`, with its checksum beside it."""
    with atomic_file(path) as partial:
        yield partial
        with atomic_file(_beside(path)) as listed:
            listed.write_text(_line(partial, path.name), encoding="utf-8")


def intact(path: Path) -> Path:
    """Return `path` after a look at its checksum.

    Parameters
    ----------
    path
        A file. Where neither a checksum lies beside it nor its folder has a list, no job of ours wrote it, and there is
        nothing to check.

    Raises
    ------
    StorageError
        If the file is missing, cannot be read, or is not what was written.
    """
    listing, culprit = (_beside(path), path) if _beside(path).exists() else (path.parent / LIST, path.parent)
    if not listing.exists():
        return path
    try:
        lines = listing.read_bytes().decode(errors="replace").splitlines()
        expected = [line.partition("  ")[0] for line in lines if line.partition("  ")[2] == path.name]
        found = _digest(path)
    except OSError as error:
        raise StorageError(f"{path}: cannot be read ({error.strerror}); {MEND.format(culprit)}") from error
    if expected != [found]:
        told = f"{listing.name} says {expected[0][:12]}…" if expected else f"{listing.name} does not know the file"
        raise StorageError(f"{path}: is damaged (its SHA-256 is {found[:12]}…, {told}); {MEND.format(culprit)}")
    return path


def intact_archive(path: Path) -> Path:
    """Return the path of a ZIP archive after a look at the checksums of its members.

    NumPy and zipfile look at them on reading, PyTorch does not.

    Raises
    ------
    StorageError
        If the file is not an archive, or a member is damaged.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            damaged = archive.testzip()
    except FileNotFoundError:
        raise
    except (OSError, EOFError, ValueError, RuntimeError, zipfile.BadZipFile, zlib.error) as error:
        raise StorageError(f"{path}: is damaged ({error}); {MEND.format(path)}") from error
    if damaged is not None:
        raise StorageError(f"{path}: is damaged (checksum of {damaged}); {MEND.format(path)}")
    return path


def _beside(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _line(path: Path, name: str) -> str:
    return f"{_digest(path)}  {name}\n"


def _digest(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
