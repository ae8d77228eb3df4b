"""What can be chosen about Point2Skeleton: the sizes of its networks and how they are trained."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from morphoskel.errors import ConfigError


@dataclass(frozen=True)
class Point2SkeletonSettings:
    """Sizes, loss weights and training schedule; the defaults are the published ones [1]_.

    Lengths are in units of half the cloud's largest extent, to which every cloud is scaled.

    Parameters
    ----------
    points
        Points of a cloud that the networks see.
    skeletal_points
        Balls of a skeleton.
    centroids
        Points kept by each level of the encoder, not increasing.
    radii, neighbours
        For each level, the radius and the most points used of a ball, one a scale.
    channels
        For each level, the channels of the layers of a scale.
    head_channels
        Channels of the layers between the features and the weights of the convex combinations.
    dropout
        Probability that a channel of a point is dropped before each of those layers.
    initial_sharpness
        Scale of the last batch normalisation before training. It multiplies what the softmax turns into weights: at 1
        all skeletal points start near the centroid, and thousands of steps pass until the scale has grown enough to
        separate them; at 5 they start on the shape, which is what a short training needs.
    node_features
        Channels to which the features of a skeletal point are reduced before links are predicted.
    graph_channels
        Channels of the graph convolutions.
    valid_neighbours
        A link may join a skeletal point to its this many nearest, itself included.
    link_threshold
        Least inner product of two codes for a link.
    pretrain_epochs, skeleton_epochs, link_epochs
        Passes over the training clouds in each phase.
    batch_size
        Clouds a step.
    learning_rate, link_learning_rate
        Of Adam, for the skeletal points and for the links.
    pretrain_weight
        Of the summed Chamfer distance of the first phase.
    point_to_sphere_weight, radius_weight
        Of the distance between points and spheres and of the mean radius (which is to grow) in the second phase; the
        distance between points and sampled spheres has weight 1.

    Raises
    ------
    ConfigError
        If values contradict each other or are out of range.

    References
    ----------
    .. [1] C. Lin et al., "Point2Skeleton: Learning Skeletal Representations from Point Clouds", CVPR 2021, and the
       program released with it.
    """

    points: int = 2000
    skeletal_points: int = 100
    centroids: tuple[int, ...] = (1024, 768, 512, 512)
    radii: tuple[tuple[float, ...], ...] = ((0.1, 0.2), (0.2, 0.4), (0.4, 0.6), (0.6, 0.8))
    neighbours: tuple[tuple[int, ...], ...] = ((16, 32), (32, 64), (32, 64), (64, 128))
    channels: tuple[tuple[int, ...], ...] = ((16, 16, 32), (32, 32, 64), (64, 64, 128), (128, 128, 256))
    head_channels: tuple[int, ...] = (384, 256, 256, 128)
    dropout: float = 0.2
    initial_sharpness: float = 1.0
    node_features: int = 16
    graph_channels: tuple[int, ...] = (32, 32, 48, 64, 64, 80, 96, 96, 102, 128, 128, 144)
    valid_neighbours: int = 8
    link_threshold: float = 0.8
    pretrain_epochs: int = 20
    skeleton_epochs: int = 30
    link_epochs: int = 30
    batch_size: int = 4
    learning_rate: float = 1e-3
    link_learning_rate: float = 5e-4
    pretrain_weight: float = 1e-4
    point_to_sphere_weight: float = 0.3
    radius_weight: float = 0.4

    def __post_init__(self) -> None:
        levels = {len(getattr(self, name)) for name in ("centroids", "radii", "neighbours", "channels")}
        if len(levels) != 1 or levels == {0}:
            raise ConfigError("centroids, radii, neighbours and channels: expected one entry a level for each")
        for level, (radii, neighbours, channels) in enumerate(
            zip(self.radii, self.neighbours, self.channels, strict=True), 1
        ):
            if not radii or not channels or len(radii) != len(neighbours):
                raise ConfigError(f"level {level}: expected as many radii as neighbours, at least one, and channels")
        if list(self.centroids) != sorted(self.centroids, reverse=True) or self.centroids[0] > self.points:
            raise ConfigError(
                f"centroids: expected numbers that do not increase and are at most points ({self.points}), "
                f"got {self.centroids}"
            )
        if not 2 <= self.valid_neighbours < self.skeletal_points:
            raise ConfigError(
                f"valid_neighbours: expected at least 2 and less than skeletal_points ({self.skeletal_points}), "
                f"got {self.valid_neighbours}"
            )
        if not self.graph_channels:
            raise ConfigError("graph_channels: expected at least one graph convolution")
        if not 0 <= self.dropout < 1:
            raise ConfigError(f"dropout: expected at least 0 and less than 1, got {self.dropout}")
        self._check_signs()

    def _check_signs(self) -> None:
        """Refuse counts below 1, rates of 0 and negative weights."""
        lists = (self.centroids, *self.neighbours, *self.channels, self.head_channels, self.graph_channels)
        counts = {
            name: getattr(self, name)
            for name in ("node_features", "batch_size", "pretrain_epochs", "skeleton_epochs", "link_epochs")
        } | {"centroids, neighbours and channels": min(min(values, default=1) for values in lists)}
        for name, value in counts.items():
            if value < 1:
                raise ConfigError(f"{name}: expected at least 1, got {value}")
        for name in ("learning_rate", "link_learning_rate", "pretrain_weight", "initial_sharpness"):
            if not getattr(self, name) > 0:
                raise ConfigError(f"{name}: expected more than 0, got {getattr(self, name)}")
        for name in ("point_to_sphere_weight", "radius_weight"):
            if not getattr(self, name) >= 0:
                raise ConfigError(f"{name}: expected at least 0, got {getattr(self, name)}")

    def as_mapping(self) -> dict[str, Any]:
        """Return the settings as plain numbers and tuples by name."""
        return asdict(self)
