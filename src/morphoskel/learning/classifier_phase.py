"""The one phase in which the classifier of clouds is trained."""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor
from torch.nn import functional

from morphoskel.learning.augmentation import drop_points, scale_and_shift
from morphoskel.learning.resumable_fit import BatchedPhase
from morphoskel.learning.task_loss import task_loss
from morphoskel.networks.pointnet_classifier import PointNetClassifier

CLASSIFIER = "classifier"


class ClassifierPhase(BatchedPhase):
    """Train a classifier on clouds that are thinned, scaled and moved; judge it on whole ones.

    Parameters
    ----------
    network
        Trained in place, as its settings say.
    training, validation
        Clouds ``(S, N, 3)`` float32 and labels ``(S,)`` int64.
    seed
        Of the training.
    """

    def __init__(
        self,
        network: PointNetClassifier,
        training: tuple[Tensor, Tensor],
        validation: tuple[Tensor, Tensor],
        seed: int,
    ) -> None:
        super().__init__(CLASSIFIER, training, validation, network.settings.batch_size, seed)
        self.network = network

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the task loss of changed clouds."""
        points, labels = batch
        settings = self.network.settings
        points = drop_points(points, settings.dropped_points, settings.drop_style)
        points = scale_and_shift(points, settings.lowest_scale, settings.highest_scale, settings.shift)
        return task_loss(self.network, points, labels, settings.penalty)

    def validation_loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the mean negative log-likelihood of whole clouds."""
        points, labels = batch
        return functional.nll_loss(self.network(points).log_probabilities, labels)

    def configure_optimizers(self) -> Any:
        """Return Adam with weight decay, and the learning rate's steps after every few epochs."""
        settings = self.network.settings
        optimiser = torch.optim.Adam(
            self.network.parameters(), lr=settings.learning_rate, weight_decay=settings.weight_decay, fused=True
        )
        schedule = torch.optim.lr_scheduler.StepLR(optimiser, settings.decay_epochs, settings.decay)
        return {"optimizer": optimiser, "lr_scheduler": schedule}
