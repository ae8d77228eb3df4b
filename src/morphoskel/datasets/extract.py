"""Unpack an archive without trusting anything that it says of itself."""

from __future__ import annotations

import gzip
import io
import shutil
import stat
import struct
import tarfile
import zipfile
import zlib
from pathlib import Path
from typing import IO

from morphoskel.atomic import atomic_folder
from morphoskel.datasets.archive_limits import ArchiveLimits, UnpackingBudget
from morphoskel.datasets.archive_names import MemberNames
from morphoskel.errors import DatasetError
from morphoskel.progress import track

_BLOCK = 1 << 20
_DAMAGE = (zipfile.BadZipFile, tarfile.TarError, gzip.BadGzipFile, EOFError, zlib.error, ValueError, OverflowError)
_COMPRESSIONS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)  # of others, zipfile unpacks a block of any size at once
_END_OF_ZIP = b"PK\x05\x06"
_LISTING_ENTRY = 46  # bytes of a member in a zip's listing, without its name


def extract(archive: Path, target: Path, *, limits: ArchiveLimits | None = None) -> None:
    """Unpack a zip, tar or tar.gz archive into the folder `target`.

    If everything in the archive lies in one folder, that folder's content becomes the content of `target`. Only files
    and folders are unpacked, with the usual permissions of new files.

    Parameters
    ----------
    archive
        The file; its kind is told by its content.
    target
        Must not exist yet, or be empty. Appears only when all is unpacked.
    limits
        What the archive may become at most; by default :class:`~morphoskel.datasets.archive_limits.ArchiveLimits`.

    Raises
    ------
    DatasetError
        If the archive is damaged, of another kind, would become more than its limits, or has a member that would leave
        `target` (an absolute name, a ``..``), take the place of another, or is a link or a device; or if `target` holds
        something.
    """
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise DatasetError(f"{target}: exists already; remove it to have {archive.name} unpacked again")
    if not archive.is_file():
        raise DatasetError(f"{archive}: the archive does not exist; fetch it first")
    with atomic_folder(target) as partial:
        destination = _Destination(archive, partial, limits or ArchiveLimits())
        try:
            if zipfile.is_zipfile(archive):
                _extract_zip(archive, destination)
            else:
                _extract_tar(archive, destination)
        except DatasetError:
            raise
        except _DAMAGE as error:
            raise DatasetError(f"{archive}: cannot be unpacked ({error}); fetch it again") from error
        except OSError as error:
            raise DatasetError(f"{archive}: cannot be unpacked into {target} ({error}); check the disk") from error
        except Exception as error:  # of damaged data all sorts of errors, of a missing password RuntimeError
            raise DatasetError(f"{archive}: cannot be unpacked ({error}); fetch it again") from error
        _unwrap(partial)


class _Destination:
    """The folder that an archive is unpacked into, which accepts neither unsafe names nor too many bytes."""

    def __init__(self, archive: Path, folder: Path, limits: ArchiveLimits) -> None:
        self.archive = archive
        self.folder = folder
        self.budget = UnpackingBudget(archive, folder, limits)
        self.names = MemberNames(archive, limits.members)

    def add_folder(self, name: str) -> None:
        (self.folder / self.names.accept(name, is_folder=True)).mkdir(parents=True, exist_ok=True)

    def add_file(self, name: str, size: int, content: IO[bytes]) -> None:
        path = self.folder / self.names.accept(name, is_folder=False)
        path.parent.mkdir(parents=True, exist_ok=True)
        written = 0
        with path.open("xb") as stream:
            while block := content.read(_BLOCK):
                self.budget.write(len(block))
                written += stream.write(block)
        if written != size:
            raise EOFError(f"{name!r} has {written} bytes instead of {size}")


def _extract_zip(archive: Path, destination: _Destination) -> None:
    if _listing_bytes(archive) > destination.budget.limits.members * (_LISTING_ENTRY + 200):
        raise DatasetError(f"{archive}: lists too many members to be read; do not trust this archive")
    with zipfile.ZipFile(archive) as opened:
        for member in track(opened.infolist(), f"unpack {archive.name}", unit="file"):
            kind = stat.S_IFMT(member.external_attr >> 16)
            if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
                raise DatasetError(_unusual(archive, member.filename))
            if member.compress_type not in _COMPRESSIONS:
                raise zipfile.BadZipFile(f"{member.filename!r} is neither stored nor deflated")
            if member.is_dir():
                destination.add_folder(member.filename)
                continue
            destination.budget.announce(member.file_size)
            with opened.open(member) as content:
                destination.add_file(member.filename, member.file_size, content)


