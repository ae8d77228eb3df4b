"""The provenance of a run as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any

from morphoskel.reporting.page.configuration import Configuration
from morphoskel.reporting.page.privacy import without_absolute_paths

UNKNOWN = "unknown"

SEEDS = (
    (("seed",), "Seed of the run"),
    (("sampling", "seeds"), "Trainings of each learned sampler"),
    (("sampling", "draws"), "Draws of each sampler with noise"),
    (("tasks", "segmentation", "seeds"), "Trainings for part segmentation"),
)
"""Keys of the configuration that tell what was drawn and how often, and what readers call them."""


def provenance_rows(provenance: Mapping[str, Any], configuration: Configuration) -> list[tuple[str, str]]:
    """Return names and values, as text.

    Parameters
    ----------
    provenance
        As :func:`morphoskel.run_provenance.read_provenance` returns it.
    configuration
        For the seeds.
    """
    machine = provenance["machine"]
    memory = machine["memory"]
    rows = [
        ("Date", date_text(provenance["date"])),
        ("Commit", commit_text(provenance)),
        ("MorphoSkel", provenance["version"]),
        ("Python", provenance["python"]),
        ("Operating system", machine["system"]),
        ("Processor", f"{machine['processor']}, {machine['cores']} cores in use"),
        ("Memory", UNKNOWN if memory is None else f"{memory / 2**30:.1f} GiB"),
        *_seed_rows(configuration),
    ]
    return [(name, without_absolute_paths(str(value))) for name, value in rows]


def date_text(date: str) -> str:
    """Return an ISO 8601 date for readers, in UTC to the minute."""
    when = datetime.fromisoformat(date).astimezone(UTC)
    return f"{when.day} {when:%B %Y, %H:%M} UTC"


def commit_text(provenance: Mapping[str, Any], digits: int = 40) -> str:
    """Return the first digits of the commit, and whether files were edited since."""
    if provenance["commit"] is None:
        return f"{UNKNOWN}, as the sources were no Git clone"
    edited = ", with edits that are not committed" if provenance["dirty"] else ""
    return f"{provenance['commit'][:digits]}{edited}"


def _seed_rows(configuration: Configuration) -> Iterator[tuple[str, str]]:
    for keys, name in SEEDS:
        value = configuration.find(*keys)
        if value is not None:
            yield name, str(value)
