"""Keep what native libraries print to themselves: it belongs into the log, not between progress bars."""

from __future__ import annotations

import logging
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

logger = logging.getLogger(__name__)

LOGGED_LINES = 5


@contextmanager
def native_output_logged(source: str) -> Iterator[None]:
    """Catch everything that the block writes to the process's standard output and error, and log its first lines.

    Native code writes to the file descriptors, past Python's ``sys.stdout``; so the descriptors are exchanged for the
    duration of the block. Not for use in several threads at once.

    Parameters
    ----------
    source
        Named in the log.
    """
    with tempfile.TemporaryFile() as caught:
        kept = [os.dup(descriptor) for descriptor in (1, 2)]
        try:
            for descriptor in (1, 2):
                os.dup2(caught.fileno(), descriptor)
            yield
        finally:
            for descriptor, original in zip((1, 2), kept, strict=True):
                os.dup2(original, descriptor)
                os.close(original)
            caught.seek(0)
            lines = caught.read().decode(errors="replace").split("\n")
            for line in [line.strip() for line in lines if line.strip()][:LOGGED_LINES]:
                logger.info("%s: %s", source, line)
