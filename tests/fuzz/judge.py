"""Decide whether a reader did right: it returned something, or it refused the file in words that a user understands."""

from __future__ import annotations

import resource
import time
import traceback
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from morphoskel.errors import MorphoSkelError

MOST_SECONDS = 2.0
"""Processor time that reading a file of at most 64 kB may take."""

MOST_MEMORY = 256 << 20
"""Bytes by which it may raise the largest resident memory of the process."""

READ, REFUSED = "read", "refused"


@dataclass(frozen=True)
class Finding:
    """What a reader did wrong.

    Parameters
    ----------
    kind
        ``error`` (another error than the project's own), ``nameless`` (the message does not name the file), ``memory``,
        ``slow``, ``hang`` or ``crash``.
    where
        The error and the line of ours that it passed last, by which findings are told apart.
    content
        The file.
    """

    kind: str
    where: str
    content: bytes


def judge(read: Callable[[Path], object], path: Path, content: bytes) -> str | Finding:
    """Read the file at `path`, which holds `content`, and return ``read``, ``refused`` or what is wrong.

    A warning counts as an error, as in all tests of the project.
    """
    memory, started = _largest_memory(), time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            read(path)
        outcome: str | Finding = READ
    except MorphoSkelError as error:
        outcome = _judge_refusal(error, path, content)
    except Exception as error:
        outcome = Finding("memory" if isinstance(error, MemoryError) else "error", _where(error), content)
    if isinstance(outcome, str):
        if _largest_memory() - memory > MOST_MEMORY:
            return Finding("memory", f"{(_largest_memory() - memory) >> 20} MB", content)
        if time.process_time() - started > MOST_SECONDS:
            return Finding("slow", f"{time.process_time() - started:.0f} s", content)
    return outcome


def _judge_refusal(error: MorphoSkelError, path: Path, content: bytes) -> str | Finding:
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, MemoryError):  # it was asked for before the file was found out
            return Finding("memory", _where(cause), content)
        cause = cause.__cause__ or cause.__context__
    if path.name not in str(error):
        return Finding("nameless", _where(error), content)
    return REFUSED


def _where(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if "morphoskel" in frame.filename] or frames
    return f"{type(error).__name__} in {Path(ours[-1].filename).name}, {ours[-1].name}"


def _largest_memory() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10
