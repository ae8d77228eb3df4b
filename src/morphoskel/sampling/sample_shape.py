"""Choose points of one shape with any of the samplers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.errors import ConfigError, InputError
from morphoskel.sampling.lfs import LfsSettings, lfs_points
from morphoskel.sampling.prior import (
    PriorSettings,
    local_feature_size,
    prior_weights,
    shuffled_weights,
    uniform_weights,
)
from morphoskel.sampling.random_points import random_points
from morphoskel.sampling.samplers import SKELETON_OF
from morphoskel.seeds import derive_generator, derive_seed
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud, Skeleton

if TYPE_CHECKING:
    from morphoskel.networks.point_generator import PointGenerator
    from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork
    from morphoskel.networks.skeleton_sampler import SkeletonSampler


@dataclass(frozen=True, eq=False)
class SampledShape:
    """A cloud and the points chosen from it.

    Parameters
    ----------
    cloud
        All points; for a mesh those that were drawn on it.
    indices
        ``(M,)`` int64, the chosen points, distinct.
    skeleton, sizes
        The skeleton of a sampler that has one, and ``(N,)`` float64, the distance of each point of the cloud to it: its
        local feature size. Both in the shape's unit.
    chosen_by_network
        How many of the first indices a network chose; the others are farthest points. ``None`` without a network.
    """

    cloud: PointCloud
    indices: IntArray
    skeleton: Skeleton | None = None
    sizes: FloatArray | None = None
    chosen_by_network: int | None = None

    @property
    def chosen(self) -> PointCloud:
        """The chosen points as a cloud, with the normals and labels that they have."""
        normals, labels = self.cloud.normals, self.cloud.labels
        return PointCloud(
            self.cloud.points[self.indices],
            None if normals is None else normals[self.indices],
            None if labels is None else labels[self.indices],
        )


@dataclass(frozen=True, eq=False)
class ShapeSampler:
    """A sampler that is ready for any number of shapes.

    Parameters
    ----------
    sampler
        One of :data:`~morphoskel.sampling.samplers.SAMPLERS`.
    count
        Points to choose; of a network, the number that it was trained for.
    seed
        Global seed, from which that of each shape is derived.
    skeletonization
        Arguments of :func:`~morphoskel.skeletonization.skeletonize_shape`, for a sampler that needs a skeleton.
    lfs
        Settings of the sampler ``lfs``, which the others do without.
    prior
        Settings of the prior of the skeleton-aware network, as in its training.
    network_points
        Points that the network was trained with: a larger cloud is thinned to so many at random.
    network, skeleton_network
        Of a learned sampler, and of ``skeleton_aware`` the one that predicts skeletons.
    noise
        Let the skeleton-aware network draw points instead of taking the most probable ones.
    """

    sampler: str
    count: int
    seed: int
    skeletonization: Mapping[str, Any]
    lfs: LfsSettings | None
    prior: PriorSettings
    network_points: int
    network: PointGenerator | SkeletonSampler | None = None
    skeleton_network: SkeletonAwareNetwork | None = None
    noise: bool = False

    def __call__(self, shape: PointCloud | Mesh, name: str) -> SampledShape:
        """Choose points of a shape.

        Parameters
        ----------
        shape
            A cloud, or a mesh, on which :data:`~morphoskel.skeletonization.MESH_SAMPLES` points are drawn first,
            uniformly by area.
        name
            The shape's id. The same shape, id and seed give the same points.

        Raises
        ------
        InputError
            If the shape has fewer points than are wanted.
        ConfigError
            If the settings or the network of the sampler are missing.
        ShapeError
            If the sampler needs a skeleton and none is found.
        """
        cloud = shape if isinstance(shape, PointCloud) else _points_on(shape, self.seed, name)
        if len(cloud) < self.count:
            raise InputError(
                f"{self.count} points are wanted, and it has only {len(cloud)}; ask for fewer, or give a denser cloud"
            )
        if self.sampler == "random":
            generator = derive_generator(self.seed, name, "random points")
            return SampledShape(cloud, random_points(len(cloud), self.count, generator))
        if self.sampler == "fps":
            from morphoskel.skeleton.thinning import farthest_points

            return SampledShape(cloud, farthest_points(cloud.points, self.count))
        if self.sampler == "lfs" and self.lfs is not None:
            skeleton = self._skeleton(shape, name)
            sizes = local_feature_size(cloud.points, skeleton.points)
            return SampledShape(cloud, lfs_points(cloud.points, sizes, self.count, self.lfs), skeleton, sizes)
        if self.network is None:
            raise ConfigError(f"sampler {self.sampler!r}: its settings or its network are missing")
        return self._choose_by_network(self.network, shape, cloud, name)

    def _skeleton(self, shape: PointCloud | Mesh, name: str) -> Skeleton:
        from morphoskel.skeletonization import skeletonize_shape

        return skeletonize_shape(shape, name=name, **self.skeletonization).skeleton

    def _choose_by_network(
        self, network: PointGenerator | SkeletonSampler, shape: PointCloud | Mesh, cloud: PointCloud, name: str
    ) -> SampledShape:
        import torch

        from morphoskel.datasets.cloud_set import normalise
        from morphoskel.sampling.trained import choose_trained, skeletonize_trained

        kept = self._thinned(len(cloud), name)
        points, centre, scale = normalise(cloud.points[kept])
        skeleton = sizes = weights = noise = None
        if self.skeleton_network is not None:
            skeleton = skeletonize_trained(self.skeleton_network, points, centre, scale)
        elif self.sampler in SKELETON_OF:
            skeleton = self._skeleton(shape, name)
        if skeleton is not None:
            sizes = local_feature_size(cloud.points, skeleton.points)
            weights = prior_weights(sizes[kept] / scale, self.prior)
        if self.sampler == "shuffled" and weights is not None:
            weights = shuffled_weights(weights, derive_generator(self.seed, name, "shuffled prior"))
        if self.sampler == "uniform":
            weights = uniform_weights(len(kept), self.prior)
        if self.noise:
            noise = torch.Generator().manual_seed(derive_seed(self.seed, name, "sampler noise"))
        chosen = choose_trained(network, points, weights, noise)
        return SampledShape(cloud, kept[chosen.indices], skeleton, sizes, chosen.matched)

    def _thinned(self, available: int, name: str) -> IntArray:
        """Return the points that the network sees, all of them unless they are too many, in their order."""
        if available <= self.network_points:
            return np.arange(available)
        return np.sort(
            random_points(available, self.network_points, derive_generator(self.seed, name, "network points"))
        )


def _points_on(mesh: Mesh, seed: int, name: str) -> PointCloud:
    """Draw the points of a mesh; the same that skeleton methods for clouds get to see."""
    from morphoskel.formats.sample import sample_surface
    from morphoskel.skeletonization import MESH_SAMPLES

    return sample_surface(mesh, MESH_SAMPLES, derive_generator(seed, name, "sample"))
