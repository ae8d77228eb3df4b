"""What can be chosen about the skeleton network of the skeleton-aware sampler: its sizes and how it is trained."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from morphoskel.errors import ConfigError

Neighbourhood = Literal["delaunay", "nearest"]


@dataclass(frozen=True)
class SkeletonAwareSettings:
    """Sizes, loss weights and training schedule of the network that predicts skeletal balls [1]_.

    Parameters
    ----------
    skeletal_points
        Balls of a skeleton. Published: 128.
    neighbourhood
        ``delaunay``: the nearest of the points that few edges of the cloud's Delaunay tetrahedra lead to;
        ``nearest``: the nearest of all points. Published: both, ``delaunay`` in the commands.
    neighbours
        Points of a neighbourhood, its centre included. Published: 33.
    hops
        Edges that may be walked in the Delaunay graph; more where they lead to too few points. Published: 5.
    k
        Neighbours of a point in feature space, itself included. Published: 20.
    channels
        Of the edge convolutions. Published: 64, 64, 128, 256.
    global_features
        Channels of the feature of the whole cloud. Published: 512.
    head
        Channels of the layers behind it. Published: 512, 512.
    weight_channels
        Channels of the layers between the features of a neighbourhood and the weights of its points. Published: 384,
        256, 256, 128.
    initial_scale
        Scale of the last batch normalisation before training. At 1, as published, the weights of a neighbourhood start
        with a sum far above 1, so that the skeletal points start far outside of the shape and thousands of steps pass
        until they have come in.
    batch_size
        Clouds a step. Published: 4.
    pretrain_epochs, skeleton_epochs
        Passes over the training clouds in each phase. Published: 20 and 60.
    learning_rate
        Of Adam, constant. Published: 0.001.
    pretrain_weight
        Of the summed Chamfer distance of the first phase. Published: 0.0001.
    point_to_sphere_weight, radius_weight
        Of the distance between points and spheres and of the mean radius (which is to grow) in the second phase; the
        distance between points and sampled spheres has weight 1. Published: 0.3 and 0.4.

    Raises
    ------
    ConfigError
        If a value is out of range.

    References
    ----------
    .. [1] C. Wen et al., "Learnable Skeleton-Aware 3D Point Cloud Sampling", CVPR 2023, and the program released with
       it.
    """

    skeletal_points: int
    neighbourhood: Neighbourhood
    neighbours: int
    hops: int
    k: int
    channels: tuple[int, ...]
    global_features: int
    head: tuple[int, ...]
    weight_channels: tuple[int, ...]
    initial_scale: float
    batch_size: int
    pretrain_epochs: int
    skeleton_epochs: int
    learning_rate: float
    pretrain_weight: float
    point_to_sphere_weight: float
    radius_weight: float

    def __post_init__(self) -> None:
        if self.neighbourhood not in ("delaunay", "nearest"):
            raise ConfigError(f"neighbourhood: expected delaunay or nearest, got {self.neighbourhood!r}")
        for name in ("channels", "head", "weight_channels"):
            if not getattr(self, name) or min(getattr(self, name)) < 1:
                raise ConfigError(f"{name}: expected at least one layer, each of at least 1 channel")
        counts = ("skeletal_points", "neighbours", "hops", "k", "global_features", "batch_size")
        for name in (*counts, "pretrain_epochs", "skeleton_epochs"):
            if getattr(self, name) < 1:
                raise ConfigError(f"{name}: expected at least 1, got {getattr(self, name)}")
        for name in ("initial_scale", "learning_rate", "pretrain_weight"):
            if not getattr(self, name) > 0:
                raise ConfigError(f"{name}: expected more than 0, got {getattr(self, name)}")
        for name in ("point_to_sphere_weight", "radius_weight"):
            if not getattr(self, name) >= 0:
                raise ConfigError(f"{name}: expected at least 0, got {getattr(self, name)}")

    def as_mapping(self) -> dict[str, Any]:
        """Return the settings as plain numbers, words and tuples by name."""
        return asdict(self)