def _extract_tar(archive: Path, destination: _Destination) -> None:
    with archive.open("rb") as raw:
        is_gzip = raw.read(2) == b"\x1f\x8b"
    with gzip.open(archive) if is_gzip else archive.open("rb") as stream:
        guarded = _GuardedReader(stream, destination.budget)
        try:
            opened = tarfile.TarFile(fileobj=guarded)
        except tarfile.ReadError as error:
            raise DatasetError(
                f"{archive}: expected a zip, tar or tar.gz archive ({error}). If it was downloaded, it is damaged: "
                "fetch it again; another kind of archive has to be unpacked by hand"
            ) from error
        with opened:
            for member in track(opened, f"unpack {archive.name}", unit="file"):
                if member.isdir():
                    destination.add_folder(member.name)
                    continue
                content = opened.extractfile(member) if member.isreg() else None
                if content is None:
                    raise DatasetError(_unusual(archive, member.name))
                destination.budget.announce(member.size)
                destination.add_file(member.name, member.size, content)
            _check_end(guarded, opened.offset)


class _GuardedReader(io.RawIOBase):
    """A decompressed stream that is not read beyond a budget; tarfile would take a header of any length into memory."""

    def __init__(self, stream: io.BufferedIOBase, budget: UnpackingBudget) -> None:
        self.stream = stream
        self.budget = budget

    def read(self, size: int = -1, /) -> bytes:
        if not 0 <= size <= _BLOCK:
            raise tarfile.ReadError(f"a header of {size} bytes")
        data = self.stream.read(size)
        self.budget.check(self.stream.tell())
        return data

    def seek(self, offset: int, whence: int = io.SEEK_SET, /) -> int:
        self.budget.check(offset)
        return self.stream.seek(offset, whence)

    def tell(self) -> int:
        return self.stream.tell()


def _check_end(stream: _GuardedReader, offset: int) -> None:
    """Raise unless the tar ends as it must: the standard library takes a tar cut between two members for whole."""
    stream.seek(offset)
    if stream.read(tarfile.BLOCKSIZE) != bytes(tarfile.BLOCKSIZE):
        raise tarfile.ReadError("it is truncated")
    while stream.read(_BLOCK):  # up to the checksum at the very end of the compressed data
        pass


def _listing_bytes(archive: Path) -> int:
    """Return the length of a zip's listing, which zipfile takes into memory as a whole, several times as large."""
    with archive.open("rb") as stream:
        stream.seek(max(archive.stat().st_size - (1 << 16) - 200, 0))
        tail = stream.read()
    without_comment = tail[-22:-18] == _END_OF_ZIP and tail.endswith(b"\0\0")
    end = len(tail) - 22 if without_comment else tail.rfind(_END_OF_ZIP)  # where zipfile finds it, too
    if not 0 <= end <= len(tail) - 22:
        raise zipfile.BadZipFile("its end is damaged")
    of_large = end - 76  # the record of archives beyond 4 GiB and its locator, 56 and 20 bytes, come just before
    if of_large >= 0 and tail.startswith(b"PK\x06\x06", of_large):
        return int(struct.unpack_from("<Q", tail, of_large + 40)[0])
    return int(struct.unpack_from("<I", tail, end + 12)[0])


def _unusual(archive: Path, name: str) -> str:
    return (
        f"{archive}: member {name!r} is neither a file nor a folder, but a link or a device; do not trust this archive"
    )


def _unwrap(folder: Path) -> None:
    """Replace `folder` by the folder in it, if there is nothing else in it."""
    children = list(folder.iterdir())
    if len(children) == 1 and children[0].is_dir():
        lifted = folder.with_name(f"{folder.name}.inner")
        shutil.rmtree(lifted, ignore_errors=True)
        children[0].rename(lifted)
        folder.rmdir()
        lifted.rename(folder)
