"""Train the classifier of clouds from labelled clouds to the file with the trained network."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import torch
from torch import Tensor

from morphoskel.errors import InputError
from morphoskel.learning.claim import claim
from morphoskel.learning.classifier_phase import ClassifierPhase
from morphoskel.learning.damaged_checkpoints import is_finished
from morphoskel.learning.resumable_fit import resumable_fit
from morphoskel.networks.classifier_settings import ClassifierSettings
from morphoskel.networks.pointnet_classifier import PointNetClassifier, save_classifier
from morphoskel.seeds import derive_seed

NETWORK_FILE = "network.pt"


def train_classifier(
    training: tuple[Tensor, Tensor],
    validation: tuple[Tensor, Tensor],
    class_names: Sequence[str],
    settings: ClassifierSettings,
    folder: Path,
    seed: int,
    *,
    accelerator: str = "auto",
    devices: int = 1,
    progress: bool = True,
) -> Path:
    """Train a PointNet and keep the epoch with the smallest validation loss.

    Parameters
    ----------
    training
        Normalised clouds ``(S, N, 3)`` float32, at least two, and labels ``(S,)`` int64 below the number of classes.
    validation
        The same for shapes held out, at least one; N may differ.
    class_names
        Of the labels, in order; kept in the file.
    settings
        Of the training.
    folder
        For the result, checkpoints, and a CSV file with the losses and seconds of each epoch. A training that was
        killed goes on from what it finds there.
    seed
        Decides the initial weights, the order of the shapes, how they are changed, and the dropout.
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
        :func:`~morphoskel.networks.pointnet_classifier.load_classifier`.

    Raises
    ------
    InputError
        If clouds or labels are not as above, or the folder holds another training.

    Notes
    -----
    On a CPU the result is the same to the last bit for the same arguments, version of torch and number of its threads,
    whether or not the training was interrupted. Published classifiers keep the epoch that is best on the test shapes.

    References
    ----------
    .. [1] C. R. Qi et al., "PointNet: Deep Learning on Point Sets for 3D Classification and Segmentation", CVPR 2017.
    """
    _check("training", training, len(class_names), least=2)
    _check("validation", validation, len(class_names), least=1)
    identity = {
        "network": "classifier",
        "settings": settings.as_mapping(),
        "class_names": list(class_names),
        "seed": seed,
        "devices": devices,
    }
    claim(folder, identity, [*training, *validation])
    result = folder / NETWORK_FILE
    if is_finished(result):
        return result
    with torch.random.fork_rng():
        torch.manual_seed(derive_seed(seed, "classifier", "initial weights"))
        network = PointNetClassifier(len(class_names), settings)
        phase = ClassifierPhase(network, training, validation, seed)
        resumable_fit(phase, settings.epochs, folder, accelerator=accelerator, devices=devices, progress=progress)
    save_classifier(network, class_names, result)
    return result


def _check(role: str, shapes: tuple[Tensor, Tensor], classes: int, least: int) -> None:
    """Refuse clouds and labels that do not belong together."""
    points, labels = shapes
    if points.dim() != 3 or points.shape[-1] != 3 or points.dtype != torch.float32 or points.shape[1] < 1:
        raise InputError(
            f"{role} clouds: expected float32 (S, N, 3) with N >= 1, got {points.dtype} {tuple(points.shape)}"
        )
    if len(points) < least:
        raise InputError(f"{role} clouds: expected at least {least}, got {len(points)}")
    if labels.shape != points.shape[:1] or labels.dtype != torch.int64:
        raise InputError(
            f"{role} labels: expected int64 ({len(points)},), one a cloud, got {labels.dtype} {tuple(labels.shape)}"
        )
    if labels.min() < 0 or labels.max() >= classes:
        raise InputError(
            f"{role} labels: expected 0 to {classes - 1} for {classes} class names, got {int(labels.min())} to "
            f"{int(labels.max())}"
        )
