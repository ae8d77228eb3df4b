"""The skeleton network of the skeleton-aware sampler: skeletal balls from the neighbourhoods of spread-out points.

Source: Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023, and the program released with it.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor, nn

from morphoskel.errors import InputError
from morphoskel.networks.edge_features import EdgeFeatures
from morphoskel.networks.network_file import read_network, write_network
from morphoskel.networks.pointnet2 import BallFeatures, farthest_points, gather_rows
from morphoskel.networks.seed_neighbourhoods import seed_neighbourhoods
from morphoskel.networks.skeleton_aware_settings import SkeletonAwareSettings


class WeightedBalls(NamedTuple):
    """Skeletal balls of a batch of clouds.

    Parameters
    ----------
    centres
        ``(B, K, 3)``, the points of each neighbourhood summed by weight.
    radii
        ``(B, K)``, the distances of these points to the centre summed by weight.
    weights
        ``(B, K, S)``, at least 0.
    """

    centres: Tensor
    radii: Tensor
    weights: Tensor


class SkeletonAwareNetwork(nn.Module):
    """Predict weights with which the points of each neighbourhood are summed to a skeletal point.

    Parameters
    ----------
    settings
        Sizes of the layers.

    Notes
    -----
    As in the released program the weights are not normalised, so that a centre may leave the convex hull of its
    neighbourhood, and a radius sums distances to the ball's own centre, where Point2Skeleton takes those to the nearest
    skeletal point.
    """

    def __init__(self, settings: SkeletonAwareSettings) -> None:
        super().__init__()
        self.settings = settings
        self.features = EdgeFeatures(
            channels=settings.channels, k=settings.k, global_features=settings.global_features, head=settings.head
        )
        self.weights = BallFeatures(settings.head[-1], (*settings.weight_channels, settings.neighbours))
        nn.init.constant_(self.weights.normalise[-1].get_parameter("weight"), settings.initial_scale)

    def forward(self, points: Tensor, neighbourhoods: Tensor) -> WeightedBalls:
        """Skeletonize clouds.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float32, normalised clouds.
        neighbourhoods
            ``(B, K, S)`` integer indices, see :func:`cloud_neighbourhoods`; the first of each row is its centre.

        Returns
        -------
        WeightedBalls
            One ball a neighbourhood.
        """
        around = gather_rows(points, neighbourhoods)
        weights = self.weights(points, self.features(points), around[:, :, 0], neighbourhoods)
        centres = (weights[..., None] * around).sum(dim=2)
        distances = torch.linalg.vector_norm(around - centres[:, :, None], dim=-1)
        return WeightedBalls(centres, (weights * distances).sum(dim=2), weights)


def cloud_neighbourhoods(points: Tensor, settings: SkeletonAwareSettings) -> Tensor:
    """Return the neighbourhoods of the farthest points of each cloud.

    Parameters
    ----------
    points
        ``(S, N, 3)`` float32 on the CPU, normalised clouds.
    settings
        How many neighbourhoods, of how many points, found how.

    Returns
    -------
    Tensor
        ``(S, skeletal_points, neighbours)`` int32. They do not depend on the network, so they are found once.

    Raises
    ------
    InputError
        If a cloud has too few points.
    """
    if points.shape[1] < settings.skeletal_points:
        raise InputError(
            f"points: {points.shape[1]} points a cloud are too few for {settings.skeletal_points} skeletal points; "
            "use denser clouds or lower skeletal_points"
        )
    neighbourhoods = [
        seed_neighbourhoods(cloud, seeds, settings.neighbours, settings.neighbourhood, settings.hops)
        for cloud, seeds in zip(points.numpy(), farthest_points(points, settings.skeletal_points).numpy(), strict=True)
    ]
    return torch.from_numpy(np.array(neighbourhoods, dtype=np.int32))


@torch.no_grad()
def predict_skeleton(network: SkeletonAwareNetwork, points: Tensor) -> tuple[Tensor, Tensor]:
    """Skeletonize clouds with a trained network.

    Parameters
    ----------
    network
        On any device; put into evaluation mode for the call.
    points
        ``(S, N, 3)`` float32 on the CPU, normalised clouds.

    Returns
    -------
    tuple of Tensor
        On the CPU: centres, ``(S, K, 3)``, and radii, ``(S, K)``, float32.

    Raises
    ------
    InputError
        If a cloud has too few points.
    """
    device = next(network.parameters()).device
    was_training = network.training
    network.eval()
    parts = []
    for batch in torch.split(points, network.settings.batch_size):
        balls = network(batch.to(device), cloud_neighbourhoods(batch, network.settings).to(device))
        parts.append((balls.centres.cpu(), balls.radii.cpu()))
    network.train(was_training)
    centres, radii = zip(*parts, strict=True)
    return torch.cat(centres), torch.cat(radii)


def save_skeleton_aware(network: SkeletonAwareNetwork, path: Path) -> None:
    """Write weights and settings to one file, whole or not at all."""
    write_network(network, path, settings=network.settings.as_mapping())


def load_skeleton_aware(path: Path | str) -> SkeletonAwareNetwork:
    """Read a trained skeleton network.

    Parameters
    ----------
    path
        A file written by :func:`save_skeleton_aware`.

    Returns
    -------
    SkeletonAwareNetwork
        On the CPU, in evaluation mode.

    Raises
    ------
    InputError
        If the file is missing, or is not such a network.
    """
    with read_network(path, "skeleton-aware skeleton network") as content:
        network = SkeletonAwareNetwork(SkeletonAwareSettings(**content["settings"]))
        network.load_state_dict(content["weights"])
    return network.eval()
