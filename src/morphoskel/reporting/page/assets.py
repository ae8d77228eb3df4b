"""Files that the page takes in: styles, scripts and templates."""

from __future__ import annotations

import base64
import hashlib
from importlib.resources import files

HOME = "morphoskel.reporting"

STYLE, SCRIPT = "report.css", "report.js"
"""Of the page itself; the viewer brings its own."""

VIEWER = ("viewer.css", "viewer.min.js")


def read_asset(name: str) -> str:
    """Return the text of a file in the folder ``assets`` of :mod:`morphoskel.reporting`."""
    return files(HOME).joinpath("assets", name).read_text(encoding="utf-8").strip()


def assets_digest() -> str:
    """Return 12 hexadecimal digits that change with any style, script or template that a report is made of.

    :func:`morphoskel.provenance.code_digest` sees Python modules only, so a rule that writes a report needs both.
    """
    templates = files(HOME).joinpath("page", "templates")
    contents = [read_asset(name) for name in (STYLE, SCRIPT, *VIEWER)]
    contents += [
        f"{path.name} {path.read_text(encoding='utf-8')}"
        for path in sorted(templates.iterdir(), key=lambda path: path.name)
    ]
    return hashlib.sha256("\n".join(contents).encode()).hexdigest()[:12]


def data_uri(content: bytes, media_type: str) -> str:
    """Return `content` as an address that holds it, so that a page needs no other file."""
    return f"data:{media_type};base64,{base64.b64encode(content).decode('ascii')}"
