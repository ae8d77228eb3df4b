import csv
from dataclasses import replace

import pytest
import torch
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.learning.resumable_fit import BatchedPhase, resumable_fit
from morphoskel.learning.skeleton_sampler_phase import SkeletonSamplerPhase
from morphoskel.learning.task_loss import task_loss
from morphoskel.networks.classifier_settings import ClassifierSettings
from morphoskel.networks.pointnet_classifier import Classification, PointNetClassifier
from morphoskel.networks.skeleton_sampler import SkeletonSampler
from morphoskel.sampling.gumbel import draw_indices, gumbel_noise, gumbel_softmax, temperature


class KilledError(Exception):
    pass


class RightOrLeft(torch.nn.Module):
    """Says whether the samples lie to the right, in the manner of the classifier; it has something to train, too."""

    def __init__(self):
        super().__init__()
        self.normalise = torch.nn.BatchNorm1d(1)

    def forward(self, points):
        right = self.normalise(4 * points[:, :, :1].mean(dim=1))
        log_probabilities = torch.cat([right, -right], dim=1).log_softmax(dim=-1)
        transform = torch.eye(64) * points.mean(dim=(1, 2))[:, None, None]
        return Classification(log_probabilities, right.expand(-1, 256), transform)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def shapes():
    """Clouds around the origin, all to be taken for lying to the right: so points of large x must be chosen."""
    points = torch.rand(8, 24, 3, generator=torch.Generator().manual_seed(0)) * 2 - 1
    return points, torch.zeros(8, dtype=torch.int64), torch.ones(8, 24)


def build(shapes, settings=TINY_SAMPLER, seed=3, classifier=None):
    with torch.random.fork_rng():
        torch.manual_seed(0)
        network = SkeletonSampler(5, settings)
    training, validation = (tuple(part[:6] for part in shapes), tuple(part[6:] for part in shapes))
    phase = SkeletonSamplerPhase("sampler", network, classifier or RightOrLeft(), training, validation, settings, seed)
    phase.total_steps = 10
    return phase


def fit(phase, folder, epochs):
    resumable_fit(phase, epochs, folder, accelerator="cpu", progress=False)
    with (folder / "sampler.csv").open(newline="") as file:
        return [[float(value) for value in row[1:3]] for row in list(csv.reader(file))[1:]]


def test_the_loss_is_that_of_the_task_on_mixtures(shapes):
    phase = build(shapes).eval()
    points, labels, weights = shapes
    with torch.random.fork_rng():
        torch.manual_seed(1)
        loss = phase.loss(shapes)
    noise = gumbel_noise((8, 5, 24), torch.Generator().manual_seed(1))
    heat = temperature(0, 10, TINY_SAMPLER.temperature)
    soft = gumbel_softmax(phase.network(points, weights), heat, noise)
    mixtures = torch.stack(
        [
            torch.stack([(row[:, None] * cloud).sum(dim=0) for row in rows])
            for rows, cloud in zip(soft, points, strict=True)
        ]
    )
    torch.testing.assert_close(loss, task_loss(phase.frozen[0], mixtures, labels, 0.001))


def test_validation_judges_points_of_the_cloud(shapes):
    phase = build(shapes).eval()
    points, labels, weights = shapes
    chosen = draw_indices(phase.network(points, weights), torch.Generator().manual_seed(1))
    hard = torch.stack([cloud[row] for cloud, row in zip(points, chosen, strict=True)])
    with torch.random.fork_rng():
        torch.manual_seed(1)
        loss = phase.validation_loss(shapes)
    torch.testing.assert_close(loss, task_loss(phase.frozen[0], hard, labels, 0.0))


def test_the_classifier_passes_gradients_on_and_keeps_none(shapes):
    settings = ClassifierSettings(
        dropped_points=0.875, drop_style="overwrite", lowest_scale=0.8, highest_scale=1.25, shift=0.1,
        feature_dropout=0.4, penalty=0.001, batch_size=2, epochs=1, learning_rate=1e-3, weight_decay=1e-4, decay=0.7,
        decay_epochs=20,
    )  # fmt: skip
    phase = build(shapes, classifier=PointNetClassifier(4, settings).train()).train()
    (classifier,) = phase.frozen
    assert not classifier.training
    phase.loss(shapes).backward()
    assert all(parameter.grad is None for parameter in classifier.parameters())
    gradients = [parameter.grad.abs().max() for parameter in phase.network.parameters()]
    assert min(gradients) > 0


def test_the_temperature_follows_the_steps(shapes, tmp_path, monkeypatch):
    heats = []

    def record(logits, heat, noise):
        heats.append(heat)
        return gumbel_softmax(logits, heat, noise)

    monkeypatch.setattr("morphoskel.learning.skeleton_sampler_phase.gumbel_softmax", record)
    fit(build(shapes), tmp_path, 4)  # 12 steps, changed every 2
    assert heats == [temperature(step, 12, TINY_SAMPLER.temperature) for step in range(12)]
    assert heats[0] == heats[1] == 1
    assert heats[-1] == 0.5


def test_the_sampler_learns_and_the_classifier_does_not(shapes, tmp_path):
    settings = replace(TINY_SAMPLER, learning_rate=3e-2)
    phase = build(shapes, settings)
    before = {name: value.clone() for name, value in phase.frozen[0].state_dict().items()}
    losses = fit(phase, tmp_path, 15)
    assert losses[-1][0] < 0.5 * losses[0][0]
    assert min(row[1] for row in losses) < 0.5 * losses[0][1]
    assert all(torch.equal(before[name], value) for name, value in phase.frozen[0].state_dict().items())
    checkpoint = torch.load(tmp_path / "sampler" / "last.ckpt", weights_only=True)
    assert all(name.startswith("network.") for name in checkpoint["state_dict"])


@pytest.mark.parametrize("killed_after", [(1, 1), (2, 0)])
def test_a_killed_training_goes_on_to_the_same_result(shapes, tmp_path, monkeypatch, killed_after):
    whole = build(shapes)
    losses = fit(whole, tmp_path / "whole", 3)
    original = BatchedPhase.training_step

    def step(phase, batch, index):
        if (phase.current_epoch, index) == killed_after:
            raise KilledError
        return original(phase, batch, index)

    monkeypatch.setattr(BatchedPhase, "training_step", step)
    with pytest.raises(KilledError):
        fit(build(shapes), tmp_path / "killed", 3)
    monkeypatch.undo()
    resumed = build(shapes)
    assert fit(resumed, tmp_path / "killed", 3) == losses
    for one, other in zip(whole.network.parameters(), resumed.network.parameters(), strict=True):
        assert torch.equal(one, other)
