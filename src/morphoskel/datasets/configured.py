"""Open the data set that a configuration section describes, and count its shapes for planning."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from morphoskel.datasets.dataset import Dataset
from morphoskel.datasets.manifest import Entry
from morphoskel.datasets.registry import open_dataset
from morphoskel.errors import DatasetError

PLANNING_KEYS = frozenset({"name", "counts", "url", "sha256"})
"""Keys of the section that concern the workflow, not the reading of shapes."""

SEEDED_KINDS = frozenset({"synthetic", "class_tree", "folder"})
"""Kinds that draw random numbers, to make shapes or to sample meshes."""


def open_configured(section: Mapping[str, Any], *, seed: int) -> Dataset:
    """Return the data set of a configuration section.

    Parameters
    ----------
    section
        The section ``dataset`` as plain values.
    seed
        The global seed.

    Returns
    -------
    Dataset
        Not yet read.

    Raises
    ------
    ConfigError, DatasetError
        If the section does not fit the data set.
    """
    options = {key: value for key, value in section.items() if key not in PLANNING_KEYS}
    options["root"] = Path(options["root"])
    if section["kind"] in SEEDED_KINDS:
        options["seed"] = seed
    return open_dataset(**options)


def count_shapes(section: Mapping[str, Any], *, seed: int) -> dict[str, int]:
    """Return the number of shapes of each split, as the workflow is planned with.

    Shapes on disk are counted. Where the folder does not exist yet, the published numbers stand in, so that a run can
    be planned before its data are there; the manifest is checked against the plan.

    Parameters
    ----------
    section
        The section ``dataset`` as plain values.
    seed
        The global seed.

    Returns
    -------
    dict
        Number of shapes by split.

    Raises
    ------
    DatasetError
        If the data set is absent and no numbers are published, or if it is incomplete.
    """
    if "counts" in section and not Path(section["root"]).exists():
        return dict(section["counts"])
    return open_configured(section, seed=seed).counts()


def check_plan(entries: Iterable[Entry], planned: Mapping[str, int]) -> None:
    """Raise if the shapes found are not as many as the workflow was planned for.

    Parameters
    ----------
    entries
        The shapes that the data set lists.
    planned
        Number of shapes by split, from :func:`count_shapes`.

    Raises
    ------
    DatasetError
        Naming the splits that differ.
    """
    found = Counter(entry.split for entry in entries)
    different = [f"{split}: {found[split]} found, {planned.get(split, 0)} planned"
                 for split in sorted({*found, *planned}) if found[split] != planned.get(split, 0)]  # fmt: skip
    if different:
        raise DatasetError(
            f"the data set does not match the plan ({'; '.join(different)}). If it has just been fetched or changed, "
            "run again: the plan is then made from what is there"
        )
