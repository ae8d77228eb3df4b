"""Which lines of our code an input reaches, so that the loop can go on from inputs that reach new ones.

Atheris, the coverage-guided fuzzer for Python, has no release for Python 3.11 any more, and ends with the first
finding. Tracing our own package is enough here: formats are parsed in it, and what it calls is not ours to explore.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import morphoskel

_PACKAGE = str(next(iter(morphoskel.__path__)))

Steps = set[tuple[int, int, int]]
"""From a line to the next one of the same function, told by the address of its code: its hash is slow to compute."""


@contextmanager
def traced() -> Iterator[Steps]:
    """Collect the steps that the code of the package takes inside the block."""
    steps: Steps = set()

    def enter(frame: FrameType, event: str, argument: Any) -> Callable[..., Any] | None:
        code = frame.f_code
        if not code.co_filename.startswith(_PACKAGE):
            return None
        function, last = id(code), 0

        def follow(frame: FrameType, event: str, argument: Any) -> Callable[..., Any]:
            nonlocal last
            if event == "line":
                steps.add((function, last, frame.f_lineno))
                last = frame.f_lineno
            return follow

        return follow

    with _tracing(enter):
        yield steps


@contextmanager
def untraced() -> Iterator[None]:
    """Trace nothing inside the block: code that calls none of ours runs three times as fast."""
    with _tracing(None):
        yield


@contextmanager
def _tracing(trace: Any) -> Iterator[None]:
    before = sys.gettrace()
    sys.settrace(trace)
    try:
        yield
    finally:
        sys.settrace(before)
