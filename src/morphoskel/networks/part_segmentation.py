"""The PointNet that tells the parts of clouds, and the file that holds a trained one.

Source: Qi et al., *PointNet: Deep Learning on Point Sets for 3D Classification and Segmentation*, CVPR 2017, Sec. 4.3
and the supplement's Sec. C, and the program released with it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.errors import ConfigError
from morphoskel.networks.network_file import read_network, write_network
from morphoskel.networks.normalised_linear import NormalisedLinear, pooled
from morphoskel.networks.pointnet import TransformNetwork
from morphoskel.networks.segmentation_settings import SegmentationSettings

DROPPED_LAYERS = 2
"""Layers of the head after which channels are dropped."""


@dataclass(frozen=True)
class Segmentation:
    """What the network says of a batch of clouds.

    Parameters
    ----------
    logits
        ``(B, N, P)``, of all parts at every point.
    feature_transform
        ``(B, C, C)``, see :func:`~morphoskel.networks.pointnet_classifier.transform_penalty`.
    """

    logits: Tensor
    feature_transform: Tensor


class SegmentationHead(nn.Module):
    """Rate the parts at every point from the features of its cloud and those of its own, of several layers.

    Parameters
    ----------
    cloud
        Channels of the features of a cloud.
    local
        Channels of the features of a point, of each layer.
    channels
        Of the layers of the head.
    dropout
        Share of the channels dropped after the first two of them.
    parts
        To rate.

    Notes
    -----
    The first layer is a linear map of all those features side by side. They are never put side by side, which would
    repeat those of the cloud at each of its points and copy the others: the parts of the map are applied where the
    features are, and what they give is added.
    """

    def __init__(self, cloud: int, local: Sequence[int], channels: Sequence[int], dropout: float, parts: int) -> None:
        super().__init__()
        self.sizes = [cloud, *local]
        self.first = nn.Linear(sum(self.sizes), channels[0], bias=False)
        self.normalise = nn.BatchNorm1d(channels[0])
        self.layers = nn.ModuleList(NormalisedLinear(*pair) for pair in pairwise(channels))
        self.dropout = nn.Dropout(dropout)
        self.classify = nn.Linear(channels[-1], parts)

    def forward(self, cloud: Tensor, local: Sequence[Tensor]) -> Tensor:
        """Return ``(B, N, P)`` logits for ``(B, G)`` features of the clouds and ``(B, N, C)`` of every layer."""
        of_cloud, *of_local = torch.split(self.first.weight, self.sizes, dim=1)
        values = functional.linear(cloud, of_cloud)[:, None]
        for features, weight in zip(local, of_local, strict=True):
            values = values + functional.linear(features, weight)
        values = self.normalise(values.flatten(0, 1)).unflatten(0, values.shape[:2])
        values = self.dropout(functional.relu(values))
        for number, layer in enumerate(self.layers, start=2):
            values = functional.relu(layer(values), inplace=True)
            if number <= DROPPED_LAYERS:
                values = self.dropout(values)
        logits: Tensor = self.classify(values)
        return logits


class PartSegmentationNetwork(nn.Module):
    """Tell the parts of clouds of any number of points, one network for all categories.

    Parameters
    ----------
    part_classes
        The label of the category to which each of all P parts belongs, -1 for a part of none of them.
    class_names
        Names of the categories, in the order of their labels.
    settings
        Sizes, and how to use it; what belongs to the training is kept with the file.

    Attributes
    ----------
    origin
        How it was trained, for those who use its file: plain values such as the sampler's name; empty before.

    Raises
    ------
    ConfigError
        If a category has no part, or a part's category has no name.
    """

    def __init__(self, part_classes: Sequence[int], class_names: Sequence[str], settings: SegmentationSettings) -> None:
        super().__init__()
        self.part_classes = tuple(int(label) for label in part_classes)
        self.class_names = tuple(str(name) for name in class_names)
        if not self.part_classes or set(self.part_classes) - {-1} != set(range(len(self.class_names))):
            raise ConfigError(
                f"part_classes: expected parts of each of the {len(self.class_names)} categories "
                f"{', '.join(self.class_names)}, got parts of {sorted(set(self.part_classes))}"
            )
        self.settings = settings
        self.origin: dict[str, Any] = {}
        before, after = settings.before, (*settings.after, settings.cloud_features)
        self.point_transform = TransformNetwork(3, settings.point_transform_channels, settings.point_transform_head)
        self.before = nn.ModuleList(NormalisedLinear(*pair) for pair in pairwise((3, *before)))
        self.feature_transform = TransformNetwork(
            before[-1], settings.feature_transform_channels, settings.feature_transform_head
        )
        for transform in (self.point_transform, self.feature_transform):
            nn.init.zeros_(transform.matrix.weight)  # nothing is transformed in the beginning
            nn.init.zeros_(transform.matrix.bias)
        self.after = nn.ModuleList(NormalisedLinear(*pair) for pair in pairwise((before[-1], *after)))
        cloud = settings.cloud_features + (len(self.class_names) if settings.know_category else 0)
        self.head = SegmentationHead(cloud, (*before, *after), settings.head, settings.dropout, len(self.part_classes))

    def forward(self, points: Tensor, categories: Tensor) -> Segmentation:
        """Rate the parts.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float32, any N at least 1, normalised. In evaluation mode what is said of a point depends
            neither on the order of the points nor on points that repeat others.
        categories
            ``(B,)`` int64, the labels of the clouds' categories.
        """
        values = points @ self.point_transform(points)
        local = []
        for layer in self.before:
            values = functional.relu(layer(values), inplace=True)
            local.append(values)
        transform = self.feature_transform(values)
        values = values @ transform
        for layer in self.after:
            values = functional.relu(layer(values), inplace=True)
            local.append(values)
        cloud = pooled(values)
        if self.settings.know_category:
            known = functional.one_hot(categories, len(self.class_names)).to(cloud.dtype)
            cloud = torch.cat([cloud, known], dim=1)
        return Segmentation(self.head(cloud, local), transform)


def predict_parts(
    network: PartSegmentationNetwork,
    points: npt.NDArray[np.float32],
    categories: npt.NDArray[np.int64],
    batch: int = 16,
) -> npt.NDArray[np.int64]:
    """Tell the part of every point.

    Parameters
    ----------
    network
        In evaluation mode, as it is loaded; on any device.
    points
        ``(S, N, 3)`` float32, normalised clouds.
    categories
        ``(S,)`` int64, the labels of their categories.
    batch
        Clouds at a time.

    Returns
    -------
    ndarray
        ``(S, N)`` int64, of the parts of the cloud's category if the network's settings restrict it to them.

    Raises
    ------
    ValueError
        If the network is in training mode, in which the parts of a cloud depend on the others.
    """
    if network.training:
        raise ValueError("predict_parts: expected a network in evaluation mode; call eval() first")
    device = next(network.parameters()).device
    others = torch.tensor(network.part_classes)[None] != torch.arange(len(network.class_names))[:, None]
    found = [np.empty((0, points.shape[1]), dtype=np.int64)]
    places = range(batch, len(points), batch)
    with torch.inference_mode():
        for part, labels in zip(np.split(points, places), np.split(categories, places), strict=True):
            known = torch.from_numpy(np.ascontiguousarray(labels))
            logits = network(torch.from_numpy(np.ascontiguousarray(part)).to(device), known.to(device)).logits
            if network.settings.restrict_to_category:
                logits = logits.masked_fill(others[known][:, None].to(device), -torch.inf)
            found.append(logits.argmax(dim=2).cpu().numpy())
    return np.concatenate(found)


def save_segmentation(network: PartSegmentationNetwork, path: Path) -> None:
    """Write weights, settings, categories, parts and origin to one file, whole or not at all."""
    write_network(
        network, path, settings=network.settings.as_mapping(), class_names=list(network.class_names),
        part_classes=list(network.part_classes), origin=network.origin,
    )  # fmt: skip


def load_segmentation(path: Path | str) -> PartSegmentationNetwork:
    """Read a trained network.

    Parameters
    ----------
    path
        A file written by :func:`save_segmentation`.

    Returns
    -------
    PartSegmentationNetwork
        On the CPU, in evaluation mode.

    Raises
    ------
    InputError
        If the file is missing, or is not such a network.
    """
    with read_network(path, "part segmentation") as content:
        settings = SegmentationSettings(**content["settings"])
        network = PartSegmentationNetwork(content["part_classes"], content["class_names"], settings)
        network.load_state_dict(content["weights"])
        network.origin = content["origin"]
    return network.eval()
