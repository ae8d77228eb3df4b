from dataclasses import replace

import pytest
import torch
from tiny_classifier import TINY, balls_and_lines

from morphoskel.evaluation.classification import classify, overall_accuracy
from morphoskel.learning.classifier_phase import ClassifierPhase
from morphoskel.networks.pointnet_classifier import PointNetClassifier


def a_phase(**changes):
    torch.manual_seed(0)
    network = PointNetClassifier(2, replace(TINY, **changes))
    return ClassifierPhase(network, balls_and_lines(8), balls_and_lines(3, seed=1), 0)


def seen_by(phase, method):
    seen = []
    handle = phase.network.register_forward_pre_hook(lambda network, inputs: seen.append(inputs[0]))
    method(balls_and_lines(4))
    handle.remove()
    return seen[0]


def test_the_network_without_point_dropout_sees_all_points():
    original = balls_and_lines(4)[0]
    still = {"lowest_scale": 1.0, "highest_scale": 1.0, "shift": 0.0}
    for style in ("remove", "overwrite"):
        phase = a_phase(dropped_points=0.0, drop_style=style, **still)
        assert torch.equal(seen_by(phase, phase.loss), original)
    phase = a_phase(dropped_points=0.8, drop_style="remove", **still)
    assert seen_by(phase, phase.loss).shape[1] < 40
    phase = a_phase(dropped_points=0.8, drop_style="overwrite", **still)
    overwritten = seen_by(phase, phase.loss)
    assert overwritten.shape == original.shape
    assert not torch.equal(overwritten, original)


def test_clouds_are_changed_in_training_only():
    phase = a_phase(dropped_points=0.0)
    original = balls_and_lines(4)[0]
    assert not torch.allclose(seen_by(phase, phase.loss), original, atol=1e-3)
    assert torch.equal(seen_by(phase, phase.validation_loss), original)


@torch.no_grad()
def test_the_validation_loss_is_the_mean_likelihood():
    phase = a_phase().eval()
    points, labels = balls_and_lines(5)
    expected = -phase.network(points).log_probabilities[torch.arange(5), labels].mean()
    assert float(phase.validation_loss((points, labels))) == pytest.approx(float(expected))


def test_the_rates_are_those_of_the_settings():
    phase = a_phase(learning_rate=0.02, weight_decay=0.3, decay=0.5, decay_epochs=2)
    configured = phase.configure_optimizers()
    optimiser, schedule = configured["optimizer"], configured["lr_scheduler"]
    rates = []
    for _ in range(5):
        rates.append(optimiser.param_groups[0]["lr"])
        optimiser.step()
        schedule.step()
    assert rates == pytest.approx([0.02, 0.02, 0.01, 0.01, 0.005])
    assert optimiser.param_groups[0]["weight_decay"] == 0.3
    assert sum(len(group["params"]) for group in optimiser.param_groups) == len(list(phase.network.parameters()))


def test_it_learns_to_tell_balls_from_lines():
    phase = a_phase()
    for module in phase.network.modules():
        if isinstance(module, torch.nn.BatchNorm1d):
            module.momentum = 0.5  # so few steps do not carry the running statistics to where the weights are
    optimiser = phase.configure_optimizers()["optimizer"]
    batch = balls_and_lines(16)
    for _ in range(15):
        optimiser.zero_grad()
        phase.loss(batch).backward()
        optimiser.step()
    points, labels = balls_and_lines(20, seed=2)
    predicted, _ = classify(phase.network.eval(), points.numpy())
    assert overall_accuracy(predicted, labels.numpy()) >= 0.9
