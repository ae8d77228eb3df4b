"""What can be chosen about the network that tells the parts of clouds: its sizes and how it is trained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

from morphoskel.errors import ConfigError

LAYERS = (
    "before", "after", "head",
    "point_transform_channels", "point_transform_head", "feature_transform_channels", "feature_transform_head",
)  # fmt: skip
"""Settings that list the channels of layers."""


@dataclass(frozen=True)
class SegmentationSettings:
    """Sizes and training schedule of the PointNet that segments clouds into parts [1]_.

    Parameters
    ----------
    before
        Channels of the layers before the transform of the features. Published: 64, 128, 128.
    after
        Channels of the layers after it but the last. Published: 512.
    cloud_features
        Channels of the last layer, whose maximum over the points describes the cloud. Published: 2048.
    point_transform_channels, point_transform_head
        Channels of the layers at every point in the network that predicts the transform of the points, and of those
        after the maximum. Published: 64, 128, 1024, and 128, 128.
    feature_transform_channels, feature_transform_head
        The same for the transform of the features. Published: 256, 1024, and 512, 256.
    head
        Channels of the layers between the features and the parts. Published: 256, 256, 128.
    dropout
        Share of the channels dropped after the first two of these layers, at least 0 and below 1. Published: 0.2.
    penalty
        Weight of the distance of the feature transform from an orthogonal matrix, at least 0. Published: 0.001.
    batch_size
        Clouds a step, at least 2. Published: 32.
    epochs
        Passes over the training clouds; the one with the smallest validation loss is kept. Published: 200.
    learning_rate
        Of Adam. Published: 0.001.
    decay
        Factor of the learning rate, above 0 and at most 1. Published: 0.5.
    decay_epochs
        Epochs after which the factor is applied, again and again. Published: 20.
    lowest_learning_rate
        Below which the learning rate does not fall, at least 0 and at most the first one. Published: 0.00001.
    know_category
        Tell the network the category of each cloud, as published.
    restrict_to_category
        Choose only among the parts of the cloud's category, as published.
    training_input
        all: all points of a training cloud enter the network, and the loss counts those with labels; labelled: only
        the points with labels enter.
    training_points
        Points of a cloud that enter a step of the training, three quarters of them with labels, drawn anew in every
        step; at least 1. ``None``, as published: all. But for maxima over the points and the statistics of the batch,
        the network works at each of them alone, so that a step costs in proportion; more clouds a step then teach more
        in the same time.

    Raises
    ------
    ConfigError
        If a value is out of range.

    References
    ----------
    .. [1] C. R. Qi et al., "PointNet: Deep Learning on Point Sets for 3D Classification and Segmentation", CVPR 2017,
       and the program released with it.
    """

    before: tuple[int, ...]
    after: tuple[int, ...]
    cloud_features: int
    point_transform_channels: tuple[int, ...]
    point_transform_head: tuple[int, ...]
    feature_transform_channels: tuple[int, ...]
    feature_transform_head: tuple[int, ...]
    head: tuple[int, ...]
    dropout: float
    penalty: float
    batch_size: int
    epochs: int
    learning_rate: float
    decay: float
    decay_epochs: int
    lowest_learning_rate: float
    know_category: bool
    restrict_to_category: bool
    training_input: Literal["all", "labelled"]
    training_points: int | None

    def __post_init__(self) -> None:
        for name in LAYERS:
            if not getattr(self, name) or min(getattr(self, name)) < 1:
                raise ConfigError(f"{name}: expected at least one layer, each of at least 1 channel")
        for name, least in (("cloud_features", 1), ("batch_size", 2), ("epochs", 1), ("decay_epochs", 1)):
            if getattr(self, name) < least:
                raise ConfigError(f"{name}: expected at least {least}, got {getattr(self, name)}")
        if self.training_points is not None and self.training_points < 1:
            raise ConfigError(f"training_points: expected null or at least 1, got {self.training_points}")
        if self.training_input not in ("all", "labelled"):
            raise ConfigError(f"training_input: expected all or labelled, got {self.training_input!r}")
        self._check_rates()

    def _check_rates(self) -> None:
        """Refuse shares, weights and rates that are out of range."""
        if not 0 <= self.dropout < 1:
            raise ConfigError(f"dropout: expected at least 0 and less than 1, got {self.dropout}")
        if not self.penalty >= 0:
            raise ConfigError(f"penalty: expected at least 0, got {self.penalty}")
        if not self.learning_rate > 0:
            raise ConfigError(f"learning_rate: expected more than 0, got {self.learning_rate}")
        if not 0 < self.decay <= 1:
            raise ConfigError(f"decay: expected more than 0 and at most 1, got {self.decay}")
        if not 0 <= self.lowest_learning_rate <= self.learning_rate:
            raise ConfigError(
                f"lowest_learning_rate: expected at least 0 and at most the first one, {self.learning_rate}, got "
                f"{self.lowest_learning_rate}"
            )

    def changed(self, values: Mapping[str, Any]) -> SegmentationSettings:
        """Return the same settings but for those given, of which ``None`` changes nothing."""
        return replace(self, **{name: value for name, value in values.items() if value is not None})

    def as_mapping(self) -> dict[str, Any]:
        """Return the settings as plain numbers, words and tuples by name."""
        return asdict(self)
