"""What can be chosen about the samplers that generate points: S-NET, SampleNet and Meta-Sampler."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from morphoskel.errors import ConfigError


@dataclass(frozen=True)
class GeneratorSettings:
    """Sizes, loss and schedule of a generator of points; S-NET [1]_, SampleNet [2]_ and Meta-Sampler [3]_ differ here.

    Parameters
    ----------
    point_channels
        Of the layers that every point passes; the last one is the size of the cloud's descriptor.
    head_channels
        Of the layers between the descriptor and the generated coordinates.
    normalise_output
        Whether the coordinates pass a last batch normalisation, as in the programs of S-NET and SampleNet; in that of
        Meta-Sampler they do not.
    neighbours
        Input points that a generated point is projected onto, 7 in SampleNet and 10 in Meta-Sampler; 0 for none, as
        in S-NET: then the task sees the generated points.
    least_sigma
        Floor of the projection's squared temperature, in squared units of the points.
    task_weight
        Of the task loss, a mean over the classifiers. The program of Meta-Sampler sums instead, which is a weight of
        the number of classifiers.
    task_penalty
        Of the classifier's feature transform within the task loss, 0.001 in all three programs.
    alpha
        Weight of the simplification loss.
    gamma, delta
        The distance from the cloud to the generated points has the weight gamma + delta M for M points.
    projection_weight
        Of the squared temperature of the projection.
    augmentation
        Of the training clouds: ``"none"`` (SampleNet), ``"rotation"`` about the vertical axis and jitter (S-NET), or
        ``"dropout"`` of points, scale and shift (Meta-Sampler).
    epochs
        Passes over the training clouds.
    batch_size
        Clouds a step, at least 2 because of the batch normalisation.
    learning_rate, decay, least_learning_rate
        Of Adam at the beginning, the factor it is multiplied by at each decay, and its floor.
    momentum, momentum_decay, least_momentum
        The same for the share that a new batch has in the running statistics of batch normalisation.
    decay_share
        Share of all steps between two decays, above 0. Published: 600,000 of 4.92 million clouds, 0.122.

    Raises
    ------
    ConfigError
        If a value is out of range.

    References
    ----------
    .. [1] O. Dovrat, I. Lang, S. Avidan, "Learning to Sample", CVPR 2019.
    .. [2] I. Lang, A. Manor, S. Avidan, "SampleNet: Differentiable Point Cloud Sampling", CVPR 2020.
    .. [3] T.-Y. Cheng et al., "Meta-Sampler: Almost-Universal yet Task-Oriented Sampling for Point Clouds", ECCV 2022.
    """

    point_channels: tuple[int, ...]
    head_channels: tuple[int, ...]
    normalise_output: bool
    neighbours: int
    least_sigma: float
    task_weight: float
    task_penalty: float
    alpha: float
    gamma: float
    delta: float
    projection_weight: float
    augmentation: Literal["none", "rotation", "dropout"]
    epochs: int
    batch_size: int
    learning_rate: float
    decay: float
    least_learning_rate: float
    momentum: float
    momentum_decay: float
    least_momentum: float
    decay_share: float

    def __post_init__(self) -> None:
        if self.augmentation not in ("none", "rotation", "dropout"):
            raise ConfigError(f"augmentation: expected none, rotation or dropout, got {self.augmentation!r}")
        for name in ("point_channels", "head_channels"):
            if min(getattr(self, name), default=0) < 1:
                raise ConfigError(
                    f"{name}: expected at least one layer of at least 1 channel, got {getattr(self, name)}"
                )
        for name, least in (("neighbours", 0), ("epochs", 1), ("batch_size", 2)):
            if getattr(self, name) < least:
                raise ConfigError(f"{name}: expected at least {least}, got {getattr(self, name)}")
        weights = ("least_sigma", "task_weight", "task_penalty", "alpha", "gamma", "delta", "projection_weight")
        for name in weights:
            if not getattr(self, name) >= 0:
                raise ConfigError(f"{name}: expected at least 0, got {getattr(self, name)}")
        self._check_schedules()

    def _check_schedules(self) -> None:
        """Refuse schedules that rise or start below their floor."""
        for name in ("decay", "momentum_decay", "momentum"):
            if not 0 < getattr(self, name) <= 1:
                raise ConfigError(f"{name}: expected more than 0 and at most 1, got {getattr(self, name)}")
        if not self.decay_share > 0:
            raise ConfigError(f"decay_share: expected more than 0, got {self.decay_share}")
        for least, name in (("least_learning_rate", "learning_rate"), ("least_momentum", "momentum")):
            if not 0 < getattr(self, least) <= getattr(self, name):
                raise ConfigError(
                    f"{least}: expected more than 0 and at most {name} ({getattr(self, name)}), "
                    f"got {getattr(self, least)}"
                )

    def as_mapping(self) -> dict[str, Any]:
        """Return the settings as plain values and tuples by name."""
        return asdict(self)
