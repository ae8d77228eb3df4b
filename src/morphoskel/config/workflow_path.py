"""Paths that Snakemake can handle."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator

from morphoskel.errors import ConfigError

_PLACEHOLDERS = re.compile(r"[{}<>\n\r]")


def check_workflow_path(path: Path) -> Path:
    """Return a path that the workflow reads or writes, or refuse it.

    Snakemake replaces ``{...}`` and ``<...>`` in the paths of its rules, and keeps one path a line.

    Raises
    ------
    ValueError
        If the path holds one of these characters.
    """
    if found := _PLACEHOLDERS.search(str(path)):
        raise ValueError(
            f"Snakemake cannot handle the character {found.group()!r} in a path; rename the folder or file, or make a "
            "link to it under another name"
        )
    return path


WorkflowPath = Annotated[Path, AfterValidator(check_workflow_path)]
"""A path of the configuration that is an input or output of rules."""


def check_clone_path(folder: Path) -> None:
    """Refuse a clone of the repository from which the workflow cannot run.

    Raises
    ------
    ConfigError
        If its path holds what Snakemake replaces in paths, or the sign that separates the folders of ``PYTHONPATH``.
    """
    try:
        check_workflow_path(folder)
    except ValueError as error:
        raise ConfigError(f"{folder}: {error}") from error
    if os.pathsep in str(folder):
        raise ConfigError(
            f"{folder}: the folder of the clone cannot have {os.pathsep!r} in its path, which separates the folders "
            "that Python imports from; rename it, or make a clone elsewhere"
        )
