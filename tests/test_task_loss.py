import math

import pytest
import torch
from tiny_classifier import TINY, balls_and_lines

from morphoskel.learning.task_loss import task_loss
from morphoskel.networks.pointnet_classifier import PointNetClassifier, transform_penalty


@torch.no_grad()
def test_it_is_the_mean_likelihood_and_the_penalty():
    torch.manual_seed(0)
    network = PointNetClassifier(2, TINY).eval()
    points, labels = balls_and_lines(5)
    classified = network(points)
    naive = -sum(float(row[label]) for row, label in zip(classified.log_probabilities, labels, strict=True)) / 5
    assert float(task_loss(network, points, labels, 0)) == pytest.approx(naive)
    penalty = float(transform_penalty(classified.feature_transform))
    assert penalty > 0
    assert float(task_loss(network, points, labels, 0.5)) == pytest.approx(naive + 0.5 * penalty)
    assert float(task_loss(network, points, labels)) == pytest.approx(naive + 0.001 * penalty)


@torch.no_grad()
def test_a_network_that_knows_nothing_loses_the_logarithm_of_the_classes():
    network = PointNetClassifier(5, TINY).eval()
    torch.nn.init.zeros_(network.classify.weight)
    torch.nn.init.zeros_(network.classify.bias)
    points, labels = balls_and_lines(4)
    assert float(task_loss(network, points, labels, 0)) == pytest.approx(math.log(5))
