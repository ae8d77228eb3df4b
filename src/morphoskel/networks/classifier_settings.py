"""How the classifier of clouds is trained. The sizes of its layers are those published."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from morphoskel.errors import ConfigError


@dataclass(frozen=True)
class ClassifierSettings:
    """Training of the PointNet that judges samples by classifying them.

    Parameters
    ----------
    dropped_points
        Largest share of the points of a training cloud that is dropped, at least 0 and below 1; the share itself is
        uniform between 0 and this. 0 trains on all points. 0.875 as published: such a network knows sparse clouds.
    drop_style
        overwrite: each cloud has its own share, and each point is replaced by the cloud's first one with that
        probability, as published. remove: one share for a batch, of which as many points are taken away; this is
        faster, and only the statistics of the batch normalisation differ.
    lowest_scale, highest_scale
        Training clouds are scaled by a factor drawn between these two.
    shift
        Training clouds are moved along each axis by at most this, in units of the normalised cloud, at least 0.
    feature_dropout
        Share of the descriptor's channels dropped in training, at least 0 and below 1.
    penalty
        Weight of the distance of the feature transform from an orthogonal matrix, at least 0.
    batch_size
        Clouds a step, at least 2.
    epochs
        Passes over the training clouds; the one with the smallest validation loss is kept.
    learning_rate
        Of Adam.
    weight_decay
        Of Adam, added to the gradient; at least 0.
    decay
        Factor of the learning rate, above 0 and at most 1.
    decay_epochs
        Epochs after which the factor is applied, again and again.
    """

    dropped_points: float
    drop_style: Literal["overwrite", "remove"]
    lowest_scale: float
    highest_scale: float
    shift: float
    feature_dropout: float
    penalty: float
    batch_size: int
    epochs: int
    learning_rate: float
    weight_decay: float
    decay: float
    decay_epochs: int

    def __post_init__(self) -> None:
        for name in ("dropped_points", "feature_dropout"):
            if not 0 <= getattr(self, name) < 1:
                raise ConfigError(f"{name}: expected at least 0 and less than 1, got {getattr(self, name)}")
        if self.drop_style not in ("overwrite", "remove"):
            raise ConfigError(f"drop_style: expected overwrite or remove, got {self.drop_style!r}")
        if not 0 < self.lowest_scale <= self.highest_scale:
            raise ConfigError(
                "lowest_scale, highest_scale: expected more than 0 and the lowest not above the highest, "
                f"got {self.lowest_scale} and {self.highest_scale}"
            )
        self._check_training()

    def _check_training(self) -> None:
        """Refuse negative weights, counts that are too small and rates of 0."""
        for name in ("shift", "penalty", "weight_decay"):
            if not getattr(self, name) >= 0:
                raise ConfigError(f"{name}: expected at least 0, got {getattr(self, name)}")
        for name, least in (("batch_size", 2), ("epochs", 1), ("decay_epochs", 1)):
            if getattr(self, name) < least:
                raise ConfigError(f"{name}: expected at least {least}, got {getattr(self, name)}")
        if not self.learning_rate > 0:
            raise ConfigError(f"learning_rate: expected more than 0, got {self.learning_rate}")
        if not 0 < self.decay <= 1:
            raise ConfigError(f"decay: expected more than 0 and at most 1, got {self.decay}")

    def as_mapping(self) -> dict[str, Any]:
        """Return the settings as plain numbers and words by name."""
        return asdict(self)
