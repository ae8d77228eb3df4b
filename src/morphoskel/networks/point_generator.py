"""The network that generates the points of a simplified cloud, and the file that holds a trained one.

Source: Dovrat et al., *Learning to Sample*, CVPR 2019, "S-NET", and the program released with it; SampleNet
(Lang et al., CVPR 2020) and Meta-Sampler (Cheng et al., ECCV 2022) project the points that the same network generates.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.networks.generator_settings import GeneratorSettings
from morphoskel.networks.network_file import read_network, write_network
from morphoskel.networks.soft_projection import SoftProjection


class PointGenerator(nn.Module):
    """Shared layers on every point, the maximum over the points, and a head that gives coordinates.

    Parameters
    ----------
    samples
        Points generated of every cloud, M.
    settings
        Sizes of the layers, whether the coordinates are normalised, and the projection.

    Attributes
    ----------
    projection
        :class:`~morphoskel.networks.soft_projection.SoftProjection` with its learned temperature, or None. Generating
        does not apply it: it is a part of the training only, since at the end the generated points are matched.
    origin
        How it was trained, for those who use its file: plain values such as the sampler's name; empty before.

    Notes
    -----
    The PyTorch programs arrange the last layer's 3 M outputs as ``(3, M)`` and the TensorFlow ones as ``(M, 3)``. That
    only renumbers the units of the layer, so it is no choice here.
    """

    def __init__(self, samples: int, settings: GeneratorSettings) -> None:
        super().__init__()
        self.samples = samples
        self.origin: dict[str, Any] = {}
        self.settings = settings
        point_sizes = (3, *settings.point_channels)
        self.point_layers = nn.ModuleList(nn.Linear(*pair, bias=False) for pair in pairwise(point_sizes))
        self.point_normalisations = nn.ModuleList(nn.BatchNorm1d(size) for size in point_sizes[1:])
        head_sizes = (point_sizes[-1], *settings.head_channels)
        self.head_layers = nn.ModuleList(nn.Linear(*pair, bias=False) for pair in pairwise(head_sizes))
        self.head_normalisations = nn.ModuleList(nn.BatchNorm1d(size) for size in head_sizes[1:])
        self.coordinates = nn.Linear(head_sizes[-1], 3 * samples, bias=not settings.normalise_output)
        self.coordinate_normalisation = nn.BatchNorm1d(3 * samples) if settings.normalise_output else nn.Identity()
        self.projection = SoftProjection(settings.neighbours, settings.least_sigma) if settings.neighbours else None

    def forward(self, points: Tensor) -> Tensor:
        """Generate points.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float32, normalised to the unit sphere; B at least 2 while training.

        Returns
        -------
        Tensor
            ``(B, M, 3)`` float32, anywhere in space. They do not depend on the order of the input points.
        """
        batch, available, _ = points.shape
        values = points.reshape(-1, 3)
        for layer, normalise in zip(self.point_layers, self.point_normalisations, strict=True):
            values = functional.relu(normalise(layer(values)), inplace=True)
        values = values.view(batch, available, -1).max(dim=1).values
        for layer, normalise in zip(self.head_layers, self.head_normalisations, strict=True):
            values = functional.relu(normalise(layer(values)), inplace=True)
        coordinates: Tensor = self.coordinate_normalisation(self.coordinates(values))
        return coordinates.view(batch, self.samples, 3)


@torch.no_grad()
def generate(network: PointGenerator, points: Tensor, batch_size: int) -> Tensor:
    """Generate the points of any number of clouds with a network in evaluation mode.

    Parameters
    ----------
    network
        Its mode is left as it is found.
    points
        ``(S, N, 3)`` float32, normalised to the unit sphere.
    batch_size
        Clouds at a time; it does not change the result but for rounding.

    Returns
    -------
    Tensor
        ``(S, M, 3)`` float32, without gradients; to be matched to input points by
        :func:`~morphoskel.sampling.matching.match_clouds`.
    """
    training = network.training
    network.eval()
    generated = torch.cat([network(part) for part in torch.split(points, batch_size)])
    network.train(training)
    return generated


def save_generator(network: PointGenerator, path: Path) -> None:
    """Write weights, temperature, settings and number of points to one file, whole or not at all."""
    write_network(network, path, samples=network.samples, settings=network.settings.as_mapping(), origin=network.origin)


def load_generator(path: Path | str) -> PointGenerator:
    """Read a trained generator.

    Parameters
    ----------
    path
        A file that :func:`save_generator` wrote.

    Returns
    -------
    PointGenerator
        On the CPU, in evaluation mode.

    Raises
    ------
    InputError
        If the file is missing, or is not such a network.
    """
    with read_network(path, "generator of points") as content:
        network = PointGenerator(content["samples"], GeneratorSettings(**content["settings"]))
        network.load_state_dict(content["weights"])
        network.origin = content["origin"]
    return network.eval()
