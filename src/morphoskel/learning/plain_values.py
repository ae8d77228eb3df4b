"""From the plain values of a configuration file to those of settings."""

from typing import Any


def as_tuples(value: Any) -> Any:
    """Return nested lists, which configuration files have, as nested tuples."""
    return tuple(as_tuples(item) for item in value) if isinstance(value, list | tuple) else value
