"""The links between skeletal points: a first graph from the cloud, and a graph auto-encoder that completes it.

Source: Lin et al., *Point2Skeleton: Learning Skeletal Representations from Point Clouds*, CVPR 2021, Sec. 3.2.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.networks.skeletal_points import SkeletalPoints


class InitialGraph(NamedTuple):
    """What the cloud tells about the links of its skeleton; all ``(B, K, K)`` bool, symmetric, diagonal False.

    Parameters
    ----------
    links
        Links that certainly exist.
    valid
        Links that may exist: the certain ones and those between near neighbours.
    known
        Pairs of which it is known whether they are linked: the certain links and the pairs that are far apart.
    """

    links: Tensor
    valid: Tensor
    known: Tensor


@torch.no_grad()
def initial_graph(points: Tensor, centres: Tensor, valid_neighbours: int) -> InitialGraph:
    """Link the two skeletal points that are nearest to any one surface point, and each to its own nearest.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float, the cloud.
    centres
        ``(B, K, 3)`` float, the skeletal points.
    valid_neighbours
        Skeletal points among the nearest this many, itself included, may be linked; all others are known not to be.

    Returns
    -------
    InitialGraph
        The pairs that are valid but not linked are unknown: they are what the network has to decide.
    """
    count = centres.shape[1]
    links = torch.zeros(len(centres), count, count, dtype=torch.bool, device=centres.device)
    rows = torch.arange(len(centres), device=centres.device)[:, None]
    nearest = _distances(points, centres).topk(2, dim=-1, largest=False).indices
    links[rows, nearest[..., 0], nearest[..., 1]] = True

    between = _distances(centres, centres)
    between.diagonal(dim1=1, dim2=2).fill_(-1)  # each is the nearest to itself, even if others coincide with it
    order = between.sort(dim=-1, stable=True).indices
    near = torch.zeros_like(links).scatter_(2, order[..., 1:valid_neighbours], True)
    links = links.scatter(2, order[..., 1:2], True)
    far = torch.zeros_like(links).scatter_(2, order[..., valid_neighbours:], True)
    links, near, far = (pairs | pairs.transpose(1, 2) for pairs in (links, near, far))
    return InitialGraph(links, links | near, links | far)


def _distances(points: Tensor, targets: Tensor) -> Tensor:
    return torch.cdist(points, targets, compute_mode="donot_use_mm_for_euclid_dist")


def propagation_matrix(links: Tensor) -> Tensor:
    """Return ``D^(-1/2) (A + I) D^(-1/2)`` of a graph, ``(B, K, K)``; D holds the degrees with the self-links.

    Source: Kipf and Welling, *Semi-Supervised Classification with Graph Convolutional Networks*, ICLR 2017, Sec. 2.
    """
    linked = links.float() + torch.eye(links.shape[-1], device=links.device)
    scale = linked.sum(dim=-1).rsqrt()
    return scale[:, :, None] * linked * scale[:, None, :]


class GraphConvolution(nn.Module):
    """Mix each node with its neighbours, linearly, and normalise; a residual connection if asked for.

    Batches are normalised with their own statistics, in training and after: one skeleton is a batch of K nodes.
    """

    def __init__(self, inputs: int, outputs: int, *, residual: bool) -> None:
        super().__init__()
        self.linear = nn.Linear(inputs, outputs, bias=False)
        self.normalise = nn.BatchNorm1d(outputs, track_running_stats=False)
        self.shortcut: nn.Module | None = None
        if residual and inputs == outputs:
            self.shortcut = nn.Identity()
        elif residual:
            self.shortcut = nn.Sequential(
                nn.Linear(inputs, outputs, bias=False), nn.BatchNorm1d(outputs, track_running_stats=False)
            )

    def forward(self, nodes: Tensor, propagation: Tensor) -> Tensor:
        """Return ``(B, K, outputs)`` from nodes ``(B, K, inputs)`` and a :func:`propagation_matrix`."""
        mixed = self.normalise(self.linear(propagation @ nodes).flatten(0, 1))
        if self.shortcut is not None:
            mixed = mixed + self.shortcut(nodes.flatten(0, 1))
        return functional.relu(mixed).view(*nodes.shape[:2], -1)


class LinkNetwork(nn.Module):
    """Graph auto-encoder: codes of the skeletal points whose inner products are high where they are linked.

    Parameters
    ----------
    features
        Channels of the features of a skeletal point.
    settings
        Sizes of the layers.
    """

    def __init__(self, features: int, settings: Point2SkeletonSettings) -> None:
        super().__init__()
        self.reduce = nn.Linear(features, settings.node_features, bias=False)
        self.normalise = nn.BatchNorm1d(settings.node_features, track_running_stats=False)
        *hidden, codes = settings.graph_channels
        sizes = (settings.node_features + 4, *hidden)
        # The first two convolutions have no shortcut, as in the released program.
        self.convolutions = nn.ModuleList(
            GraphConvolution(*pair, residual=layer >= 2) for layer, pair in enumerate(pairwise(sizes))
        )
        self.code = nn.Linear(sizes[-1], codes, bias=False)

    def forward(self, nodes: Tensor, links: Tensor) -> Tensor:
        """Score all pairs.

        Parameters
        ----------
        nodes
            ``(B, K, features + 4)`` float, see :func:`node_inputs`.
        links
            ``(B, K, K)`` bool, the initial links, along which the nodes exchange what they know.

        Returns
        -------
        Tensor
            ``(B, K, K)`` symmetric scores, the logits of the links.
        """
        propagation = propagation_matrix(links)
        features, balls = nodes[..., :-4], nodes[..., -4:]
        reduced = self.normalise(functional.relu(self.reduce(features)).flatten(0, 1)).view(*features.shape[:2], -1)
        values = torch.cat([reduced, balls], dim=-1)
        for convolution in self.convolutions:
            values = convolution(values, propagation)
        codes = self.code(propagation @ values)
        scores: Tensor = codes @ codes.transpose(1, 2)
        return scores


def node_inputs(skeletal: SkeletalPoints) -> Tensor:
    """Return ``(B, K, F + 4)``: features, centre and radius of each skeletal point, without gradient."""
    return torch.cat([skeletal.features, skeletal.centres, skeletal.radii[..., None]], dim=-1).detach()


def predicted_links(scores: Tensor, valid: Tensor, threshold: float) -> Tensor:
    """Return ``(B, K, K)`` bool: the valid pairs whose score is above the threshold."""
    return (scores > threshold) & valid
