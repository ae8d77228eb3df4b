"""What can be chosen about the sampler that a skeleton guides: its sizes and how it is trained."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from morphoskel.errors import ConfigError


@dataclass(frozen=True)
class TemperatureSettings:
    """How the temperature of the Gumbel-softmax falls.

    Parameters
    ----------
    start, end
        First and last temperature, ``start >= end > 0``.
    annealed_share
        Share of all steps after which the last temperature is reached, above 0 and at most 1.
    every
        Steps between two changes of the temperature.

    Raises
    ------
    ConfigError
        If a value is out of range.
    """

    start: float
    end: float
    annealed_share: float
    every: int

    def __post_init__(self) -> None:
        if not 0 < self.end <= self.start:
            raise ConfigError(f"temperature: expected start >= end > 0, got start {self.start} and end {self.end}")
        if not 0 < self.annealed_share <= 1:
            raise ConfigError(f"annealed_share: expected more than 0 and at most 1, got {self.annealed_share}")
        if self.every < 1:
            raise ConfigError(f"every: expected at least 1 step between changes, got {self.every}")


@dataclass(frozen=True)
class SkeletonSamplerSettings:
    """Sizes and training schedule of the skeleton-aware sampler [1]_.

    Parameters
    ----------
    k
        Neighbours of a point in feature space, itself included. Published: 20.
    channels
        Of the edge convolutions. Published: 64, 64, 128, 256.
    global_features
        Channels of the feature of the whole cloud. Published: 512.
    head
        Channels of the layers behind it. Published: 512, 256.
    dropout
        Probability that a channel of a point is dropped before the last layer. Published: 0.5.
    batch_size
        Clouds a step. Published: 4.
    epochs
        Passes over the training clouds. Published: 250.
    learning_rate
        Of Adam, constant. Published: 0.001.
    temperature_start, temperature_end
        Of the Gumbel-softmax. Published: 1 and 0.5.
    temperature_annealed_share
        Share of all steps after which the last temperature is reached. Published: 0.8.
    temperature_every
        Steps between two changes of the temperature. Published: 100.
    task_penalty
        Weight of the task network's own penalty on its feature transform. Published: 0.001.

    Raises
    ------
    ConfigError
        If a value is out of range.

    References
    ----------
    .. [1] C. Wen et al., "Learnable Skeleton-Aware 3D Point Cloud Sampling", CVPR 2023, and the program released with
       it.
    """

    k: int
    channels: tuple[int, ...]
    global_features: int
    head: tuple[int, ...]
    dropout: float
    batch_size: int
    epochs: int
    learning_rate: float
    temperature_start: float
    temperature_end: float
    temperature_annealed_share: float
    temperature_every: int
    task_penalty: float

    def __post_init__(self) -> None:
        for name in ("channels", "head"):
            if not getattr(self, name) or min(getattr(self, name)) < 1:
                raise ConfigError(f"{name}: expected at least one layer, each of at least 1 channel")
        for name in ("k", "global_features", "batch_size", "epochs"):
            if getattr(self, name) < 1:
                raise ConfigError(f"{name}: expected at least 1, got {getattr(self, name)}")
        if not 0 <= self.dropout < 1:
            raise ConfigError(f"dropout: expected at least 0 and less than 1, got {self.dropout}")
        if not self.learning_rate > 0:
            raise ConfigError(f"learning_rate: expected more than 0, got {self.learning_rate}")
        if not self.task_penalty >= 0:
            raise ConfigError(f"task_penalty: expected at least 0, got {self.task_penalty}")
        _ = self.temperature  # checks itself

    @property
    def temperature(self) -> TemperatureSettings:
        """How the temperature falls."""
        return TemperatureSettings(
            self.temperature_start, self.temperature_end, self.temperature_annealed_share, self.temperature_every
        )

    def as_mapping(self) -> dict[str, Any]:
        """Return the settings as plain numbers and tuples by name."""
        return asdict(self)
