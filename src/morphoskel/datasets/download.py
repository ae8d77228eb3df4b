"""Fetch a data set's archive so that an interruption costs little; :func:`extract` unpacks it."""

from __future__ import annotations

import http.client
import logging
import re
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import IO, TYPE_CHECKING

from morphoskel.datasets.address import check_address
from morphoskel.datasets.extract import extract
from morphoskel.datasets.manifest import checksum
from morphoskel.errors import DatasetError
from morphoskel.progress import count_up

if TYPE_CHECKING:
    from http.client import HTTPMessage

__all__ = ["download", "extract"]

LARGEST = 1 << 37
"""Bytes of an archive, at most: a hundred times the largest of the data sets."""

_BLOCK = 1 << 18
_TIMEOUT = 60.0  # seconds without a byte before the connection counts as dropped
_WORTH_A_RETRY = {408, 425, 429, 500, 502, 503, 504}
_LOGGER = logging.getLogger(__name__)


class _Dropped(Exception):  # noqa: N818 - never leaves this module
    """The connection ended before the file did."""


def download(
    url: str,
    target: Path,
    *,
    sha256: str | None,
    progress: bool = True,
    attempts: int = 6,
    backoff: float = 1.0,
    largest: int = LARGEST,
) -> None:
    """Fetch `url` into `target`, and go on where an earlier attempt stopped.

    The data grow in ``<target>.partial`` and get their name only when the checksum is right.

    Parameters
    ----------
    url
        HTTP or HTTPS address.
    target
        File to write; nothing is fetched if it is there already with the right checksum.
    sha256
        Expected checksum, 64 hexadecimal digits. With ``None`` the file is fetched into ``<target>.unverified``, and
        the error tells the checksum to confirm; once it is set, the file is used without a new transfer.
    progress
        Show a progress bar.
    attempts
        How often to try in a row without receiving a single byte.
    backoff
        Pause before the second attempt in seconds; doubles with each further one.
    largest
        Bytes that are taken, at most; a server could send without end.

    Raises
    ------
    DatasetError
        If the address is not HTTP(S) or holds a password, the server refuses, sends too much or leads from HTTPS to
        HTTP, the connection keeps dropping, or the checksum is not confirmed or wrong; after a wrong checksum nothing
        is kept.
    """
    _check_arguments(url, sha256)
    expected = sha256.lower() if sha256 else None
    unverified = target.with_name(f"{target.name}.unverified")
    if target.is_file() and expected:
        _require_sum(
            target,
            checksum(target, progress=progress),
            expected,
            "delete the file to fetch it again, or correct sha256",
        )
        return
    if not unverified.is_file():
        partial = target.with_name(f"{target.name}.partial")
        target.parent.mkdir(parents=True, exist_ok=True)
        _fetch(url, partial, progress=progress, attempts=attempts, backoff=backoff, largest=largest)
        partial.replace(unverified)
    found = checksum(unverified, progress=progress)
    if expected is None:
        raise DatasetError(
            f"{unverified}: fetched from {url}, but no checksum is configured to compare it with. Its sha256 is "
            f"{found}. If you trust this file, set dataset.sha256 to this value and run again; nothing is fetched anew"
        )
    if found != expected:
        unverified.unlink()
    _require_sum(target, found, expected, f"the file was not kept. Try again; if it stays so, {url} has changed")
    unverified.replace(target)


def _check_arguments(url: str, sha256: str | None) -> None:
    """Refuse what cannot be fetched or compared."""
    try:
        check_address(url)
    except ValueError as error:
        raise DatasetError(str(error)) from error
    if sha256 is not None and not re.fullmatch(r"[0-9a-fA-F]{64}", sha256):
        raise DatasetError(f"sha256 of {url}: expected 64 hexadecimal digits, got {sha256!r}")


def _require_sum(path: Path, found: str, expected: str, mend: str) -> None:
    """Raise unless the checksums agree."""
    if found != expected:
        raise DatasetError(f"{path}: expected sha256 {expected}, found {found}; {mend}")


