"""Both networks of Point2Skeleton as one, and the file that holds a trained one."""

from __future__ import annotations

from pathlib import Path

from torch import nn

from morphoskel.networks.network_file import read_network, write_network
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
    write_network(network, path, settings=network.settings.as_mapping())


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
    with read_network(path, "Point2Skeleton network") as content:
        network = Point2SkeletonNetwork(Point2SkeletonSettings(**content["settings"]))
        network.load_state_dict(content["weights"])
    return network.eval()
