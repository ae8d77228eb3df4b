"""All text in files that are passed on, also in what pages hold as addresses."""

import base64
import re
from pathlib import Path

_EMBEDDED = re.compile(rb"data:[\w/+.;=-]*;base64,([A-Za-z0-9+/]+=*)")


def text_in(path: Path) -> str:
    """Return the text of a file, and of what is embedded in it, whatever else it holds."""
    content = path.read_bytes()
    parts = [content, *(base64.b64decode(found) for found in _EMBEDDED.findall(content))]
    return b"\n".join(parts).decode("utf-8", errors="replace")


def telling(folder: Path, secrets: list[str]) -> list[str]:
    """Return ``file: secret`` for every secret that a file below a folder tells."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    assert files
    return [f"{path.relative_to(folder)}: {secret}" for path in files for secret in secrets if secret in text_in(path)]
