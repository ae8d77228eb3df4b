import math

import numpy as np
import pytest
import torch
from tiny_classifier import TINY, balls_and_lines

from morphoskel.evaluation.classification import (
    class_mean_accuracy,
    classify,
    mcnemar_p_value,
    mean_interval,
    overall_accuracy,
    paired_difference,
)
from morphoskel.networks.pointnet_classifier import PointNetClassifier


def test_labels_and_descriptors_do_not_depend_on_the_batches():
    torch.manual_seed(0)
    network = PointNetClassifier(3, TINY)
    points = balls_and_lines(7)[0]
    network(points)
    with pytest.raises(ValueError, match="evaluation mode"):
        classify(network, points.numpy())
    network.eval()
    with torch.no_grad():
        expected = network(points)
    for batch in (1, 3, 7, 50):
        labels, descriptors = classify(network, points.numpy(), batch)
        assert labels.dtype == np.int64
        assert labels.tolist() == expected.log_probabilities.argmax(dim=1).tolist()
        np.testing.assert_allclose(descriptors, expected.descriptor.numpy(), atol=1e-4)
    labels, descriptors = classify(network, points.numpy()[:0])
    assert labels.shape == (0,)
    assert descriptors.shape == (0, 256)


def test_accuracies():
    labels = np.array([0, 0, 0, 5, 5, 9])
    predicted = np.array([0, 0, 1, 5, 9, 5])
    assert overall_accuracy(predicted, labels) == pytest.approx(3 / 6)
    assert class_mean_accuracy(predicted, labels) == pytest.approx((2 / 3 + 1 / 2 + 0) / 3)
    assert overall_accuracy(labels, labels) == class_mean_accuracy(labels, labels) == 1


def test_the_interval_is_that_of_the_normal_approximation():
    """For many shapes, the bootstrap's interval of a share p has half width 1.96 sqrt(p (1 - p) / S)."""
    values = np.repeat([1.0, 0.0], [600, 400])
    mean, low, high = mean_interval(values, np.random.default_rng(0))
    half = 1.96 * math.sqrt(0.6 * 0.4 / 1000)
    assert mean == pytest.approx(0.6)
    assert low == pytest.approx(0.6 - half, abs=0.004)
    assert high == pytest.approx(0.6 + half, abs=0.004)
    assert mean_interval(values, np.random.default_rng(0)) == (mean, low, high)
    assert mean_interval(np.full(5, 0.3), np.random.default_rng(0)) == pytest.approx((0.3, 0.3, 0.3))
    with pytest.raises(ValueError, match=r"expected \(S,\)"):
        mean_interval(np.empty(0), np.random.default_rng(0))


def test_a_pairing_narrows_the_interval_of_the_difference():
    generator = np.random.default_rng(0)
    ease = generator.random(500)
    a, b = (np.clip(ease + 0.05 * generator.standard_normal(500) + gain, 0, 1) for gain in (0.02, 0))
    difference = paired_difference(a, b, np.random.default_rng(1))
    assert difference.mean == pytest.approx(a.mean() - b.mean())
    assert 0 < difference.low < difference.mean < difference.high
    unpaired = mean_interval(a, np.random.default_rng(1))
    assert difference.high - difference.low < (unpaired.high - unpaired.low) / 3
    assert paired_difference(a, a, np.random.default_rng(1)) == (0, 0, 0)
    opposite = paired_difference(b, a, np.random.default_rng(1))
    assert opposite == pytest.approx((-difference.mean, -difference.high, -difference.low))
    with pytest.raises(ValueError, match="same shapes"):
        paired_difference(a, b[1:], np.random.default_rng(1))


def naive_p_value(only_a, only_b):
    count = only_a + only_b
    chances = [math.comb(count, k) / 2**count for k in range(count + 1)]
    return sum(chance for chance in chances if chance <= chances[only_a] * (1 + 1e-9))


@pytest.mark.parametrize(("only_a", "only_b"), [(0, 1), (1, 5), (9, 1), (4, 4), (0, 12)])
def test_mcnemar_counts_the_shapes_on_which_the_two_disagree(only_a, only_b):
    a = np.repeat([1, 0, 1, 0], [only_a, only_b, 30, 7])
    b = np.repeat([0, 1, 1, 0], [only_a, only_b, 30, 7])
    assert mcnemar_p_value(a, b) == pytest.approx(naive_p_value(only_a, only_b))
    assert mcnemar_p_value(b.astype(bool), a.astype(bool)) == pytest.approx(naive_p_value(only_a, only_b))


def test_mcnemar_without_disagreement_or_with_other_shapes():
    same = np.array([True, False, True])
    assert mcnemar_p_value(same, same) == 1
    with pytest.raises(ValueError, match="same shapes"):
        mcnemar_p_value(same, same[1:])
