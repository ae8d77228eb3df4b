"""How far a loop is: a bar on a terminal, now and then a line in the log."""

from __future__ import annotations

import logging
import multiprocessing
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sized
from contextlib import contextmanager
from typing import TypeVar

from morphoskel.durations import describe_roughly, describe_seconds

logger = logging.getLogger(__name__)

T = TypeVar("T")

SILENT_SECONDS = 2.0
"""Loops that end within this time leave nothing in the log."""

LINE_SECONDS = 5.0
"""Least time between two lines in the log."""

LINE_SHARE = 0.1
"""Least share of the whole between two lines in the log."""

UNKNOWN_TOTAL_SECONDS = 30.0
"""Time between two lines in the log where nobody knows what the whole is."""


def track(
    items: Iterable[T], description: str, *, unit: str = "shape", total: int | None = None, show: bool = True
) -> Iterator[T]:
    """Yield `items` and show how many are done.

    If standard error is a terminal, a bar is drawn there, which is gone at the end. Whether it is or not, a loop of
    more than :data:`SILENT_SECONDS` writes lines at level INFO to the log, at most one every :data:`LINE_SHARE` of the
    whole and every :data:`LINE_SECONDS`, and one at its end. A worker process draws and logs nothing: that is for the
    process which waits for it.

    Parameters
    ----------
    items
        What to loop over.
    description
        What is done, short.
    unit
        What one item is, in the singular.
    total
        Number of items, if `items` has no length.
    show
        Whether to show anything at all.

    Yields
    ------
    object
        The items, unchanged and in their order.
    """
    if total is None and isinstance(items, Sized):
        total = len(items)
    with count_up(description, unit=unit, total=total, show=show) as advance:
        for item in items:
            yield item
            advance(1)


@contextmanager
def count_up(
    description: str, *, unit: str, total: int | None = None, start: int = 0, show: bool = True
) -> Iterator[Callable[[int], None]]:
    """Show how far something is that is no loop over items; else like :func:`track`.

    Parameters
    ----------
    description
        What is done, short.
    unit
        What is counted, in the singular; ``"B"`` for bytes, which are shown in multiples of 1000.
    total
        How many there are, if that is known.
    start
        How many were done before.
    show
        Whether to show anything at all.

    Yields
    ------
    callable
        To be called with the number of units that have been done since the last call.
    """
    if not show or multiprocessing.parent_process() is not None:
        yield lambda _: None
        return
    lines = _Lines(description, unit, total, start)
    if not shows_bars():
        yield lines.advance
    else:
        from tqdm import tqdm

        with tqdm(total=total, initial=start, desc=description, unit=unit, unit_scale=unit == "B", leave=False,
                  dynamic_ncols=True) as bar:  # fmt: skip

            def advance(number: int) -> None:
                bar.update(number)
                lines.advance(number)

            yield advance
    lines.end()


def shows_bars() -> bool:
    """Tell whether bars are drawn: whether standard error is a terminal."""
    return sys.stderr is not None and sys.stderr.isatty()


class _Lines:
    """The lines of one loop in the log."""

    def __init__(self, description: str, unit: str, total: int | None, start: int) -> None:
        self.description = description
        self.unit = unit
        self.total = total
        self.start = start
        self.done = start
        self.began = time.monotonic()
        self.logged_at = self.began
        self.logged_done = start

    def advance(self, number: int) -> None:
        """Count, and write a line if one is due."""
        self.done += number
        now = time.monotonic()
        if now - self.began > SILENT_SECONDS and self.done != self.total and self._is_due(now):
            logger.info("%s: %s, %s%s", self.description, self._done(), self._rate(now), self._left(now))
            self.logged_at, self.logged_done = now, self.done

    def end(self) -> None:
        """Write the last line, unless the loop was short."""
        now = time.monotonic()
        if now - self.began > SILENT_SECONDS:
            seconds = describe_seconds(now - self.began)
            logger.info("%s: %s in %s, %s", self.description, self._counted(), seconds, self._rate(now))

    def _is_due(self, now: float) -> bool:
        if self.total is None:
            return now - self.logged_at >= UNKNOWN_TOTAL_SECONDS
        far_enough = self.done - self.logged_done >= LINE_SHARE * self.total
        return far_enough and now - self.logged_at >= LINE_SECONDS

    def _counted(self) -> str:
        """Return what is done, for example ``"3 shapes"``."""
        return (
            f"{self.done / 1e6:.1f} MB"
            if self.unit == "B"
            else f"{self.done} {self.unit}{'s' if self.done != 1 else ''}"
        )

    def _done(self) -> str:
        """Return what is done of how much, for example ``"3 shapes of 8 (37 %)"``."""
        if not self.total:
            return self._counted()
        total = f"{self.total / 1e6:.1f}" if self.unit == "B" else f"{self.total}"
        return f"{self._counted()} of {total} ({100 * self.done // self.total} %)"

    def _rate(self, now: float) -> str:
        """Return the mean speed since the start, as the number that is easier to read."""
        done, seconds = self.done - self.start, now - self.began
        if self.unit == "B":
            return f"{done / 1e6 / seconds:.1f} MB/s"
        if done > seconds:
            return f"{done / seconds:.1f} {self.unit}s/s"
        return f"{seconds / max(done, 1):.1f} s/{self.unit}"

    def _left(self, now: float) -> str:
        """Return the estimate of the time left, if there is one."""
        if self.total is None or self.done == self.start:
            return ""
        left = (self.total - self.done) * (now - self.began) / (self.done - self.start)
        return f", {describe_roughly(left)} left"
