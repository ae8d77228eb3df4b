"""The resolved configuration of a run, as the page shows it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from morphoskel.errors import InputError
from morphoskel.reporting.page.assets import data_uri
from morphoskel.reporting.page.privacy import mask_values


@dataclass(frozen=True)
class Configuration:
    """A configuration without absolute paths.

    Parameters
    ----------
    values
        As plain values.
    text
        As YAML.
    """

    values: dict[str, Any]
    text: str

    @property
    def address(self) -> str:
        """Address that holds the text."""
        return data_uri(self.text.encode(), "application/yaml;charset=utf-8")

    def find(self, *keys: str) -> Any:
        """Return the value at these keys, or ``None`` if there is none."""
        values: Any = self.values
        for key in keys:
            values = values.get(key) if isinstance(values, dict) else None
        return values


def read_configuration(path: Path) -> Configuration:
    """Read the file ``config.yaml`` of a run, and put ``…/name`` in the place of absolute paths.

    Raises
    ------
    InputError
        If the file is absent or holds no mapping.
    """
    import yaml

    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError, yaml.YAMLError) as error:  # ValueError of a date such as 2020-13-01
        raise InputError(f"{path}: expected the resolved configuration as YAML ({error}); write it again") from error
    if not isinstance(values, dict):
        raise InputError(f"{path}: expected a mapping of configuration keys, got {values!r}; write it again")
    masked = mask_values(values)
    return Configuration(masked, yaml.safe_dump(masked, sort_keys=False, allow_unicode=True, width=1000))
