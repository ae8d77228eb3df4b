"""The skeleton-aware sampler: logits of every point for every sample, from features scaled by the skeleton prior.

Source: Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023, and the program released with it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from torch import Tensor, nn

from morphoskel.errors import ConfigError
from morphoskel.networks.edge_features import EdgeFeatures
from morphoskel.networks.network_file import read_network, write_network
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings


class SkeletonSampler(nn.Module):
    """Rate the points of a cloud for each of the samples.

    Parameters
    ----------
    samples
        Points to choose, M.
    settings
        Sizes of the layers.

    Attributes
    ----------
    origin
        How it was trained, for those who use its file: plain values such as the sampler's name; empty before.

    Raises
    ------
    ConfigError
        If no point is to be chosen.

    Notes
    -----
    The released program also holds a network for a mutual-information term that it never uses; it is left out. Its
    last layer has a bias, which adds the same number to the logits of all points of a sample, so that no softmax and no
    choice depends on it; it is left out, too.
    """

    def __init__(self, samples: int, settings: SkeletonSamplerSettings) -> None:
        super().__init__()
        if samples < 1:
            raise ConfigError(f"samples: expected at least 1 point to choose, got {samples}")
        self.samples = samples
        self.origin: dict[str, Any] = {}
        self.settings = settings
        self.features = EdgeFeatures(
            channels=settings.channels, k=settings.k, global_features=settings.global_features, head=settings.head
        )
        self.dropout = nn.Dropout(settings.dropout)
        self.linear = nn.Linear(settings.head[-1], samples, bias=False)

    def forward(self, points: Tensor, weights: Tensor) -> Tensor:
        """Rate points.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float32, normalised clouds.
        weights
            ``(B, N)`` float32, the prior, see :func:`~morphoskel.sampling.prior.prior_weights`.

        Returns
        -------
        Tensor
            ``(B, M, N)`` logits for :mod:`morphoskel.sampling.gumbel`.
        """
        weighted = self.features(points) * weights[..., None]
        logits: Tensor = self.linear(self.dropout(weighted))
        return logits.transpose(1, 2)


def save_skeleton_sampler(network: SkeletonSampler, path: Path) -> None:
    """Write weights, settings and the number of samples to one file, whole or not at all."""
    write_network(network, path, samples=network.samples, settings=network.settings.as_mapping(), origin=network.origin)


def load_skeleton_sampler(path: Path | str) -> SkeletonSampler:
    """Read a trained sampler.

    Parameters
    ----------
    path
        A file written by :func:`save_skeleton_sampler`.

    Returns
    -------
    SkeletonSampler
        On the CPU, in evaluation mode.

    Raises
    ------
    InputError
        If the file is missing, or is not such a network.
    """
    with read_network(path, "skeleton-aware sampler") as content:
        network = SkeletonSampler(content["samples"], SkeletonSamplerSettings(**content["settings"]))
        network.load_state_dict(content["weights"])
        network.origin = content["origin"]
    return network.eval()
