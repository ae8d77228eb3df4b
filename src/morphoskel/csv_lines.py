"""Lines of CSV files that end in a line feed and hold any text."""

from __future__ import annotations

from typing import IO

QUOTED_ENDS = "\r\n"
"""To be given to whatever writes CSV as its line terminator: Python quotes text for the characters in it alone, and
readers take a carriage return without quotes for the end of a line."""


class LineFeeds:
    """A stream for a CSV writer with :data:`QUOTED_ENDS`, whose rows arrive one by one; they end in a line feed.

    Parameters
    ----------
    stream
        Text stream that changes no line ends.
    """

    def __init__(self, stream: IO[str]) -> None:
        self._stream = stream

    def write(self, row: str) -> int:
        """Write a row."""
        return self._stream.write(row.removesuffix(QUOTED_ENDS) + "\n")
