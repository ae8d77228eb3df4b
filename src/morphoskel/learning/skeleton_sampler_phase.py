"""Train the skeleton-aware sampler through a frozen classifier.

Source: Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023, and the program released with it.
"""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn import functional

from morphoskel.learning.resumable_fit import BatchedPhase
from morphoskel.learning.task_loss import task_loss
from morphoskel.networks.pointnet2 import gather_rows
from morphoskel.networks.pointnet_classifier import PointNetClassifier
from morphoskel.networks.skeleton_sampler import SkeletonSampler
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings
from morphoskel.sampling.gumbel import draw_indices, gumbel_noise, gumbel_softmax, temperature


class SkeletonSamplerPhase(BatchedPhase):
    """Train a sampler so that a classifier, which does not change, recognises the samples.

    Parameters
    ----------
    name
        Of the phase; part of the seeds.
    network
        Trained in place.
    classifier
        Put into evaluation mode and frozen for good.
    training, validation
        Normalised clouds ``(S, N, 3)`` float32, labels ``(S,)`` int64 and prior weights ``(S, N)`` float32.
    settings
        Schedule.
    seed
        Of the training.
    """

    def __init__(
        self,
        name: str,
        network: SkeletonSampler,
        classifier: PointNetClassifier,
        training: tuple[Tensor, Tensor, Tensor],
        validation: tuple[Tensor, Tensor, Tensor],
        settings: SkeletonSamplerSettings,
        seed: int,
    ) -> None:
        super().__init__(name, training, validation, settings.batch_size, seed)
        self.network = network
        self.settings = settings
        # In a tuple the classifier is no part of this module: no checkpoint holds it, no call to train() reaches it.
        self.frozen = (classifier.eval().requires_grad_(False),)

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the classifier's loss on soft samples, which are mixtures of a cloud's points."""
        points, labels, weights = batch
        logits = self.network(points, weights)
        noise = gumbel_noise(logits.shape, None, logits.device)
        current = temperature(self.global_step, self.total_steps, self.settings.temperature)
        mixtures = gumbel_softmax(logits, current, noise) @ points
        return task_loss(self._classifier(), mixtures, labels, self.settings.task_penalty)

    def validation_loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the negative log-likelihood of the true classes given hard samples, which are points of the cloud."""
        points, labels, weights = batch
        samples = gather_rows(points, draw_indices(self.network(points, weights), None))
        return functional.nll_loss(self._classifier()(samples).log_probabilities, labels)

    def configure_optimizers(self) -> torch.optim.Optimizer:
        """Return Adam with a fixed learning rate."""
        return torch.optim.Adam(self.network.parameters(), lr=self.settings.learning_rate)

    def _classifier(self) -> PointNetClassifier:
        return self.frozen[0].to(self.device)
