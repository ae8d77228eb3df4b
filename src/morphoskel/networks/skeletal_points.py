"""The skeletal points of Point2Skeleton: convex combinations of surface points.

Source: Lin et al., *Point2Skeleton: Learning Skeletal Representations from Point Clouds*, CVPR 2021, Sec. 3.1.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.networks.pointnet2 import PointNet2Encoder, gather_rows


class SkeletalPoints(NamedTuple):
    """Skeletal balls of a batch of clouds and what they are combined from.

    Parameters
    ----------
    centres
        ``(B, K, 3)``, ``weights @ samples``.
    radii
        ``(B, K)``, at least 0.
    features
        ``(B, K, F)``, the samples' features combined with the same weights.
    weights
        ``(B, K, M)``, at least 0; each row sums to 1.
    samples
        ``(B, M, 3)``, the input points that are combined.
    """

    centres: Tensor
    radii: Tensor
    features: Tensor
    weights: Tensor
    samples: Tensor


class SkeletalPointNetwork(nn.Module):
    """Predict the weights with which sampled surface points are combined to skeletal points.

    Parameters
    ----------
    settings
        Sizes of the layers.
    """

    def __init__(self, settings: Point2SkeletonSettings) -> None:
        super().__init__()
        self.encoder = PointNet2Encoder(settings.centroids, settings.radii, settings.neighbours, settings.channels)
        self.dropout = nn.Dropout(settings.dropout)
        sizes = (self.encoder.features, *settings.head_channels, settings.skeletal_points)
        self.linear = nn.ModuleList(nn.Linear(*pair) for pair in pairwise(sizes))
        self.normalise = nn.ModuleList(nn.BatchNorm1d(size) for size in sizes[1:])
        nn.init.constant_(self.normalise[-1].get_parameter("weight"), settings.initial_sharpness)

    def forward(self, points: Tensor) -> SkeletalPoints:
        """Skeletonize clouds.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float32, scaled to [-1, 1].

        Returns
        -------
        SkeletalPoints
            Every centre lies in the convex hull of the samples.
        """
        samples, features = self.encoder(points)
        weights = self._combination_weights(features)
        centres = weights @ samples
        radii = combine_radii(weights, nearest_distances(samples, centres))
        return SkeletalPoints(centres, radii, weights @ features, weights, samples)

    def _combination_weights(self, features: Tensor) -> Tensor:
        """Return ``(B, K, M)`` weights, a softmax over the M samples of each skeletal point."""
        batch, samples, _ = features.shape
        values = features.flatten(0, 1)
        last = len(self.linear) - 1
        for layer, (linear, normalise) in enumerate(zip(self.linear, self.normalise, strict=True)):
            if layer < last:
                values = functional.relu(normalise(linear(self.dropout(values))))
            else:
                values = normalise(linear(values))
        return values.view(batch, samples, -1).transpose(1, 2).softmax(dim=-1)


def nearest_distances(points: Tensor, targets: Tensor) -> Tensor:
    """Return the distance of each point to the nearest target.

    Parameters
    ----------
    points, targets
        ``(B, N, 3)`` and ``(B, M, 3)`` float.

    Returns
    -------
    Tensor
        ``(B, N)``, unsquared. Where a point coincides with its target the gradient is 0, not infinite.
    """
    offsets = points - gather_rows(targets, nearest_indices(points, targets))
    distances: Tensor = torch.linalg.vector_norm(offsets, dim=-1)
    return distances


@torch.no_grad()
def nearest_indices(points: Tensor, targets: Tensor) -> Tensor:
    """Return ``(B, N)`` int64: the index of the target that is nearest to each point.

    Which target is nearest is found without recording gradients: only the distance to that one has a gradient, and
    recording it alone saves the ``(B, N, M)`` backward pass.
    """
    return torch.cdist(points, targets, compute_mode="donot_use_mm_for_euclid_dist").argmin(dim=-1)


def combine_radii(weights: Tensor, distances: Tensor) -> Tensor:
    """Return ``(B, K)`` radii: the samples' distances ``(B, M)`` to the skeleton, combined by weight."""
    return (weights @ distances[..., None]).squeeze(-1)
