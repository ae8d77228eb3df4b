"""Keep out of a page that is passed on what it would tell of a machine and its user: absolute paths."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath, PureWindowsPath
from typing import Any

ELSEWHERE = "…"
"""Stands for the folders of an absolute path."""

_WORD = r"[^\s/\\:;,'\"`()\[\]{}<>|]+"
_ADDRESS = r"(?P<address>(?:https?|ftp)://[^\s'\"<>]+)"
_PATH = rf"(?P<path>(?<![\w.…/\\-])(?:file://|~[\w.-]*|[A-Za-z]:)?(?:[/\\]+{_WORD})+)"
_FOUND = re.compile(f"{_ADDRESS}|{_PATH}")


def without_absolute_paths(text: str) -> str:
    """Return `text` with ``…/name`` in the place of every absolute path, and web addresses without what may be secret.

    Of addresses, user names and queries are left out.

    Examples
    --------
    >>> without_absolute_paths("/home/ada/shapes/chair.ply: no points; see https://ada:key@example.org/help")
    '…/chair.ply: no points; see https://example.org/help'
    """
    return _FOUND.sub(_masked, text)


def mask_values(values: Any) -> Any:
    """Return plain values with ``…/name`` for every text that is an absolute path, in lists and mappings too."""
    if isinstance(values, Mapping):
        return {mask_values(key): mask_values(value) for key, value in values.items()}
    if isinstance(values, str):
        return _ending(values) if _is_absolute(values) else without_absolute_paths(values)
    if isinstance(values, Sequence):
        return [mask_values(value) for value in values]
    return values


def _masked(match: re.Match[str]) -> str:
    if match["address"]:
        return re.sub(r"\?.*", f"?{ELSEWHERE}", re.sub(r"//[^/@]*@", "//", match["address"]))
    return _ending(match["path"])


def _is_absolute(text: str) -> bool:
    """Whether the whole text is a path, which may then hold spaces."""
    return text.startswith(("/", "~")) or PureWindowsPath(text).is_absolute()


def _ending(path: str) -> str:
    name = PureWindowsPath(path).name if "\\" in path else PurePosixPath(path).name
    return f"{ELSEWHERE}/{name}"
