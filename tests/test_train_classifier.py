import csv
import json
from dataclasses import replace

import numpy as np
import pytest
import torch
from tiny_classifier import NAMES, TINY, balls_and_lines
from torch.nn import functional

from morphoskel.errors import InputError
from morphoskel.evaluation.classification import classify
from morphoskel.learning import resumable_fit as fitting
from morphoskel.learning.train_classifier import train_classifier
from morphoskel.networks.pointnet_classifier import load_classifier


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


TRAINING, VALIDATION = balls_and_lines(10), balls_and_lines(5, seed=1)


def train(folder, seed=1, settings=TINY, training=TRAINING, names=NAMES):
    return train_classifier(training, VALIDATION, names, settings, folder, seed, accelerator="cpu", progress=False)


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    return train(tmp_path_factory.mktemp("training"))


def weights(path):
    return torch.load(path, weights_only=True)["weights"]


def losses(folder):
    with (folder / "classifier.csv").open(newline="") as file:
        return [row[:3] for row in csv.reader(file)][1:]


def test_a_training_writes_a_network_with_its_names_and_losses(trained):
    network = load_classifier(trained)
    assert trained.name == "network.pt"
    assert network.class_names == NAMES
    assert network.settings == TINY
    assert [int(row[0]) for row in losses(trained.parent)] == list(range(TINY.epochs))


def test_the_network_of_the_best_epoch_gives_its_number_again(trained):
    points, labels = VALIDATION
    network = load_classifier(trained)
    with torch.no_grad():
        classified = network(points)
    likelihood = float(functional.nll_loss(classified.log_probabilities, labels))
    assert likelihood == pytest.approx(min(float(row[2]) for row in losses(trained.parent)), rel=1e-4)
    predicted, descriptors = classify(network, points.numpy())
    assert predicted.tolist() == classified.log_probabilities.argmax(dim=1).tolist()
    np.testing.assert_allclose(descriptors, classified.descriptor.numpy(), atol=1e-5)


@pytest.mark.parametrize("killed_after", [(0, 1), (1, 0), (1, 1)])
def test_a_killed_training_goes_on_to_the_same_result(trained, tmp_path, monkeypatch, killed_after):
    class KilledError(Exception):
        pass

    original = fitting.BatchedPhase.training_step

    def step(phase, batch, index):
        if (phase.current_epoch, index) == killed_after:
            raise KilledError
        return original(phase, batch, index)

    monkeypatch.setattr(fitting.BatchedPhase, "training_step", step)
    with pytest.raises(KilledError):
        train(tmp_path)
    monkeypatch.undo()
    first, second = weights(trained), weights(train(tmp_path))
    assert all(torch.equal(first[name], second[name]) for name in first)
    assert losses(tmp_path) == losses(trained.parent)


def test_the_same_seed_gives_the_same_network_and_another_seed_another(trained, tmp_path):
    state = torch.get_rng_state()
    again, other = weights(train(tmp_path / "again")), weights(train(tmp_path / "other", seed=2))
    assert torch.equal(torch.get_rng_state(), state)
    first = weights(trained)
    assert all(torch.equal(first[name], again[name]) for name in first)
    assert not torch.equal(first["classify.weight"], other["classify.weight"])


def test_a_folder_of_another_training_is_refused(trained):
    for change in ({"seed": 2}, {"names": ("cube", "line")}, {"settings": replace(TINY, penalty=0.0)}):
        with pytest.raises(InputError, match="other settings, clouds or seed"):
            train(trained.parent, **change)
    assert json.loads((trained.parent / "training.json").read_text())["class_names"] == list(NAMES)
    written = trained.stat().st_mtime_ns
    assert train(trained.parent) == trained
    assert trained.stat().st_mtime_ns == written  # a finished training is not repeated


@pytest.mark.parametrize(
    ("points", "labels", "message"),
    [
        (TRAINING[0].double(), TRAINING[1], "training clouds: expected float32"),
        (TRAINING[0][..., :2], TRAINING[1], "training clouds: expected float32"),
        (TRAINING[0][:1], TRAINING[1][:1], "training clouds: expected at least 2, got 1"),
        (TRAINING[0], TRAINING[1][:9], r"training labels: expected int64 \(10,\)"),
        (TRAINING[0], TRAINING[1].int(), r"training labels: expected int64 \(10,\)"),
        (TRAINING[0], TRAINING[1] + 1, "training labels: expected 0 to 1 for 2 class names, got 1 to 2"),
    ],
)
def test_clouds_and_labels_must_fit(tmp_path, points, labels, message):
    with pytest.raises(InputError, match=message):
        train(tmp_path, training=(points, labels))
    assert not (tmp_path / "training.json").exists()
