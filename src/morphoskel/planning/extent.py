"""How much there is to do under a configuration: its shapes, and the settings that a cost depends on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from morphoskel.errors import InputError

OWN_FOR_PARTS = {
    "skeleton.candidates.count": "candidates",
    "watertight.resolution": "resolution",
    "surface.poisson.depth": "depth",
    "surface.repaired_poisson.depth": "depth",
}
"""Settings that the shapes of a second data set may have values of their own for."""


@dataclass(frozen=True)
class Extent:
    """A configuration and its data sets.

    Parameters
    ----------
    config
        The resolved configuration as plain values.
    counts
        Number of shapes of each split, by the name of the data set.
    """

    config: Mapping[str, Any]
    counts: Mapping[str, Mapping[str, int]]

    def setting(self, path: str, wildcards: Mapping[str, str]) -> Any:
        """Return the value at a dotted path, as it holds for the data set of a job; ``None`` where there is none."""
        found: Any = self.config
        for key in path.split("."):
            found = found.get(key) if isinstance(found, Mapping) else None
        if not self._of_second(wildcards):
            return found
        own = self.setting("tasks.segmentation.skeletons", {}) or {}
        for changed, name in OWN_FOR_PARTS.items():
            if (value := own.get(name)) is None:
                continue
            section, _, key = changed.rpartition(".")
            if changed == path:
                found = value
            elif section == path and isinstance(found, Mapping):
                found = {**found, key: value}
        return found

    def shapes(self, wildcards: Mapping[str, str], split: str | None = None) -> int:
        """Return the number of shapes of a job: those of its shard, of its split, or of the split given.

        Raises
        ------
        InputError
            If the number of shapes of the split is not known.
        """
        dataset = wildcards.get("dataset", self.config["dataset"]["name"])
        split = split or wildcards["split"]
        try:
            count = self.counts[dataset][split]
        except KeyError:
            raise InputError(f"the number of shapes of the split {split} of {dataset} is not known") from None
        if "shard" not in wildcards:
            return count
        size = int(self.config["shard_size"])
        return max(0, min(size, count - int(wildcards["shard"]) * size))

    def _of_second(self, wildcards: Mapping[str, str]) -> bool:
        first: str = self.config["dataset"]["name"]
        return wildcards.get("dataset", first) != first
