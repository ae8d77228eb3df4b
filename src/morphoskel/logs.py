"""Where messages go: those of a workflow job, and those that are written beside progress bars."""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from types import TracebackType
from typing import TextIO

PROGRESS = "morphoskel.progress"
"""The logger of :mod:`morphoskel.progress`."""


class BesideBars(logging.StreamHandler[TextIO]):
    """Write messages on lines of their own, above the progress bars that are drawn on the same terminal.

    On a terminal it leaves out what :mod:`morphoskel.progress` reports, which the bars show there.
    """

    def emit(self, record: logging.LogRecord) -> None:
        """Write a message."""
        on_terminal = not self.stream.closed and self.stream.isatty()
        if on_terminal and record.name == PROGRESS:
            return
        tqdm = sys.modules.get("tqdm")  # not imported yet means that there is no bar
        if on_terminal and tqdm is not None:
            with tqdm.tqdm.external_write_mode(file=self.stream):
                super().emit(record)
        else:
            super().emit(record)


def log_to(path: str | Path) -> None:
    """Send log messages and uncaught errors of this process to `path`, and errors to standard error as well.

    Parameters
    ----------
    path
        The log file, replaced if it exists.
    """
    to_file = logging.FileHandler(path, mode="w")
    to_screen = BesideBars(sys.stderr)
    to_screen.setLevel(logging.WARNING)
    form = "%(asctime)s %(levelname)s %(name)s: %(message)s"
    logging.basicConfig(level=logging.INFO, format=form, handlers=[to_file, to_screen], force=True)
    logging.captureWarnings(True)

    def log_uncaught(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        logging.getLogger("morphoskel").critical("%s: %s", kind.__name__, error)
        to_screen.setLevel(logging.CRITICAL + 1)  # the traceback is for the log file only
        logging.getLogger("morphoskel").critical("traceback", exc_info=(kind, error, trace))

    sys.excepthook = log_uncaught
