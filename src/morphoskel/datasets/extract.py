"""Unpack an archive without trusting the names in it."""

from __future__ import annotations

import gzip
import lzma
import shutil
import stat
import tarfile
import zipfile
import zlib
from pathlib import Path, PurePosixPath, PureWindowsPath

from morphoskel.atomic import atomic_folder
from morphoskel.errors import DatasetError

_BLOCK = 1 << 20
_DAMAGE = (zipfile.BadZipFile, tarfile.TarError, gzip.BadGzipFile, EOFError, zlib.error, lzma.LZMAError)


def extract(archive: Path, target: Path) -> None:
    """Unpack a zip or (compressed) tar archive into the folder `target`.

    If everything in the archive lies in one folder, that folder's content becomes the content of `target`.

    Parameters
    ----------
    archive
        The file; its kind is told by its content.
    target
        Must not exist yet, or be empty. Appears only when all is unpacked.

    Raises
    ------
    DatasetError
        If the archive is damaged, of another kind, or has a member that would leave `target` (an absolute name, a
        ``..``, a link to elsewhere, a device); or if `target` holds something.
    """
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise DatasetError(f"{target}: exists already; remove it to have {archive.name} unpacked again")
    if not archive.is_file():
        raise DatasetError(f"{archive}: the archive does not exist; fetch it first")
    with atomic_folder(target) as partial:
        try:
            if zipfile.is_zipfile(archive):
                _extract_zip(archive, partial)
            elif tarfile.is_tarfile(archive):
                _extract_tar(archive, partial)
            else:
                raise DatasetError(f"{archive}: expected a zip or tar.gz archive; it is damaged, fetch it again")
        except tarfile.FilterError as error:
            raise DatasetError(f"{archive}: {error}; do not trust this archive") from error
        except DatasetError:
            raise
        except _DAMAGE as error:
            raise DatasetError(f"{archive}: cannot be unpacked ({error}); fetch it again") from error
        except OSError as error:
            raise DatasetError(f"{archive}: cannot be unpacked into {target} ({error}); check the disk") from error
        except Exception as error:  # of damaged data all sorts of errors, of a missing password RuntimeError
            raise DatasetError(f"{archive}: cannot be unpacked ({error}); fetch it again") from error
        _unwrap(partial)


def _extract_zip(archive: Path, folder: Path) -> None:
    with zipfile.ZipFile(archive) as opened:
        for member in opened.infolist():
            _check_name(archive, member.filename)
            if stat.S_ISLNK(member.external_attr >> 16):
                raise DatasetError(f"{archive}: member {member.filename!r} is a link, which is not unpacked")
        opened.extractall(folder)


def _extract_tar(archive: Path, folder: Path) -> None:
    with tarfile.open(archive) as opened:
        for member in opened.getmembers():
            _check_name(archive, member.name)
        _check_end(archive, opened)
        # The filter refuses devices and links that lead outside, and drops owners and unusual permissions.
        opened.extractall(folder, filter="data")


def _check_name(archive: Path, name: str) -> None:
    """Raise if a member's name, on any system, could lead out of the folder it is unpacked into."""
    for path in (PurePosixPath(name), PureWindowsPath(name)):
        if path.is_absolute() or path.drive or path.root or ".." in path.parts:
            raise DatasetError(
                f"{archive}: member {name!r} would be written outside of the target folder; do not trust this archive"
            )


def _check_end(archive: Path, opened: tarfile.TarFile) -> None:
    """Raise unless the tar ends as it must: the standard library takes a tar cut between two members for whole."""
    stream = opened.fileobj
    if stream is None:
        raise DatasetError(f"{archive}: cannot be unpacked (it is closed); fetch it again")
    stream.seek(opened.offset)
    if stream.read(tarfile.BLOCKSIZE) != bytes(tarfile.BLOCKSIZE):
        raise DatasetError(f"{archive}: cannot be unpacked (it is truncated); fetch it again")
    while stream.read(_BLOCK):  # up to the checksum at the very end of the compressed data
        pass


def _unwrap(folder: Path) -> None:
    """Replace `folder` by the folder in it, if there is nothing else in it."""
    children = list(folder.iterdir())
    if len(children) == 1 and children[0].is_dir() and not children[0].is_symlink():
        lifted = folder.with_name(f"{folder.name}.inner")
        shutil.rmtree(lifted, ignore_errors=True)
        children[0].rename(lifted)
        folder.rmdir()
        lifted.rename(folder)
