"""The caption and the footnotes of a result table, from its Markdown file."""

from __future__ import annotations

import re

FOOTNOTE = re.compile(r"\d+\. (.*)")


def read_markdown_notes(text: str) -> tuple[str, tuple[str, ...]]:
    """Return caption and footnotes as plain text: what :func:`morphoskel.reporting.markdown.render_markdown` escaped.

    Parameters
    ----------
    text
        Of the Markdown file.

    Returns
    -------
    tuple
        The caption, empty for an empty file, and the footnotes in order.
    """
    parts = text.strip("\n").split("\n\n")
    matches = [FOOTNOTE.fullmatch(line) for line in parts[-1].split("\n")] if len(parts) > 1 else []
    footnotes = tuple(_unescape(match[1]) for match in matches if match)
    return _unescape(parts[0]), footnotes if len(footnotes) == len(matches) else ()


def _unescape(text: str) -> str:
    """Return the characters themselves where Markdown has them behind a backslash."""
    return re.sub(r"\\(.)", r"\1", text)
