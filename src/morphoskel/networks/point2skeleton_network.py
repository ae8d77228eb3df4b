"""Both networks of Point2Skeleton as one, and the file that holds a trained one."""

from __future__ import annotations

import pickle
from pathlib import Path

import torch
from torch import nn

from morphoskel.atomic import atomic_file
from morphoskel.errors import ConfigError, InputError
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.networks.skeletal_links import LinkNetwork
from morphoskel.networks.skeletal_points import SkeletalPointNetwork


class Point2SkeletonNetwork(nn.Module):
    """The network that predicts skeletal points and the one that links them.

    Parameters
    ----------
    settings
        Sizes of the layers.
    """

    def __init__(self, settings: Point2SkeletonSettings) -> None:
        super().__init__()
        self.settings = settings
        self.skeletal_points = SkeletalPointNetwork(settings)
        self.links = LinkNetwork(self.skeletal_points.encoder.features, settings)


def save_network(network: Point2SkeletonNetwork, path: Path) -> None:
    """Write weights and settings to one file, whole or not at all."""
    content = {"settings": network.settings.as_mapping(), "weights": network.state_dict()}
    with atomic_file(path) as partial:
        torch.save(content, partial)


def load_point2skeleton(path: Path | str) -> Point2SkeletonNetwork:
    """Read a trained network.

    Parameters
    ----------
    path
        A ``network.pt`` written after training.

    Returns
    -------
    Point2SkeletonNetwork
        On the CPU, in evaluation mode.

    Raises
    ------
    InputError
        If the file is missing, or is not such a network.
    """
    try:
        content = torch.load(path, map_location="cpu", weights_only=True)
        network = Point2SkeletonNetwork(Point2SkeletonSettings(**content["settings"]))
        network.load_state_dict(content["weights"])
    except FileNotFoundError as error:
        raise InputError(f"{path}: no trained Point2Skeleton network there; train one first") from error
    except (RuntimeError, KeyError, TypeError, EOFError, pickle.UnpicklingError, ConfigError) as error:
        raise InputError(f"{path}: not a Point2Skeleton network of this version ({error}); train it again") from error
    return network.eval()
