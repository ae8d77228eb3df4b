"""Train a generator of points so that frozen classifiers still recognise the simplified clouds.

Source: Dovrat et al., *Learning to Sample*, CVPR 2019 (S-NET); Lang et al., *SampleNet: Differentiable Point Cloud
Sampling*, CVPR 2020; Cheng et al., *Meta-Sampler: Almost-Universal yet Task-Oriented Sampling for Point Clouds*, ECCV
2022 (its joint training by several classifiers); and the programs released with them.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.errors import InputError
from morphoskel.learning.augmentation import drop_points, jitter, rotate_about_y, scale_and_shift
from morphoskel.learning.resumable_fit import BatchedPhase
from morphoskel.learning.simplification_loss import simplification_loss
from morphoskel.learning.task_loss import task_loss
from morphoskel.networks.generator_settings import GeneratorSettings
from morphoskel.networks.point_generator import PointGenerator
from morphoskel.networks.pointnet2 import gather_rows
from morphoskel.networks.pointnet_classifier import PointNetClassifier
from morphoskel.sampling.matching import match_clouds

JITTER, JITTER_CLIP = 0.01, 0.05
"""Standard deviation and limit of S-NET's jitter, in units of the normalised clouds."""

MOST_DROPPED = 0.875
"""Largest share of points that are dropped of a cloud, as in the training of the classifiers of Meta-Sampler."""


class GeneratorPhase(BatchedPhase):
    """Train S-NET, SampleNet or Meta-Sampler, which differ by their settings and the number of classifiers.

    For generated points Q, projected to R (or R = Q without projection), the loss is ``task_weight * L_task(R) + alpha
    * L_simplification(Q, P) + projection_weight * sigma``. L_task is the mean of the classifiers' losses, each with its
    feature-transform penalty, which all three programs keep although the classifiers are frozen: the transforms depend
    on the points.

    Parameters
    ----------
    name
        Of the phase.
    network
        Trained in place.
    classifiers
        At least one; they are frozen here, put into evaluation mode, and stay out of the checkpoints.
    training, validation
        ``(S, N, 3)`` float32 normalised clouds and ``(S,)`` int64 labels.
    settings
        Loss and schedule.
    seed
        Of the training.

    Raises
    ------
    InputError
        If there is no classifier, or fewer than two training clouds.

    Notes
    -----
    The penalty is the mean over the batch of the norm, as in the PyTorch programs; those of S-NET and SampleNet take
    half the sum of squares.
    """

    def __init__(
        self,
        name: str,
        network: PointGenerator,
        classifiers: tuple[PointNetClassifier, ...],
        training: tuple[Tensor, Tensor],
        validation: tuple[Tensor, Tensor],
        settings: GeneratorSettings,
        seed: int,
    ) -> None:
        super().__init__(name, training, validation, settings.batch_size, seed)
        if not classifiers:
            raise InputError("classifiers: expected at least one trained classifier, got none; train one first")
        if len(training[0]) < 2:
            raise InputError(f"training: expected at least two clouds for batch normalisation, got {len(training[0])}")
        self.network = network
        self.settings = settings
        self.frozen = tuple(classifier.eval().requires_grad_(False) for classifier in classifiers)

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the loss of clouds ``(B, N, 3)`` and labels ``(B,)``."""
        points, labels = batch
        settings = self.settings
        points = self._augment(points)
        generated = self.network(points)
        total = settings.alpha * simplification_loss(points, generated, gamma=settings.gamma, delta=settings.delta)
        seen = generated
        if self.network.projection is not None:
            seen = self.network.projection(points, generated)
            total = total + settings.projection_weight * self.network.projection.sigma()
        task = [task_loss(each, seen, labels, settings.task_penalty) for each in self._classifiers()]
        return total + settings.task_weight * torch.stack(task).mean()

    def validation_loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the classifiers' mean negative log-likelihood of the points that a sampler would return.

        Those are matched and completed input points, see :func:`~morphoskel.sampling.matching.match_and_complete`.
        """
        points, labels = batch
        matching = match_clouds(points.cpu().numpy(), self.network(points).detach().cpu().numpy())
        chosen = gather_rows(points, torch.from_numpy(matching.indices).to(points.device))
        likelihoods = [functional.nll_loss(each(chosen).log_probabilities, labels) for each in self._classifiers()]
        return torch.stack(likelihoods).mean()

    def on_train_batch_start(self, batch: Any, batch_idx: int) -> None:
        """Set the momentum of all batch normalisations. No checkpoint holds it, so it is computed from the step."""
        momentum = self._momentum(self.global_step)
        for module in self.network.modules():
            if isinstance(module, nn.BatchNorm1d):
                module.momentum = momentum

    def configure_optimizers(self) -> Any:
        """Return Adam with a learning rate that falls in stairs, step by step and not epoch by epoch."""
        settings = self.settings
        floor = settings.least_learning_rate / settings.learning_rate
        optimiser = torch.optim.Adam(self.network.parameters(), lr=settings.learning_rate)
        schedule = torch.optim.lr_scheduler.LambdaLR(
            optimiser, lambda step: max(floor, settings.decay ** self._decays(step))
        )
        return {"optimizer": optimiser, "lr_scheduler": {"scheduler": schedule, "interval": "step"}}

    def _momentum(self, step: int) -> float:
        settings = self.settings
        return max(settings.least_momentum, settings.momentum * settings.momentum_decay ** self._decays(step))

    def _decays(self, step: int) -> int:
        """Return how often the schedules have decayed before a step."""
        return int(step / (self.settings.decay_share * max(self.total_steps, 1)))

    def _augment(self, points: Tensor) -> Tensor:
        """Return the clouds as the settings have them varied."""
        if self.settings.augmentation == "rotation":
            return jitter(rotate_about_y(points), JITTER, JITTER_CLIP)
        if self.settings.augmentation == "dropout":
            return scale_and_shift(drop_points(points, MOST_DROPPED, "overwrite"))
        return points

    def _classifiers(self) -> tuple[PointNetClassifier, ...]:
        """Return the frozen classifiers on the device of the phase, to which Lightning does not move them."""
        return tuple(classifier.to(self.device) for classifier in self.frozen)
