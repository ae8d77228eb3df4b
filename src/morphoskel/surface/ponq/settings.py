"""The settings of PoNQ: sound ones, and those of the released experiments."""

from __future__ import annotations

from dataclasses import dataclass, fields

from morphoskel.errors import ConfigError

FEWEST_SITES = 4
"""The vertices of one tetrahedron."""

SAMPLES_A_SITE = 4
"""The quadric of a cell has full rank only where samples of three planes meet in it, so a cell needs a few."""

SITES_A_SQUARED_CELL = 3
"""In the released experiments, 50 000 sites on a grid of 128: a cell is then about as wide as the sites are apart."""

LARGEST_BATCH = 10_000
"""Samples a step up to which the whole cloud is used; beyond, a random batch gives the same gradient, only noisier."""


@dataclass(frozen=True)
class PonqSettings:
    """How many sites, how they are optimised, and what a cell measures.

    Parameters
    ----------
    sites
        Number of sites, at least 4; ``None`` for a quarter of the distinct points.
    with_replacement
        Draw the initial sites with replacement, so that some coincide, and there may be more sites than points.
    steps
        Steps of Adam; at least 0.
    learning_rate
        Of Adam, in half sides of the cube ``[-1, 1]^3`` that the shape is brought to.
    sample_fraction
        Share of the points in the random batch of each step, in ``(0, 1]``; ``None`` for all points of a cloud of up
        to 10 000, and as many of a larger one.
    grid
        Number of cells along the cube's side, the unit in which the cut weighs distance against angle and in which
        the reach of the repair is measured; ``None`` for the square root of a third of the sites, the ratio of the
        released experiments.

    Raises
    ------
    ConfigError
        If a value is out of its range.
    """

    sites: int | None = None
    with_replacement: bool = False
    steps: int = 200
    learning_rate: float = 1e-3
    sample_fraction: float | None = None
    grid: int | None = None

    def __post_init__(self) -> None:
        for name, minimum in (("sites", FEWEST_SITES), ("steps", 0), ("grid", 1)):
            value = getattr(self, name)
            if value is not None and value < minimum:
                raise ConfigError(f"ponq: {name} must be at least {minimum}, got {value}")
        if self.learning_rate <= 0:
            raise ConfigError(f"ponq: learning_rate must be positive, got {self.learning_rate}")
        if self.sample_fraction is not None and not 0 < self.sample_fraction <= 1:
            raise ConfigError(f"ponq: sample_fraction must lie in (0, 1], got {self.sample_fraction}")

    def count_sites(self, distinct_points: int) -> int:
        """Return the number of sites for a cloud of so many distinct points."""
        return distinct_points // SAMPLES_A_SITE if self.sites is None else self.sites

    def count_cells(self, sites: int) -> int:
        """Return the number of cells along the cube's side for so many sites."""
        return max(1, round((sites / SITES_A_SQUARED_CELL) ** 0.5)) if self.grid is None else self.grid

    def count_batch(self, points: int) -> int:
        """Return the number of samples that a step uses of a cloud of so many points."""
        if self.sample_fraction is None:
            return min(points, LARGEST_BATCH)
        return max(1, round(self.sample_fraction * points))


PRESETS = {
    "sound": PonqSettings(),
    # The released experiments: more sites than points, so that hardly any cell holds more than one sample.
    "released": PonqSettings(sites=50_000, with_replacement=True, sample_fraction=0.1, grid=128),
}
"""Settings by name."""


def resolve_settings(preset: str, **changes: float | bool | None) -> PonqSettings:
    """Return the settings of `preset` with those replaced that `changes` gives a value other than ``None``.

    Raises
    ------
    ConfigError
        If there is no such preset, or a value is out of its range.
    """
    if preset not in PRESETS:
        raise ConfigError(f"ponq: no such preset {preset!r}; legal are {', '.join(PRESETS)}")
    values = {field.name: getattr(PRESETS[preset], field.name) for field in fields(PonqSettings)}
    values.update({name: value for name, value in changes.items() if value is not None})
    return PonqSettings(**values)
