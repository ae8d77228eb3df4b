"""The loss with which clouds, whole or sampled, are judged by a classifier."""

from __future__ import annotations

from torch import Tensor
from torch.nn import functional

from morphoskel.networks.pointnet_classifier import PointNetClassifier, transform_penalty


def task_loss(classifier: PointNetClassifier, points: Tensor, labels: Tensor, penalty_weight: float = 0.001) -> Tensor:
    """Return the negative log-likelihood of the true classes and the penalty of the feature transform.

    Parameters
    ----------
    classifier
        In training or evaluation mode; its gradients are not touched here.
    points
        ``(B, N, 3)`` float32.
    labels
        ``(B,)`` int64.
    penalty_weight
        Of :func:`~morphoskel.networks.pointnet_classifier.transform_penalty`.

    Returns
    -------
    Tensor
        Scalar, a mean over the clouds.
    """
    classified = classifier(points)
    likelihood = functional.nll_loss(classified.log_probabilities, labels)
    return likelihood + penalty_weight * transform_penalty(classified.feature_transform)
