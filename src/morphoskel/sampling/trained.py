"""Choose points of a cloud with a trained network."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.sampling.matching import Matching, complete, match_and_complete
from morphoskel.sampling.samplers import GENERATORS
from morphoskel.shapes import FloatArray, Skeleton

if TYPE_CHECKING:
    import torch

    from morphoskel.networks.point_generator import PointGenerator
    from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork
    from morphoskel.networks.skeleton_sampler import SkeletonSampler


def load_trained(sampler: str, path: Path) -> PointGenerator | SkeletonSampler:
    """Read the network of a sampler.

    Parameters
    ----------
    sampler
        One of :data:`~morphoskel.sampling.samplers.LEARNED`.
    path
        The file written after training.

    Returns
    -------
    PointGenerator or SkeletonSampler
        On the CPU, in evaluation mode; its ``samples`` is the number of points that it chooses.

    Raises
    ------
    InputError
        If the file is missing, or holds no network of this kind.
    """
    if sampler in GENERATORS:
        from morphoskel.networks.point_generator import load_generator

        return load_generator(path)
    from morphoskel.networks.skeleton_sampler import load_skeleton_sampler

    return load_skeleton_sampler(path)


def load_skeleton_network(path: Path) -> SkeletonAwareNetwork:
    """Read the network that predicts the skeletons of ``skeleton_aware``.

    Returns
    -------
    SkeletonAwareNetwork
        On the CPU, in evaluation mode.

    Raises
    ------
    InputError
        If the file is missing, or holds no such network.
    """
    from morphoskel.networks.skeleton_aware_network import load_skeleton_aware

    return load_skeleton_aware(path)


def choose_trained(
    network: PointGenerator | SkeletonSampler,
    points: npt.NDArray[np.float32],
    weights: FloatArray | None,
    noise: torch.Generator | None = None,
) -> Matching:
    """Choose as many points of a cloud as a network was trained to, all of them different.

    Parameters
    ----------
    network
        In evaluation mode, on the CPU.
    points
        ``(N, 3)`` float32, centroid 0 and largest distance from it 1.
    weights
        ``(N,)``, the skeleton prior; ``None`` for a network that generates points, which has none.
    noise
        Source of the noise with which a network with a prior draws points; without, its most probable ones are taken.

    Returns
    -------
    Matching
        The indices, those that the network chose first, and how many those are. The others are farthest points.

    Raises
    ------
    InputError
        If the cloud has fewer points than are to be chosen.
    """
    import torch

    from morphoskel.sampling.gumbel import best_indices, draw_indices

    if len(points) < network.samples:
        raise InputError(f"has {len(points)} points, the network chooses {network.samples}; give a denser cloud")
    cloud = torch.from_numpy(points)[None]
    with torch.no_grad():
        if weights is None:
            return match_and_complete(points, network(cloud)[0].numpy())
        logits = network(cloud, torch.from_numpy(weights.astype(np.float32))[None])
        drawn = best_indices(logits) if noise is None else draw_indices(logits, noise)
    _, first = np.unique(drawn[0].numpy(), return_index=True)
    distinct = drawn[0].numpy()[np.sort(first)]
    return Matching(complete(points, distinct, network.samples), len(distinct))


def skeletonize_trained(
    network: SkeletonAwareNetwork, points: npt.NDArray[np.float32], centre: FloatArray, scale: float
) -> Skeleton:
    """Return the skeleton that the skeleton-aware network predicts for a cloud.

    Parameters
    ----------
    network
        On the CPU.
    points
        ``(N, 3)`` float32, normalised.
    centre, scale
        ``(3,)`` and a length: the original points are ``points * scale + centre``.

    Returns
    -------
    Skeleton
        In the unit of the original points.

    Raises
    ------
    InputError
        If the cloud has too few points for the network.
    """
    import torch

    from morphoskel.networks.skeleton_aware_network import predict_skeleton

    centres, radii = predict_skeleton(network, torch.from_numpy(points)[None])
    return Skeleton(centres[0].numpy() * scale + centre, radii[0].numpy() * scale)
