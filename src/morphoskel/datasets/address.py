"""Addresses that archives may be fetched from."""

from __future__ import annotations

import re
from typing import Annotated
from urllib.parse import unquote, urlsplit

from pydantic import AfterValidator


def check_address(url: str) -> str:
    """Return an address, or refuse it.

    Raises
    ------
    ValueError
        If it is not HTTP(S), or holds a user name or password: those would be kept in configurations and logs, which
        are passed on. The message does not repeat them.
    """
    try:
        parts = urlsplit(url)
        host, _ = parts.hostname, parts.port
    except ValueError as error:
        raise ValueError(f"no address ({error}); expected http://... or https://...") from error
    if "@" in parts.netloc:
        raise ValueError(
            f"the address of {host} holds a user name or password, which would be kept in the results and logs; fetch "
            "the archive by hand and unpack it into dataset.root"
        )
    if parts.scheme not in ("http", "https") or not host:
        raise ValueError(f"{url}: only addresses http://... and https://... can be fetched")
    return url


Address = Annotated[str, AfterValidator(check_address)]
"""An address in the configuration."""


def archive_name(url: str) -> str:
    """Return a name for the file behind an address: the last part of its path, as far as it is safe as a name."""
    last = unquote(urlsplit(url).path).rsplit("/", 1)[-1]
    return re.sub(r"[^A-Za-z0-9._-]", "_", last).lstrip(".-")[-200:] or "archive"
