"""The three phases in which Point2Skeleton is trained.

Source: Lin et al., *Point2Skeleton: Learning Skeletal Representations from Point Clouds*, CVPR 2021, Sec. 4.
"""

from __future__ import annotations

import torch
from torch import Tensor

from morphoskel.learning.point2skeleton_losses import link_loss, skeleton_loss, summed_chamfer_loss
from morphoskel.learning.resumable_fit import BatchedPhase
from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork
from morphoskel.networks.skeletal_links import InitialGraph, initial_graph, node_inputs

PRETRAIN = "pretrain"
SKELETON = "skeleton"
LINKS = "links"


class SkeletalPointPhase(BatchedPhase):
    """Train the skeletal points: first to spread over the shape, then to be centres of balls that fill it.

    Parameters
    ----------
    name
        ``"pretrain"`` or ``"skeleton"``.
    network
        Its skeletal points are trained in place.
    training, validation
        ``(S, N, 3)`` float32, prepared clouds.
    seed
        Of the training.
    """

    def __init__(
        self, name: str, network: Point2SkeletonNetwork, training: Tensor, validation: Tensor, seed: int
    ) -> None:
        super().__init__(name, (training,), (validation,), network.settings.batch_size, seed)
        self.network = network.skeletal_points
        self.settings = network.settings

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the loss of clouds ``(B, N, 3)``."""
        (points,) = batch
        skeletal = self.network(points)
        if self.name == PRETRAIN:
            return self.settings.pretrain_weight * summed_chamfer_loss(points, skeletal.centres)
        return skeleton_loss(
            points,
            skeletal.centres,
            skeletal.radii,
            point_to_sphere_weight=self.settings.point_to_sphere_weight,
            radius_weight=self.settings.radius_weight,
        )

    def configure_optimizers(self) -> torch.optim.Optimizer:
        """Return Adam with a fixed learning rate."""
        return torch.optim.Adam(self.network.parameters(), lr=self.settings.learning_rate)


class LinkPhase(BatchedPhase):
    """Train the links between skeletal points that no longer change.

    Parameters
    ----------
    network
        Its links are trained in place, its skeletal points are used as they are.
    training, validation
        ``(S, N, 3)`` float32, prepared clouds.
    seed
        Of the training.

    Notes
    -----
    The skeletal points are frozen, so they and their graphs are computed once and not in every epoch. They take
    ``K * (F + 4)`` float32 values a shape: 0.2 MB at the published sizes.
    """

    def __init__(self, network: Point2SkeletonNetwork, training: Tensor, validation: Tensor, seed: int) -> None:
        super().__init__(LINKS, (training,), (validation,), network.settings.batch_size, seed)
        self.network = network

    def on_fit_start(self) -> None:
        """Replace the clouds by the graphs of their skeletons; the network is on its device by now."""
        self.training_tensors = skeletal_graphs(self.network, self.training_tensors[0], self.device)
        self.validation_tensors = skeletal_graphs(self.network, self.validation_tensors[0], self.device)

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the loss of graphs, see :func:`skeletal_graphs`."""
        nodes, *pairs = batch
        graph = InitialGraph(*pairs)
        return link_loss(self.network.links(nodes, graph.links), graph)

    def configure_optimizers(self) -> torch.optim.Optimizer:
        """Return Adam with a fixed learning rate, for the links only."""
        return torch.optim.Adam(self.network.links.parameters(), lr=self.network.settings.link_learning_rate)


@torch.no_grad()
def skeletal_graphs(network: Point2SkeletonNetwork, clouds: Tensor, device: torch.device) -> tuple[Tensor, ...]:
    """Skeletonize clouds and link their skeletal points as far as the clouds tell.

    Parameters
    ----------
    network
        On the device; put into evaluation mode for the call.
    clouds
        ``(S, N, 3)`` float32, prepared clouds on the CPU.
    device
        Where to compute.

    Returns
    -------
    tuple of Tensor
        On the CPU: the inputs of the nodes, ``(S, K, F + 4)`` float32, and the three masks of an
        :class:`~morphoskel.networks.skeletal_links.InitialGraph`, ``(S, K, K)`` bool.
    """
    was_training = network.training
    network.eval()
    parts: list[tuple[Tensor, ...]] = []
    for points in torch.split(clouds, network.settings.batch_size):
        skeletal = network.skeletal_points(points.to(device))
        graph = initial_graph(points.to(device), skeletal.centres, network.settings.valid_neighbours)
        parts.append(tuple(part.cpu() for part in (node_inputs(skeletal), *graph)))
    network.train(was_training)
    return tuple(torch.cat(column) for column in zip(*parts, strict=True))
