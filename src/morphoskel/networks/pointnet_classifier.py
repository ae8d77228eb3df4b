"""The PointNet that classifies clouds, and the file that holds a trained one.

Source: Qi et al., *PointNet: Deep Learning on Point Sets for 3D Classification and Segmentation*, CVPR 2017, Sec. 4.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional

from morphoskel.errors import InputError
from morphoskel.networks.classifier_settings import ClassifierSettings
from morphoskel.networks.network_file import read_network, write_network
from morphoskel.networks.pointnet import PointNetEncoder, hidden_layer

DESCRIPTOR = 256
"""Channels of the descriptor of a cloud."""


@dataclass(frozen=True)
class Classification:
    """What the classifier says of a batch of clouds.

    Parameters
    ----------
    log_probabilities
        ``(B, C)``, of the classes.
    descriptor
        ``(B, 256)``, at least 0, the activation before the last layer, by which shapes are retrieved.
    feature_transform
        ``(B, 64, 64)``, see :func:`transform_penalty`.
    """

    log_probabilities: Tensor
    descriptor: Tensor
    feature_transform: Tensor


class PointNetClassifier(nn.Module):
    """Classify clouds of any number of points.

    Parameters
    ----------
    classes
        How many there are, at least 1.
    settings
        The share of dropped channels is taken from here; the rest belongs to the training and is kept with the file.

    Attributes
    ----------
    class_names : tuple of str
        Of the labels, in order; numbers as text until names are known.
    """

    def __init__(self, classes: int, settings: ClassifierSettings) -> None:
        super().__init__()
        self.settings = settings
        self.class_names = tuple(str(label) for label in range(classes))
        self.encoder = PointNetEncoder()
        self.hidden = hidden_layer(1024, 512)
        self.describe = nn.Linear(512, DESCRIPTOR)
        self.dropout = nn.Dropout(settings.feature_dropout)
        self.normalise = nn.BatchNorm1d(DESCRIPTOR)
        self.classify = nn.Linear(DESCRIPTOR, classes)

    def forward(self, points: Tensor) -> Classification:
        """Classify clouds.

        Parameters
        ----------
        points
            ``(B, N, 3)`` float32, any N at least 1, normalised. In evaluation mode neither their order nor repeated
            points matter.
        """
        features = self.encoder(points)
        values = self.hidden(features.cloud)
        descriptor = functional.relu(self.normalise(self.dropout(self.describe(values))))
        log_probabilities = self.classify(descriptor).log_softmax(dim=-1)
        return Classification(log_probabilities, descriptor, features.feature_transform)


def transform_penalty(transform: Tensor) -> Tensor:
    """Return how far matrices are from orthogonal ones.

    Parameters
    ----------
    transform
        ``(B, C, C)`` matrices A.

    Returns
    -------
    Tensor
        Scalar, the mean over the batch of the Frobenius norm ``|I - A A'|`` (the paper's Eq. 2 has its square).
    """
    identity = torch.eye(transform.shape[-1], device=transform.device, dtype=transform.dtype)
    penalty: Tensor = torch.linalg.matrix_norm(identity - transform @ transform.mT).mean()
    return penalty


def save_classifier(network: PointNetClassifier, class_names: Sequence[str], path: Path) -> None:
    """Write weights, settings and the names of the classes to one file, whole or not at all.

    Raises
    ------
    InputError
        If there are not as many names as classes.
    """
    if len(class_names) != network.classify.out_features:
        raise InputError(
            f"{path}: expected a name for each of the {network.classify.out_features} classes, got {len(class_names)}"
        )
    write_network(network, path, settings=network.settings.as_mapping(), class_names=list(class_names))


def load_classifier(path: Path | str) -> PointNetClassifier:
    """Read a trained classifier.

    Parameters
    ----------
    path
        A file written by :func:`save_classifier`.

    Returns
    -------
    PointNetClassifier
        On the CPU, in evaluation mode, with the names of its classes.

    Raises
    ------
    InputError
        If the file is missing, or is not such a network.
    """
    with read_network(path, "classifier") as content:
        names = tuple(content["class_names"])
        network = PointNetClassifier(len(names), ClassifierSettings(**content["settings"]))
        network.load_state_dict(content["weights"])
    network.class_names = names
    return network.eval()
