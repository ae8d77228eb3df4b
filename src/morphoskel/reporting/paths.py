"""Turn the names of files that a rule hands over into paths."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any


def as_paths(files: Any) -> Any:
    """Return the same strings, lists and mappings of strings with a path in the place of each string.

    Parameters
    ----------
    files
        A string, ``None``, which stays, or lists and mappings of them, nested as one likes.
    """
    if isinstance(files, Mapping):
        return {name: as_paths(file) for name, file in files.items()}
    if files is None or isinstance(files, str):
        return files and Path(files)
    return [as_paths(file) for file in files]
