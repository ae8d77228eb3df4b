"""The one phase in which the network that tells the parts of clouds is trained."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import torch
from torch import Tensor
from torch.nn import functional

from morphoskel.learning.resumable_fit import BatchedPhase
from morphoskel.networks.part_segmentation import PartSegmentationNetwork
from morphoskel.networks.pointnet2 import gather_rows
from morphoskel.networks.pointnet_classifier import transform_penalty

SEGMENTATION = "segmentation"

LABELLED_SHARE = 0.75
"""Of the points that are taken of a cloud, those that have labels for sure."""

NOT_COUNTED = -1
"""The part of a point that the loss passes over."""


class LabelledClouds(NamedTuple):
    """Clouds with the parts of their points, of which the labelled ones are told to the network.

    Parameters
    ----------
    points
        ``(S, N, 3)`` float32, normalised.
    categories
        ``(S,)`` int64, their labels.
    parts
        ``(S, N)`` int64, -1 for a point that repeats another one.
    labelled
        ``(S, D, N)`` bool, D sets of labelled points.
    """

    points: Tensor
    categories: Tensor
    parts: Tensor
    labelled: Tensor


class SegmentationPhase(BatchedPhase):
    """Train a network on the labelled points of clouds, which are not changed; judge it on those of other clouds.

    Parameters
    ----------
    network
        Trained in place, as its settings say.
    training
        Every epoch counts the next one of the sets of labelled points, after the last one the first again.
    validation
        The first set of labelled points counts; N and D may differ.
    seed
        Of the training.
    """

    def __init__(
        self, network: PartSegmentationNetwork, training: LabelledClouds, validation: LabelledClouds, seed: int
    ) -> None:
        super().__init__(SEGMENTATION, training, validation, network.settings.batch_size, seed)
        self.network = network

    def loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the mean cross entropy at the labelled points and the penalty of the feature transform."""
        points, categories, parts, labelled = batch
        settings = self.network.settings
        targets = _targets(parts, labelled[:, self.current_epoch % labelled.shape[1]])
        points, targets = thinned(points, targets, settings.training_points)
        if settings.training_input == "labelled":
            points, targets = only_labelled(points, targets)
        segmented = self.network(points, categories)
        entropy = functional.cross_entropy(segmented.logits.flatten(0, 1), targets.flatten(), ignore_index=NOT_COUNTED)
        return entropy + settings.penalty * transform_penalty(segmented.feature_transform)

    def validation_loss(self, batch: tuple[Tensor, ...]) -> Tensor:
        """Return the mean over the clouds of the mean cross entropy at their labelled points.

        As many points enter the network as in training. A mean over the points of all clouds would depend on the
        batches where clouds have different numbers of labelled points.
        """
        points, categories, parts, labelled = batch
        points, targets = thinned(points, _targets(parts, labelled[:, 0]), self.network.settings.training_points)
        logits = self.network(points, categories).logits
        entropies = functional.cross_entropy(
            logits.flatten(0, 1), targets.flatten(), ignore_index=NOT_COUNTED, reduction="none"
        ).view_as(targets)
        return (entropies.sum(dim=1) / (targets != NOT_COUNTED).sum(dim=1)).mean()

    def configure_optimizers(self) -> Any:
        """Return Adam, and the learning rate's steps after every few epochs down to the lowest."""
        settings = self.network.settings
        lowest = settings.lowest_learning_rate / settings.learning_rate

        def factor(epoch: int) -> float:
            return float(max(settings.decay ** (epoch // settings.decay_epochs), lowest))

        optimiser = torch.optim.Adam(self.network.parameters(), lr=settings.learning_rate, fused=True)
        return {"optimizer": optimiser, "lr_scheduler": torch.optim.lr_scheduler.LambdaLR(optimiser, factor)}


def _targets(parts: Tensor, labelled: Tensor) -> Tensor:
    """Return ``(B, N)`` int64, the parts of the labelled points and :data:`NOT_COUNTED` of the others."""
    return torch.where(labelled, parts, NOT_COUNTED)


def thinned(points: Tensor, targets: Tensor, count: int | None) -> tuple[Tensor, Tensor]:
    """Take random points of each cloud, among them some with labels. Draws from torch's global generator.

    Were all labelled points taken, the network would be trained on clouds that mostly hold what a sampler chose, which
    need not be spread like those it is tested on.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float.
    targets
        ``(B, N)`` int64, :data:`NOT_COUNTED` for a point without label.
    count
        Points to take of each cloud, at least 1; ``None``, or N and more, takes all as they are.

    Returns
    -------
    tuple of Tensor
        Points ``(B, count, 3)`` and targets ``(B, count)``, in random order. Three quarters of the
        points, rounded up, have labels where the cloud has so many; the others are drawn from all that are left.
    """
    if count is None or count >= points.shape[1]:
        return points, targets
    chance, order = torch.rand((2, *targets.shape), device=points.device)
    first = torch.where(targets != NOT_COUNTED, chance, -1.0).topk(math.ceil(LABELLED_SHARE * count), dim=1)
    order = order.scatter_add(1, first.indices, (first.values >= 0).to(order.dtype))
    rows = order.topk(count, dim=1, sorted=False).indices
    return gather_rows(points, rows), targets.gather(1, rows)


def only_labelled(points: Tensor, targets: Tensor) -> tuple[Tensor, Tensor]:
    """Take the labelled points of clouds.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float.
    targets
        ``(B, N)`` int64, :data:`NOT_COUNTED` for a point without label; each cloud has at least one with label.

    Returns
    -------
    tuple of Tensor
        Points ``(B, M, 3)`` and targets ``(B, M)``, where M is the largest number of labelled points of a cloud. A
        cloud with fewer repeats its own, in order, again and again; the repeated ones are not counted.
    """
    labelled = targets != NOT_COUNTED
    counts = labelled.sum(dim=1, keepdim=True)
    first = torch.argsort(labelled.byte(), dim=1, descending=True, stable=True)
    places = torch.arange(int(counts.max()), device=points.device)[None]
    # Repeated points change neither a maximum over the points nor the loss, but the statistics of the batch
    # normalisation weigh them twice: in training, a cloud with few labelled points counts there as much as any other.
    rows = first.gather(1, places % counts)
    return gather_rows(points, rows), torch.where(places < counts, targets.gather(1, rows), NOT_COUNTED)