def _fetch(url: str, partial: Path, *, progress: bool, attempts: int, backoff: float, largest: int) -> None:
    """Let `partial` grow until it is whole; a failure counts only if not even one byte came."""
    failures = 0
    while True:
        before = _size(partial)
        try:
            _transfer(url, partial, progress, largest)
        except urllib.error.HTTPError as error:
            reason, fatal = f"HTTP {error.code} {error.reason}", error.code not in _WORTH_A_RETRY
            error.close()
        except (OSError, http.client.HTTPException, _Dropped) as error:
            reason, fatal = str(getattr(error, "reason", "") or error) or type(error).__name__, False
        else:
            return
        failures = 0 if _size(partial) > before else failures + 1
        if fatal or failures >= attempts:
            kept = f"; {_size(partial)} bytes are kept in {partial}, another run goes on from there"
            raise DatasetError(
                f"{url}: cannot be fetched ({reason}). Check the address and the connection, or fetch it by hand"
                f"{kept if _size(partial) else ''}"
            )
        _LOGGER.warning("%s: %s after %d bytes, trying again", url, reason, _size(partial))
        time.sleep(backoff * 2 ** max(failures - 1, 0))


def _transfer(url: str, partial: Path, progress: bool, largest: int) -> None:
    """Append to `partial` what it lacks, up to `largest` bytes in all."""
    have = _size(partial)
    request = urllib.request.Request(url, headers={"Range": f"bytes={have}-"} if have else {})
    try:
        response = _opener().open(request, timeout=_TIMEOUT)
    except urllib.error.HTTPError as error:
        if error.code != 416 or not have:
            raise
        error.close()
        if error.headers.get("Content-Range") == f"bytes */{have}":
            return  # everything had arrived before
        partial.unlink()
        raise _Dropped("the server's file has become shorter") from error
    with response:
        if response.status == 206 and not response.headers.get("Content-Range", "").startswith(f"bytes {have}-"):
            partial.unlink()
            raise _Dropped("the server sent another part than asked for")
        resumed = response.status == 206
        have = have if resumed else 0  # a server without ranges sends all from the beginning
        total = None if response.length is None else have + response.length
        with partial.open("ab" if resumed else "wb") as stream, _counter(partial, have, total, progress) as advance:
            while block := response.read(_BLOCK):
                stream.write(block)
                advance(len(block))
                if stream.tell() > largest:
                    break
    if _size(partial) > largest:
        partial.unlink()
        raise DatasetError(f"{url}: the server sends more than {largest} bytes; fetch it by hand if it is right")
    if total is not None and _size(partial) < total:
        raise _Dropped(f"the connection ended at {_size(partial)} of {total} bytes")


class _Redirections(urllib.request.HTTPRedirectHandler):
    """Follow redirections, but not from HTTPS to HTTP."""

    def redirect_request(
        self, req: urllib.request.Request, fp: IO[bytes], code: int, msg: str, headers: HTTPMessage, newurl: str
    ) -> urllib.request.Request | None:
        if req.type == "https" and not newurl.lower().startswith("https:"):
            raise urllib.error.HTTPError(newurl, code, "the redirection leaves HTTPS", headers, fp)
        return super().redirect_request(req, fp, code, msg, headers, newurl)


def _opener() -> urllib.request.OpenerDirector:
    """Return an opener that knows HTTP(S) only, so that a redirection cannot lead to other schemes."""
    opener = urllib.request.OpenerDirector()
    for handler in (
        urllib.request.ProxyHandler(),
        urllib.request.HTTPHandler(),
        urllib.request.HTTPSHandler(),
        _Redirections(),
        urllib.request.HTTPDefaultErrorHandler(),
        urllib.request.HTTPErrorProcessor(),
        urllib.request.UnknownHandler(),
    ):
        opener.add_handler(handler)
    return opener


def _size(path: Path) -> int:
    return path.stat().st_size if path.is_file() else 0


def _counter(
    partial: Path, have: int, total: int | None, progress: bool
) -> AbstractContextManager[Callable[[int], None]]:
    name = partial.name.removesuffix(".partial")
    return count_up(f"fetch {name}", unit="B", total=total, start=have, show=progress)
