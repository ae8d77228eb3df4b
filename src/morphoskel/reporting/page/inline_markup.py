"""The inline markup of captions that are written in reStructuredText, as HTML."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

INLINE = re.compile(r"``(?P<code>.+?)``|\*\*(?P<strong>\S(?:.*?\S)?)\*\*|\*(?P<em>\S(?:.*?\S)?)\*")
"""What captions use of reStructuredText: literals, strong and emphasised text."""


def inline_html(text: str) -> Markup:
    """Return a paragraph of reStructuredText as HTML, on one line.

    Parameters
    ----------
    text
        With no other markup than :data:`INLINE`; what else there is appears as it is written.
    """
    parts: list[str] = []
    place = 0
    line = " ".join(text.split())
    for match in INLINE.finditer(line):
        [(tag, content)] = [(tag, content) for tag, content in match.groupdict().items() if content is not None]
        parts += [escape(line[place : match.start()]), Markup("<{0}>{1}</{0}>").format(tag, content)]
        place = match.end()
    return Markup("").join([*parts, escape(line[place:])])


def plain_text(text: str) -> str:
    """Return a paragraph of reStructuredText without its markup, on one line."""
    return INLINE.sub(lambda match: next(filter(None, match.groups())), " ".join(text.split()))
