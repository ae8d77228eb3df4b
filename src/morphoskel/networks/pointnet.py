"""PointNet: features of the points of a cloud and of the whole of it that do not depend on their order.

Source: Qi et al., *PointNet: Deep Learning on Point Sets for 3D Classification and Segmentation*, CVPR 2017, Sec. 4.
Layers on points are linear maps of the last axis, which are the paper's convolutions of width 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.networks.normalised_linear import NormalisedLinear, PooledLinear


def hidden_layer(inputs: int, outputs: int) -> nn.Sequential:
    """Return a layer for one vector a cloud: linear, batch normalisation, ReLU."""
    return nn.Sequential(nn.Linear(inputs, outputs, bias=False), nn.BatchNorm1d(outputs), nn.ReLU())


class TransformNetwork(nn.Module):
    """Predict a matrix that aligns the features of a cloud (the paper's T-Net).

    Parameters
    ----------
    inputs
        Channels of the features; the matrix is of that size.
    channels
        Of the layers at every point; the maximum over the points is taken of the last one.
    head
        Of the layers after the maximum.
    """

    def __init__(
        self, inputs: int, channels: Sequence[int] = (64, 128, 1024), head: Sequence[int] = (512, 256)
    ) -> None:
        super().__init__()
        self.inputs = inputs
        *local, pooled = pairwise((inputs, *channels))
        self.local = nn.ModuleList(NormalisedLinear(*pair) for pair in local)
        self.pooled = PooledLinear(*pooled)
        self.head = nn.ModuleList(hidden_layer(*pair) for pair in pairwise((channels[-1], *head)))
        self.matrix = nn.Linear(head[-1], inputs * inputs)

    def forward(self, features: Tensor) -> Tensor:
        """Return ``(B, inputs, inputs)`` matrices, the identity added, for ``(B, N, inputs)`` features."""
        values = features
        for layer in self.local:
            values = functional.relu(layer(values), inplace=True)
        values = functional.relu(self.pooled(values))  # the maximum of the positive parts
        for layer in self.head:
            values = layer(values)
        matrices: Tensor = self.matrix(values).view(-1, self.inputs, self.inputs)
        return matrices + torch.eye(self.inputs, device=matrices.device, dtype=matrices.dtype)


@dataclass(frozen=True)
class PointNetFeatures:
    """What the encoder says of a batch of clouds.

    Parameters
    ----------
    local
        Activations ``(B, N, C)`` of every layer at the points, in order, without the last layer.
    points
        ``(B, N, C)``, the features of the points in their aligned frame, which go into the layers after the transform.
    cloud
        ``(B, G)``, the maximum over the points of the last layer, whose values may be negative.
    input_transform, feature_transform
        ``(B, 3, 3)`` and ``(B, C, C)``; points and features are rows and are multiplied from the left.
    """

    local: tuple[Tensor, ...]
    points: Tensor
    cloud: Tensor
    input_transform: Tensor
    feature_transform: Tensor


class PointNetEncoder(nn.Module):
    """Align points, describe each, align the descriptions, describe each again, and take the maximum.

    Parameters
    ----------
    before
        Channels of the layers before the transform of the features.
    after
        Channels of the layers after it but the last.
    cloud_features
        Channels of the last layer, which has batch normalisation but no ReLU.
    """

    def __init__(
        self, before: Sequence[int] = (64,), after: Sequence[int] = (128,), cloud_features: int = 1024
    ) -> None:
        super().__init__()
        self.input_transform = TransformNetwork(3)
        self.before = nn.ModuleList(NormalisedLinear(*pair) for pair in pairwise((3, *before)))
        self.feature_transform = TransformNetwork(before[-1])
        *middle, last = pairwise((before[-1], *after, cloud_features))
        self.after = nn.ModuleList(NormalisedLinear(*pair) for pair in middle)
        self.last = PooledLinear(*last)

    def forward(self, points: Tensor) -> PointNetFeatures:
        """Describe ``(B, N, 3)`` float clouds of any N at least 1."""
        input_transform = self.input_transform(points)
        values = points @ input_transform
        local = []
        for layer in self.before:
            values = functional.relu(layer(values), inplace=True)
            local.append(values)
        feature_transform = self.feature_transform(values)
        aligned = values = values @ feature_transform
        for layer in self.after:
            values = functional.relu(layer(values), inplace=True)
            local.append(values)
        return PointNetFeatures(tuple(local), aligned, self.last(values), input_transform, feature_transform)
