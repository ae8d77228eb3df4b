"""Overrides whose value is a path, taken as it is written although Hydra's grammar would read it otherwise."""

from __future__ import annotations

import re
import types
import typing
from collections.abc import Sequence
from pathlib import Path
from typing import Any

_OVERRIDE = re.compile(r"(\+{0,2}[\w.]+)=(.*)", re.DOTALL)


def quote_paths(overrides: Sequence[str]) -> list[str]:
    """Return the overrides with quotes around each path that Hydra's grammar would not read as the same text.

    Spaces, commas, quotes, brackets, accents and leading signs are legal in names of files; to Hydra they mean
    something else or nothing. What is quoted already stays so, and ``null`` and ``${...}`` keep their meaning.

    Parameters
    ----------
    overrides
        As a user writes them, for example ``dataset.root=/data/my scans (2024)``.
    """
    return [_quoted(str(text)) for text in overrides]


def _quoted(text: str) -> str:
    found = _OVERRIDE.fullmatch(text)
    if not found or not _holds_path(found[1].lstrip("+")):
        return text
    key, value = found[1], found[2]
    if value in ("", "null") or _parsed(text) == value or (value[0] in "'\"" and _parsed(text) is not None):
        return text
    escaped = re.sub(r"(\\*)('|$)", lambda match: match[1] * 2 + ("\\'" if match[2] else ""), value)
    return f"{key}='{escaped}'"


def _parsed(text: str) -> str | None:
    """Return the text that Hydra reads as the value, if it reads a text."""
    from hydra.core.override_parser.overrides_parser import OverridesParser
    from hydra.errors import HydraException

    try:
        value = OverridesParser.create().parse_override(text).value()
    except HydraException:
        return None
    return value if isinstance(value, str) else None


def _holds_path(key: str) -> bool:
    """Tell whether a dotted key of the schema is annotated as a path."""
    from morphoskel.config.explain import fields_at

    return any(_admits_path(field.annotation) for field in fields_at(key.split(".")))


def _admits_path(annotation: Any) -> bool:
    if typing.get_origin(annotation) in (typing.Union, types.UnionType, typing.Annotated):
        return any(_admits_path(part) for part in typing.get_args(annotation))
    return annotation is Path
