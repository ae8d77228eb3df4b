"""How well clouds are recognised by a trained classifier, and how certain such numbers are."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.stats import binomtest

from morphoskel.shapes import FloatArray

if TYPE_CHECKING:
    from morphoskel.networks.pointnet_classifier import PointNetClassifier

LabelArray = npt.NDArray[np.int64]

RESAMPLES = 2000
COVERAGE = 0.95


class Interval(NamedTuple):
    """A mean over shapes and the range in which it would fall with other shapes.

    Parameters
    ----------
    mean, low, high
        The mean and the ends of its 95 % interval.
    """

    mean: float
    low: float
    high: float


def classify(
    classifier: PointNetClassifier, points: npt.NDArray[np.float32], batch: int = 32
) -> tuple[LabelArray, npt.NDArray[np.float32]]:
    """Classify clouds.

    Parameters
    ----------
    classifier
        In evaluation mode, as it is loaded; on any device.
    points
        ``(S, M, 3)`` float32, normalised.
    batch
        Clouds at a time.

    Returns
    -------
    tuple of ndarray
        Labels ``(S,)`` int64 and descriptors ``(S, 256)`` float32.

    Raises
    ------
    ValueError
        If the classifier is in training mode, in which a cloud's class depends on the others.
    """
    import torch

    if classifier.training:
        raise ValueError("classify: expected a classifier in evaluation mode; call eval() first")
    device = next(classifier.parameters()).device
    labels, descriptors = [np.empty(0, dtype=np.int64)], [np.empty((0, 256), dtype=np.float32)]
    with torch.inference_mode():
        for part in np.split(points, range(batch, len(points), batch)):
            classified = classifier(torch.from_numpy(np.ascontiguousarray(part)).to(device))
            labels.append(classified.log_probabilities.argmax(dim=1).cpu().numpy())
            descriptors.append(classified.descriptor.cpu().numpy())
    return np.concatenate(labels), np.concatenate(descriptors)


def overall_accuracy(predicted: LabelArray, labels: LabelArray) -> float:
    """Return the share of shapes whose predicted label is theirs; both arrays ``(S,)``, S at least 1."""
    return float(np.mean(predicted == labels))


def class_mean_accuracy(predicted: LabelArray, labels: LabelArray) -> float:
    """Return the mean over the classes that occur of the share of their shapes that is recognised."""
    _, of_shape, counts = np.unique(labels, return_inverse=True, return_counts=True)
    correct = np.bincount(of_shape, weights=predicted == labels)
    return float(np.mean(correct / counts))


def mean_interval(values: FloatArray, generator: np.random.Generator) -> Interval:
    """Return the mean over shapes with its 95 % interval, by the percentile bootstrap over shapes.

    Parameters
    ----------
    values
        ``(S,)`` float, one a shape, S at least 1; for example 1 where it is recognised and 0 where not, or the share of
        the draws of a sampler in which it is.
    generator
        Draws the shapes.

    Notes
    -----
    The interval speaks of other shapes, not of other trainings of the same networks.
    """
    if values.ndim != 1 or len(values) == 0:
        raise ValueError(f"values: expected (S,) with S >= 1, got {values.shape}")
    means = np.array([values[generator.integers(len(values), size=len(values))].mean() for _ in range(RESAMPLES)])
    low, high = np.quantile(means, [(1 - COVERAGE) / 2, (1 + COVERAGE) / 2])
    return Interval(float(values.mean()), float(low), float(high))


def paired_difference(values_a: FloatArray, values_b: FloatArray, generator: np.random.Generator) -> Interval:
    """Return the mean of ``values_a - values_b`` over shapes with its 95 % interval.

    Parameters
    ----------
    values_a, values_b
        ``(S,)`` float of the same shapes in the same order.
    generator
        Draws the shapes.

    Notes
    -----
    What makes a shape hard makes it hard for both, so the interval is mostly narrower than those of the two means.
    """
    if values_a.shape != values_b.shape:
        raise ValueError(f"expected values of the same shapes, got {values_a.shape} and {values_b.shape}")
    return mean_interval(np.asarray(values_a, dtype=np.float64) - values_b, generator)


def mcnemar_p_value(correct_a: npt.NDArray[np.bool_], correct_b: npt.NDArray[np.bool_]) -> float:
    """Return the two-sided p-value of McNemar's exact test.

    Parameters
    ----------
    correct_a, correct_b
        ``(S,)`` bool or 0 and 1: whether each shape is recognised in either way.

    Returns
    -------
    float
        The probability of a split at least as uneven of the shapes on which the two disagree, if either were as likely
        to be right; 1 if they never disagree.

    References
    ----------
    .. [1] Q. McNemar, "Note on the sampling error of the difference between correlated proportions or percentages",
       Psychometrika 12, 1947.
    """
    a, b = (np.asarray(values).astype(bool) for values in (correct_a, correct_b))
    if a.shape != b.shape:
        raise ValueError(f"expected values of the same shapes, got {a.shape} and {b.shape}")
    only_a, only_b = int(np.sum(a & ~b)), int(np.sum(b & ~a))
    if only_a + only_b == 0:
        return 1.0
    return float(binomtest(only_a, only_a + only_b).pvalue)
