"""PointNet++ with multi-scale grouping: local features of a subset of the points of a cloud.

Source: Qi et al., *PointNet++: Deep Hierarchical Feature Learning on Point Sets in a Metric Space*, NeurIPS 2017.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import torch
from torch import Tensor, nn
from torch.nn import functional


@torch.no_grad()
def farthest_points(points: Tensor, count: int) -> Tensor:
    """Order points so that each is the farthest from all before it, starting with the first.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float.
    count
        Points wanted of each cloud, between 1 and N.

    Returns
    -------
    Tensor
        ``(B, count)`` int64 indices. Among equally far points the one of smallest index comes first.

    Notes
    -----
    The order is greedy, so each of its prefixes is the order of a smaller `count`, and the farthest points *of a
    prefix* are its own first points. The encoder relies on that to sample all of its levels at once.
    """
    batch, available, _ = points.shape
    if not 1 <= count <= available:
        raise ValueError(f"count: expected 1 to {available}, the number of points, got {count}")
    rows = torch.arange(batch, device=points.device)
    chosen = torch.zeros(batch, count, dtype=torch.int64, device=points.device)
    nearest = torch.full((batch, available), torch.inf, dtype=points.dtype, device=points.device)
    for step in range(1, count):
        last = points[rows, chosen[:, step - 1]]
        nearest = torch.minimum(nearest, (points - last[:, None]).square().sum(dim=-1))
        chosen[:, step] = nearest.argmax(dim=1)
    return chosen


@torch.no_grad()
def ball_query(distances: Tensor, radius: float, neighbours: int) -> Tensor:
    """Find points inside balls.

    Parameters
    ----------
    distances
        ``(B, M, N)`` float, from the centres of the balls to the points.
    radius
        Of every ball, in the same units; points at just this distance are inside.
    neighbours
        Indices wanted for each ball.

    Returns
    -------
    Tensor
        ``(B, M, neighbours)`` int64: the inside points of smallest index, ascending. If there are too few, the first
        one is repeated; if there are none, the nearest point stands in.
    """
    available = distances.shape[-1]
    inside = distances <= distances.amin(dim=-1, keepdim=True).clamp(min=radius)
    order = torch.arange(available, device=distances.device, dtype=torch.int32)
    ranked = torch.where(inside, order, available)
    found = ranked.topk(min(neighbours, available), dim=-1, largest=False, sorted=True).values.long()
    found = functional.pad(found, (0, neighbours - found.shape[-1]), value=available)
    return torch.where(found < available, found, found[..., :1])


def gather_rows(values: Tensor, indices: Tensor) -> Tensor:
    """Return rows of each cloud of a batch.

    Parameters
    ----------
    values
        ``(B, N, C)`` float.
    indices
        ``(B, ...)`` int64, below N.

    Returns
    -------
    Tensor
        ``(B, ..., C)``. The gradient of a row that is taken several times is summed in a fixed order on a CPU.
    """
    batch, available, _ = values.shape
    first = torch.arange(batch, device=values.device) * available
    return functional.embedding(indices + first.view(-1, *[1] * (indices.dim() - 1)), values.flatten(0, 1))


class BallFeatures(nn.Module):
    """One scale of a set abstraction: shared layers on the points of each ball, then their maximum.

    Parameters
    ----------
    inputs
        Channels of the points' features, 0 if they have positions only.
    channels
        Of each layer; every layer is linear, batch normalisation, ReLU.
    """

    def __init__(self, inputs: int, channels: Sequence[int]) -> None:
        super().__init__()
        sizes = (3 + inputs, *channels)
        self.linear = nn.ModuleList(nn.Linear(*pair, bias=False) for pair in pairwise(sizes))
        self.normalise = nn.ModuleList(nn.BatchNorm1d(size) for size in channels)

    def forward(self, points: Tensor, features: Tensor | None, centres: Tensor, neighbours: Tensor) -> Tensor:
        """Describe each ball.

        Parameters
        ----------
        points, features
            ``(B, N, 3)`` and ``(B, N, inputs)``, or no features.
        centres
            ``(B, M, 3)``, the centres of the balls.
        neighbours
            ``(B, M, S)`` int64, the points of each ball.

        Returns
        -------
        Tensor
            ``(B, M, channels[-1])``.
        """
        # The first layer sees (x_j - c_i, f_j). It is linear, so it is applied to the N points and the M centres, and
        # not to the M * S pairs: W (x_j - c_i, f_j) = (V x_j + U f_j) - V c_i.
        first, *linears = self.linear
        normalise_first, *normalisations = self.normalise
        weight = first.get_parameter("weight")
        at_points = functional.linear(points, weight[:, :3])
        if features is not None:
            at_points = at_points + functional.linear(features, weight[:, 3:])
        at_centres = functional.linear(centres, weight[:, :3])
        values = (gather_rows(at_points, neighbours) - at_centres[:, :, None]).flatten(0, 2)
        values = functional.relu(normalise_first(values), inplace=True)
        for linear, normalise in zip(linears, normalisations, strict=True):
            values = functional.relu(normalise(linear(values)), inplace=True)
        pooled: Tensor = values.view(*neighbours.shape, -1).max(dim=2).values
        return pooled


class SetAbstraction(nn.Module):
    """One level of the encoder: balls of several radii around the same centres.

    Parameters
    ----------
    inputs
        Channels of the points' features, 0 if they have positions only.
    radii
        One a scale, in the units of the points.
    neighbours
        Most points used of a ball, one a scale.
    channels
        Of the layers of each scale, the same for all.
    """

    def __init__(self, inputs: int, radii: Sequence[float], neighbours: Sequence[int], channels: Sequence[int]) -> None:
        super().__init__()
        self.balls = tuple(zip(radii, neighbours, strict=True))
        self.scales = nn.ModuleList(BallFeatures(inputs, channels) for _ in self.balls)

    def forward(self, points: Tensor, features: Tensor | None, centres: Tensor) -> Tensor:
        """Return ``(B, M, scales * channels[-1])`` features of the `centres`, ``(B, M, 3)``."""
        distances = torch.cdist(centres, points, compute_mode="donot_use_mm_for_euclid_dist")
        described = [
            scale(points, features, centres, ball_query(distances, radius, neighbours))
            for scale, (radius, neighbours) in zip(self.scales, self.balls, strict=True)
        ]
        return torch.cat(described, dim=-1)


class PointNet2Encoder(nn.Module):
    """Levels of set abstraction, each on the farthest points of the level before.

    Parameters
    ----------
    centroids
        Points kept by each level, not increasing.
    radii, neighbours
        For each level, the radius and the most points used of each scale.
    channels
        For each level, the channels of the layers of a scale.
    """

    def __init__(
        self,
        centroids: Sequence[int],
        radii: Sequence[Sequence[float]],
        neighbours: Sequence[Sequence[int]],
        channels: Sequence[Sequence[int]],
    ) -> None:
        super().__init__()
        self.centroids = tuple(centroids)
        self.levels = nn.ModuleList()
        inputs = 0
        for level_radii, level_neighbours, level_channels in zip(radii, neighbours, channels, strict=True):
            self.levels.append(SetAbstraction(inputs, level_radii, level_neighbours, level_channels))
            inputs = len(level_radii) * level_channels[-1]
        self.features = inputs

    def forward(self, points: Tensor) -> tuple[Tensor, Tensor]:
        """Encode clouds.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float, N at least the first number of centroids.

        Returns
        -------
        tuple of Tensor
            Positions of the last level's M points, ``(B, M, 3)``, which are input points, and their features,
            ``(B, M, features)``.
        """
        centres = gather_rows(points, farthest_points(points, self.centroids[0]))
        positions, features = points, None
        for count, level in zip(self.centroids, self.levels, strict=True):
            centres = centres[:, :count]  # the farthest points of a level are its first ones, see farthest_points
            features = level(positions, features, centres)
            positions = centres
        if features is None:
            raise ValueError("the encoder needs at least one level")
        return positions, features
