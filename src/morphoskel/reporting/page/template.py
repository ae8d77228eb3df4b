"""Fill the page's templates."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Environment

TEMPLATES = "templates"


def fill_template(name: str, **values: Any) -> str:
    """Return a template with its gaps filled.

    Parameters
    ----------
    name
        Of a file in the folder ``templates`` beside this module.
    values
        For the gaps. Text is escaped, unless it is a :class:`markupsafe.Markup`.

    Raises
    ------
    jinja2.UndefinedError
        If a gap has no value.
    """
    return _environment().get_template(name).render(**values)


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(__package__, TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["duration"] = duration_text
    environment.filters["bytes"] = size_text
    return environment


def duration_text(seconds: float) -> str:
    """Return a duration as readers say it, to two units: ``0.4 s``, ``25 s``, ``3 min 20 s``, ``2 h 5 min``."""
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    minutes = round(seconds / 60)
    return f"{minutes // 60:,} h {minutes % 60} min"


def size_text(count: int) -> str:
    """Return a number of bytes as readers say it: ``812 bytes``, ``19 kB``, ``3.4 MB``."""
    if count < 1000:
        return f"{count} bytes"
    return f"{count / 1e3:,.0f} kB" if count < 999_500 else f"{count / 1e6:,.1f} MB"
