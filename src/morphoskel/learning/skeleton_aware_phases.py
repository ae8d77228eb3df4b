"""The two phases in which the skeleton network of the skeleton-aware sampler is trained.

Source: Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023, and the program released with it.
Both take the losses of Point2Skeleton, which are averaged over the shapes of a batch here and summed there.
"""

from __future__ import annotations

import torch
from torch import Tensor

from morphoskel.learning.point2skeleton_losses import skeleton_loss, summed_chamfer_loss
from morphoskel.learning.resumable_fit import BatchedPhase
from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork

PRETRAIN = "pretrain"
SKELETON = "skeleton"


class SkeletonAwarePhase(BatchedPhase):
    """Train the skeletal balls: first to spread over the shape, then to fill it.

    Parameters
    ----------
    name
        ``"pretrain"`` or ``"skeleton"``.
    network
        Trained in place.
    training, validation
        Normalised clouds ``(S, N, 3)`` float32 and their neighbourhoods, see
        :func:`~morphoskel.networks.skeleton_aware_network.cloud_neighbourhoods`.
    seed
        Of the training.
    """

    def __init__(
        self,
        name: str,
        network: SkeletonAwareNetwork,
        training: tuple[Tensor, Tensor],
        validation: tuple[Tensor, Tensor],
        seed: int,
    ) -> None:
        super().__init__(name, training, validation, network.settings.batch_size, seed)
        self.network = network
        self.settings = network.settings

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the loss of clouds ``(B, N, 3)`` with neighbourhoods ``(B, K, S)``."""
        points, neighbourhoods = batch
        balls = self.network(points, neighbourhoods)
        if self.name == PRETRAIN:
            return self.settings.pretrain_weight * summed_chamfer_loss(points, balls.centres)
        return skeleton_loss(
            points,
            balls.centres,
            balls.radii,
            point_to_sphere_weight=self.settings.point_to_sphere_weight,
            radius_weight=self.settings.radius_weight,
        )

    def configure_optimizers(self) -> torch.optim.Optimizer:
        """Return Adam with a fixed learning rate."""
        return torch.optim.Adam(self.network.parameters(), lr=self.settings.learning_rate)
