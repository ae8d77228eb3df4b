"""Train the network that tells parts from labelled points of clouds to the file with the trained network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import torch

from morphoskel.errors import InputError
from morphoskel.learning.claim import claim
from morphoskel.learning.resumable_fit import resumable_fit
from morphoskel.learning.segmentation_phase import LabelledClouds, SegmentationPhase
from morphoskel.networks.part_segmentation import PartSegmentationNetwork, save_segmentation
from morphoskel.networks.segmentation_settings import SegmentationSettings
from morphoskel.seeds import derive_seed

NETWORK_FILE = "network.pt"


def train_segmentation(
    training: LabelledClouds,
    validation: LabelledClouds,
    class_names: Sequence[str],
    part_classes: Sequence[int],
    settings: SegmentationSettings,
    folder: Path,
    seed: int,
    *,
    origin: Mapping[str, Any],
    accelerator: str = "auto",
    devices: int = 1,
    progress: bool = True,
) -> Path:
    """Train a PointNet and keep the epoch with the smallest validation loss.

    Parameters
    ----------
    training
        At least two clouds, each with at least one labelled point in every set.
    validation
        The same of shapes held out, at least one; N may differ.
    class_names
        Of the labels of the categories, in order.
    part_classes
        The label of the category to which each part belongs, -1 for a part of none of them.
    settings
        Of the network and the training.
    folder
        For the result, checkpoints, and a CSV file with the losses and seconds of each epoch. A training that was
        killed goes on from what it finds there.
    seed
        Decides the initial weights, the order of the shapes, and the dropout.
    origin
        Plain values that the network's file shall tell its users, such as what chose the labelled points.
    accelerator
        As in Lightning: ``"auto"`` takes a GPU if there is one.
    devices
        How many of them share the batches.
    progress
        Whether to show a progress bar.

    Returns
    -------
    Path
        ``network.pt`` in the folder, to be read by
        :func:`~morphoskel.networks.part_segmentation.load_segmentation`.

    Raises
    ------
    InputError
        If the clouds are not as above, or the folder holds another training.
    ConfigError
        If a category has no part, or a part's category has no name.

    Notes
    -----
    On a CPU the result is the same to the last bit for the same arguments, version of torch and number of its threads,
    whether or not the training was interrupted. The published training keeps the last epoch, and lets the running
    statistics of the batch normalisation move ever more slowly.

    References
    ----------
    .. [1] C. R. Qi et al., "PointNet: Deep Learning on Point Sets for 3D Classification and Segmentation", CVPR 2017.
    """
    with torch.random.fork_rng():
        torch.manual_seed(derive_seed(seed, "segmentation", "initial weights"))
        network = PartSegmentationNetwork(part_classes, class_names, settings)
        network.origin = dict(origin)
        _check("training", training, network, least=2)
        _check("validation", validation, network, least=1)
        identity = {
            "network": "segmentation",
            "settings": settings.as_mapping(),
            "class_names": network.class_names,
            "part_classes": network.part_classes,
            "origin": network.origin,
            "seed": seed,
            "devices": devices,
        }
        claim(folder, identity, [*training, *validation])
        result = folder / NETWORK_FILE
        if result.exists():
            return result
        phase = SegmentationPhase(network, training, validation, seed)
        resumable_fit(phase, settings.epochs, folder, accelerator=accelerator, devices=devices, progress=progress)
    save_segmentation(network, result)
    return result


def _check(role: str, shapes: LabelledClouds, network: PartSegmentationNetwork, least: int) -> None:
    """Refuse clouds, categories, parts and labelled points that do not belong together."""
    points, categories, parts, labelled = shapes
    if points.dim() != 3 or points.shape[-1] != 3 or points.dtype != torch.float32 or points.shape[1] < 1:
        raise InputError(
            f"{role} clouds: expected float32 (S, N, 3) with N >= 1, got {points.dtype} {tuple(points.shape)}"
        )
    if len(points) < least:
        raise InputError(f"{role} clouds: expected at least {least}, got {len(points)}")
    shape = tuple(points.shape[:2])
    for name, labels, expected in (("categories", categories, shape[:1]), ("parts", parts, shape)):
        if labels.shape != expected or labels.dtype != torch.int64:
            raise InputError(f"{role} {name}: expected int64 {expected}, got {labels.dtype} {tuple(labels.shape)}")
    sets = tuple(labelled.shape)
    if labelled.dtype != torch.bool or len(sets) != 3 or sets[::2] != shape or sets[1] < 1:
        raise InputError(
            f"{role} labelled points: expected bool ({shape[0]}, D, {shape[1]}) with D >= 1, got {labelled.dtype} "
            f"{sets}"
        )
    _check_labels(role, shapes, network)


def _check_labels(role: str, shapes: LabelledClouds, network: PartSegmentationNetwork) -> None:
    """Refuse categories and parts that the network does not know, and clouds without a labelled point."""
    _, categories, parts, labelled = shapes
    bounds = (("categories", categories, 0, network.class_names), ("parts", parts, -1, network.part_classes))
    for name, labels, lowest, known in bounds:
        if labels.min() < lowest or labels.max() >= len(known):
            raise InputError(
                f"{role} {name}: expected {lowest} to {len(known) - 1}, got {int(labels.min())} to {int(labels.max())}"
            )
    known_parts = parts >= 0
    foreign = (torch.tensor(network.part_classes)[parts] != categories[:, None]) & known_parts
    if foreign.any():
        cloud, point = foreign.nonzero()[0].tolist()
        raise InputError(
            f"{role} parts: point {point} of cloud {cloud} is of part {int(parts[cloud, point])}, which is none of "
            f"category {network.class_names[int(categories[cloud])]}"
        )
    without = ~(labelled & known_parts[:, None]).any(dim=2).all(dim=1)
    if without.any():
        raise InputError(f"{role} labelled points: cloud {int(without.nonzero()[0])} has none; leave it out")
