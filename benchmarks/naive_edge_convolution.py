"""The networks of :mod:`morphoskel.networks.edge_features` as they are commonly written: with features of each edge.

Parameters have the same names and shapes, so that a state can be handed over.
"""

from itertools import pairwise

import torch
from torch import nn
from torch.nn import functional

SLOPE = 0.2


def nearest(features, k):
    """Return the indices, ``(B, N, k)``, of the nearest points in the space of features, ``(B, C, N)``."""
    squares = features.square().sum(dim=1)
    products = features.transpose(1, 2) @ features
    distances = squares.unsqueeze(2) - 2 * products + squares.unsqueeze(1)
    return distances.topk(k, dim=-1, largest=False).indices


def edge_features(features, neighbours):
    """Return ``[x_j - x_i; x_i]``, ``(B, 2C, N, k)``, of all edges."""
    batch, channels, points = features.shape
    k = neighbours.shape[2]
    rows = (neighbours + torch.arange(batch).view(-1, 1, 1) * points).flatten()
    others = features.transpose(1, 2).reshape(batch * points, channels)[rows].view(batch, points, k, channels)
    own = features.transpose(1, 2).unsqueeze(2).expand_as(others)
    return torch.cat([others - own, own], dim=3).permute(0, 3, 1, 2).contiguous()


class NaiveEdgeConvolution(nn.Module):
    """1x1 convolution of all edges, batch normalisation, LeakyReLU, maximum over the edges of a point."""

    def __init__(self, inputs, outputs, slope=SLOPE):
        super().__init__()
        self.slope = slope
        self.linear = nn.Linear(2 * inputs, outputs, bias=False)
        self.normalise = nn.BatchNorm2d(outputs)

    def forward(self, features, neighbours):
        """Map ``(B, N, inputs)`` to ``(B, N, outputs)``."""
        edges = edge_features(features.transpose(1, 2), neighbours)
        values = functional.conv2d(edges, self.linear.weight[:, :, None, None])
        return functional.leaky_relu(self.normalise(values), self.slope).max(dim=3).values.transpose(1, 2)


class NaiveEdgeFeatures(nn.Module):
    """Edge convolutions on graphs drawn anew, a maximum over the cloud, and layers on both together."""

    def __init__(self, *, channels=(64, 64, 128, 256), k, global_features=512, head):
        super().__init__()
        self.k = k
        local = sum(channels)
        self.edges = nn.ModuleList(NaiveEdgeConvolution(*pair) for pair in pairwise((3, *channels)))
        self.cloud = nn.Linear(local, global_features, bias=False)
        self.normalise_cloud = nn.BatchNorm1d(global_features)
        sizes = (local + global_features, *head)
        self.head = nn.ModuleList(nn.Linear(*pair, bias=False) for pair in pairwise(sizes))
        self.normalise_head = nn.ModuleList(nn.BatchNorm1d(size) for size in head)

    def forward(self, points):
        """Map ``(B, N, 3)`` to ``(B, N, head[-1])``."""
        features, levels = points, []
        for layer in self.edges:
            features = layer(features, nearest(features.transpose(1, 2), self.k))
            levels.append(features.transpose(1, 2))
        local = torch.cat(levels, dim=1)
        cloud = _activate(local, self.cloud, self.normalise_cloud).max(dim=2, keepdim=True).values
        values = torch.cat([local, cloud.expand(-1, -1, local.shape[2])], dim=1)
        for linear, normalise in zip(self.head, self.normalise_head, strict=True):
            values = _activate(values, linear, normalise)
        return values.transpose(1, 2)


def _activate(values, linear, normalise):
    return functional.leaky_relu(normalise(functional.conv1d(values, linear.weight.unsqueeze(2))), SLOPE)
