"""Features of the points of a cloud by edge convolutions on graphs drawn anew before each of them.

Source: Wang et al., *Dynamic Graph CNN for Learning on Point Clouds*, ACM Transactions on Graphics 38, 2019, section 3;
sizes as in Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.networks.edge_convolution import EdgeConvolution
from morphoskel.networks.feature_neighbours import nearest_in_features

SLOPE = 0.2
"""Of all activations below 0."""


class EdgeFeatures(nn.Module):
    """Features that know the neighbourhood of a point, at several scales, and the whole cloud.

    Parameters
    ----------
    channels
        Outputs of the edge convolutions; each one's graph joins the points whose features before it are most alike.
    k
        Neighbours of each point in these graphs, the point itself included.
    global_features
        Features of the cloud, the largest over its points of a layer on the outputs of all edge convolutions.
    head
        Outputs of the last layers, which see the outputs of all edge convolutions, followed by the cloud's features.

    Notes
    -----
    The features of the cloud are the same for all its points. So the first layer of the head multiplies them once a
    cloud, and adds the product to that of each point; the function is that of a layer on both together.
    """

    def __init__(
        self, *, channels: Sequence[int] = (64, 64, 128, 256), k: int, global_features: int = 512, head: Sequence[int]
    ) -> None:
        super().__init__()
        self.k = k
        local = sum(channels)
        sizes = (local + global_features, *head)
        self.edges = nn.ModuleList(EdgeConvolution(*pair, slope=SLOPE) for pair in pairwise((3, *channels)))
        self.cloud = nn.Linear(local, global_features, bias=False)
        self.normalise_cloud = nn.BatchNorm1d(global_features)
        self.head = nn.ModuleList(nn.Linear(*pair, bias=False) for pair in pairwise(sizes))
        self.normalise_head = nn.ModuleList(nn.BatchNorm1d(size) for size in head)

    def forward(self, points: Tensor) -> Tensor:
        """Describe points.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float, N at least `k`.

        Returns
        -------
        Tensor
            ``(B, N, head[-1])``.

        Raises
        ------
        InputError
            If there are fewer points than `k`; on a CPU also if they are not finite.
        """
        features, levels = points, []
        for layer in self.edges:
            features = layer(features, nearest_in_features(features, self.k))
            levels.append(features)
        local = torch.cat(levels, dim=-1)
        cloud = _activate(self.cloud(local), self.normalise_cloud).amax(dim=1)
        first, *others = self.head
        weight, width = first.get_parameter("weight"), local.shape[2]
        from_cloud = functional.linear(cloud, weight[:, width:])
        values = functional.linear(local, weight[:, :width]) + from_cloud.unsqueeze(1)
        values = _activate(values, self.normalise_head[0])
        for linear, normalise in zip(others, self.normalise_head[1:], strict=True):
            values = _activate(linear(values), normalise)
        return values


def _activate(values: Tensor, normalise: nn.Module) -> Tensor:
    normalised = normalise(values.flatten(0, 1))
    return functional.leaky_relu(normalised, SLOPE, inplace=True).view(values.shape)  # in place on a view copies it
