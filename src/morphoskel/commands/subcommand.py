"""What the parsers of all subcommands have in common."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias

from morphoskel.errors import InputError

Subcommands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def add_subcommand(commands: Subcommands, name: str, summary: str, examples: str) -> argparse.ArgumentParser:
    """Add a subcommand whose help ends with examples, and return its parser.

    Parameters
    ----------
    commands
        The subcommands of ``morphoskel``.
    name
        Of the subcommand.
    summary
        What it does, as a phrase that begins with a small letter.
    examples
        Printed as they are.
    """
    return commands.add_parser(
        name,
        help=summary,
        description=summary[0].upper() + summary[1:] + ".",
        epilog=examples,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def named_files(words: Sequence[str], names: str, *, least: int, most: int) -> list[Path]:
    """Return the words as paths, or say how many were expected.

    Parameters
    ----------
    words
        What the user wrote that is no option.
    names
        What they stand for, as in the usage line.
    least, most
        How many are legal.

    Raises
    ------
    InputError
        If there are more or fewer.
    """
    if not least <= len(words) <= most:
        raise InputError(f"expected {names}, got {len(words)} files: {' '.join(words)}")
    return [Path(word) for word in words]
