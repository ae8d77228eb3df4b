"""Where the messages of a workflow job go."""

import logging
import sys
from pathlib import Path
from types import TracebackType


def log_to(path: str | Path) -> None:
    """Send log messages and uncaught errors of this process to `path`, and errors to standard error as well.

    Parameters
    ----------
    path
        The log file, replaced if it exists.
    """
    to_file = logging.FileHandler(path, mode="w")
    to_screen = logging.StreamHandler(sys.stderr)
    to_screen.setLevel(logging.WARNING)
    form = "%(asctime)s %(levelname)s %(name)s: %(message)s"
    logging.basicConfig(level=logging.INFO, format=form, handlers=[to_file, to_screen], force=True)
    logging.captureWarnings(True)

    def log_uncaught(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        logging.getLogger("morphoskel").critical("%s: %s", kind.__name__, error)
        to_screen.setLevel(logging.CRITICAL + 1)  # the traceback is for the log file only
        logging.getLogger("morphoskel").critical("traceback", exc_info=(kind, error, trace))

    sys.excepthook = log_uncaught
