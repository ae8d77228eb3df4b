import csv
import json
from dataclasses import replace

import numpy as np
import pytest
import torch
from tiny_classifier import NAMES
from tiny_clouds import same_weights, select, tiny_classifier, tiny_clouds, tiny_priors
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.errors import ConfigError, InputError
from morphoskel.learning import resumable_fit as fitting
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.train_sampler import SamplerTraining, train_sampler
from morphoskel.networks.point_generator import load_generator
from morphoskel.networks.skeleton_sampler import load_skeleton_sampler
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.sampler_weights import sampler_weights


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


CLOUDS = tiny_clouds(shapes=9)
CLASSIFIER = tiny_classifier()
SAMPLES = 6


def weigh(sampler, failed=()):
    return sampler_weights(sampler, CLOUDS, tiny_priors(CLOUDS, failed), PriorSettings(bins=6, sharpness=1.0), 0)


def training_of(sampler="ms3d", **changes):
    settings = TINY if sampler in ("snet", "samplenet", "metasampler") else TINY_SAMPLER
    values = {"samples": SAMPLES, "settings": settings, "steps": None, "validation_share": 0.34, "seed": 3, "number": 0}
    return SamplerTraining(sampler, **{**values, **changes})


def train(folder, sampler="ms3d", *, weights="prior", clouds=CLOUDS, classifiers=(CLASSIFIER,), devices=1, **changes):
    training = training_of(sampler, **changes)
    if isinstance(weights, str):
        weights = weigh(sampler) if training.settings is TINY_SAMPLER else None
    return train_sampler(training, clouds, weights, classifiers, folder, accelerator="cpu", devices=devices,
                         progress=False)  # fmt: skip


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    return train(tmp_path_factory.mktemp("ms3d"))


@pytest.fixture(scope="module")
def generator(tmp_path_factory):
    return train(tmp_path_factory.mktemp("samplenet"), "samplenet")


def losses(path):
    with (path.parent / "sampler.csv").open(newline="") as file:
        return [row[:3] for row in csv.reader(file)][1:]


class KilledError(Exception):
    pass


def kill_at(monkeypatch, epoch, batch):
    original = fitting.BatchedPhase.training_step

    def step(phase, tensors, index):
        if (phase.current_epoch, index) == (epoch, batch):
            raise KilledError
        return original(phase, tensors, index)

    monkeypatch.setattr(fitting.BatchedPhase, "training_step", step)


def seen_by(monkeypatch, folder, sampler, **changes):
    """Return the points of every batch of a training, and the weights that it started with."""
    batches, start = [], []
    original = fitting.BatchedPhase.training_step

    def step(phase, batch, index):
        if not batches:
            start.append({name: tensor.clone() for name, tensor in phase.network.state_dict().items()})
        batches.append(batch[0].clone())
        return original(phase, batch, index)

    with monkeypatch.context() as patch:
        patch.setattr(fitting.BatchedPhase, "training_step", step)
        train(folder, sampler, **changes)
    return batches, start[0]


def test_a_training_writes_a_network_that_knows_its_origin(trained, generator):
    network = load_skeleton_sampler(trained)
    assert (network.samples, network.settings) == (SAMPLES, TINY_SAMPLER)
    assert network.origin == {"sampler": "ms3d", "points": 40}
    assert [int(row[0]) for row in losses(trained)] == list(range(TINY_SAMPLER.epochs))
    other = load_generator(generator)
    assert (other.samples, other.settings) == (SAMPLES, TINY)
    assert other.origin == {"sampler": "samplenet", "points": 40}
    assert [int(row[0]) for row in losses(generator)] == list(range(TINY.epochs))


def test_only_the_sampler_is_trained(trained):
    untrained = tiny_classifier().state_dict()
    assert all(torch.equal(tensor, untrained[name]) for name, tensor in CLASSIFIER.state_dict().items())
    checkpoint = torch.load(trained.parent / "sampler" / "last.ckpt", weights_only=True)
    assert all(name.startswith("network.") for name in checkpoint["state_dict"])


def test_the_same_training_gives_the_same_network_and_leaves_the_random_state(trained, generator, tmp_path):
    state = torch.get_rng_state()
    assert same_weights(trained, train(tmp_path / "ms3d"))
    assert torch.equal(torch.get_rng_state(), state)
    assert same_weights(generator, train(tmp_path / "samplenet", "samplenet"))


@pytest.mark.parametrize(("epoch", "batch"), [(0, 1), (1, 0), (1, 1)])
def test_a_killed_training_goes_on_to_the_same_network(trained, tmp_path, monkeypatch, epoch, batch):
    with monkeypatch.context() as patch:
        kill_at(patch, epoch, batch)
        with pytest.raises(KilledError):
            train(tmp_path)
    assert not (tmp_path / "network.pt").exists()
    assert same_weights(train(tmp_path), trained)
    assert losses(tmp_path / "network.pt") == losses(trained)


def test_a_killed_generator_goes_on_to_the_same_network(generator, tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        kill_at(patch, 2, 0)
        with pytest.raises(KilledError):
            train(tmp_path, "samplenet")
    assert same_weights(train(tmp_path, "samplenet"), generator)


def test_a_finished_training_is_not_repeated(trained):
    written = trained.stat().st_mtime_ns
    assert train(trained.parent) == trained
    assert trained.stat().st_mtime_ns == written


def test_a_folder_of_another_training_is_refused(trained):
    changes = [
        {"seed": 4}, {"number": 1}, {"samples": 5}, {"steps": 9}, {"settings": replace(TINY_SAMPLER, dropout=0.1)},
        {"sampler": "dpc"}, {"validation_share": 0.2}, {"origin": {"prior": 1}}, {"weights": weigh("uniform")},
        {"classifiers": [tiny_classifier(seed=1)]}, {"clouds": tiny_clouds(shapes=9, seed=1)}, {"devices": 2},
    ]  # fmt: skip
    for change in changes:
        if "settings" in change:
            change["weights"] = weigh("ms3d")
        with pytest.raises(InputError, match="other settings, clouds or seed"):
            train(trained.parent, **change)
    assert same_weights(trained, train(trained.parent))


def test_priors_of_the_same_number_start_alike_and_see_the_same_batches(tmp_path, monkeypatch):
    batches, start = seen_by(monkeypatch, tmp_path / "a", "ms3d")
    others, other_start = seen_by(monkeypatch, tmp_path / "b", "uniform")
    assert len(batches) == len(others) == TINY_SAMPLER.epochs * 3
    assert all(map(torch.equal, batches, others))
    assert all(torch.equal(start[name], other_start[name]) for name in start)
    assert not same_weights(tmp_path / "a" / "network.pt", tmp_path / "b" / "network.pt")  # the prior matters
    next_batches, next_start = seen_by(monkeypatch, tmp_path / "c", "ms3d", number=1)
    assert not all(map(torch.equal, batches, next_batches))
    assert not torch.equal(start["linear.weight"], next_start["linear.weight"])


def test_equal_weights_give_equal_networks_whatever_the_priors_are_called(trained, tmp_path):
    assert same_weights(train(tmp_path / "dpc", "dpc", weights=weigh("ms3d")), trained)
    assert same_weights(train(tmp_path / "uniform", "uniform", weights=weigh("ms3d")), trained)
    assert load_skeleton_sampler(tmp_path / "dpc" / "network.pt").origin["sampler"] == "dpc"


def test_generators_start_each_with_its_own_weights(generator, tmp_path):
    assert not same_weights(train(tmp_path, "snet"), generator)


def test_several_classifiers_judge_a_generator(tmp_path):
    teachers = [tiny_classifier(seed=number) for number in range(2)]
    first = train(tmp_path / "two", "metasampler", classifiers=teachers)
    second = train(tmp_path / "one", "metasampler", classifiers=teachers[:1])
    assert not same_weights(first, second)


@pytest.mark.parametrize(("steps", "epochs"), [(1, 1), (3, 1), (4, 2), (6, 2), (8, 3)])
def test_steps_are_spread_over_epochs_of_equal_length(tmp_path, monkeypatch, steps, epochs):
    batches, _ = seen_by(monkeypatch, tmp_path, "ms3d", steps=steps)
    assert len(losses(tmp_path / "network.pt")) == epochs  # of at most three batches each
    assert len(batches) == -(-steps // epochs) * epochs


def test_shapes_without_a_skeleton_are_left_out_of_both_parts(tmp_path, monkeypatch, caplog):
    parts = hold_out(CLOUDS.categories.tolist(), 0.34, 3)
    failed = [int(part[0]) for part in parts]
    batches, _ = seen_by(monkeypatch, tmp_path / "some", "ms3d", weights=weigh("ms3d", failed))
    assert "2 of 9 shapes have no skeleton and are left out" in caplog.text
    seen = {points.numpy().tobytes() for batch in batches for points in batch}
    left = [number for number in parts[0] if number not in failed]
    assert seen <= {CLOUDS.points[number].tobytes() for number in left}
    # What the left-out shapes are does not matter to the network.
    others = replace(CLOUDS, points=CLOUDS.points.copy())
    others.points[failed] = 0.5
    again = train(tmp_path / "others", clouds=others, weights=weigh("ms3d", failed))
    assert same_weights(tmp_path / "some" / "network.pt", again)


def test_held_out_shapes_are_not_trained_on(tmp_path, monkeypatch):
    training, held_out = hold_out(CLOUDS.categories.tolist(), 0.34, 3)
    batches, _ = seen_by(monkeypatch, tmp_path, "ms3d")
    seen = {points.numpy().tobytes() for batch in batches for points in batch}
    assert seen == {CLOUDS.points[number].tobytes() for number in training}
    assert not seen & {CLOUDS.points[number].tobytes() for number in held_out}


def refused(folder, message, error=InputError, **arguments):
    with pytest.raises(error, match=message):
        train(folder, **arguments)
    assert not folder.exists()  # nothing claims it


def test_what_does_not_fit_the_sampler_is_refused(tmp_path):
    folder, weights = tmp_path / "training", weigh("ms3d")
    refused(folder, "fps: no such learned sampler; legal: snet, ", ConfigError, sampler="fps")
    refused(folder, "ms3d: expected a skeleton sampler's settings and a prior", weights=None)
    refused(folder, "ms3d: expected a skeleton sampler's settings and a prior", settings=TINY, weights=weights)
    refused(folder, "snet: expected a generator's settings and no prior", sampler="snet", weights=weights)
    refused(folder, "snet: expected a generator's", sampler="snet", settings=TINY_SAMPLER, weights=None)
    refused(folder, "ms3d: expected one classifier, got 2", classifiers=[CLASSIFIER, tiny_classifier(seed=1)])
    refused(folder, "ms3d: expected one classifier, got 0", classifiers=[])
    refused(folder, "metasampler: expected at least one classifier, got 0", sampler="metasampler", classifiers=[])
    refused(folder, "classes ball, line, got one of line, ball", classifiers=[tiny_classifier(names=NAMES[::-1])])


def test_too_few_shapes_are_refused(tmp_path):
    folder = tmp_path / "training"
    training, held_out = (part.tolist() for part in hold_out(CLOUDS.categories.tolist(), 0.34, 3))
    for failed in (training, held_out):
        message = "ms3d: no shape with a skeleton is left to train on or to hold out"
        refused(folder, message, weights=weigh("ms3d", failed))
    refused(folder, "at least 2 are needed", clouds=select(CLOUDS, [0]), weights=weigh("ms3d")[:1])
    with pytest.raises(InputError, match="6 shapes make too few batches for 4 devices"):
        train(folder, devices=4)


def test_the_claim_names_the_training(trained):
    identity = json.loads((trained.parent / "training.json").read_text())
    assert identity["training"] == repr(training_of())
    assert len(identity["classifiers"]) == 1
    assert len({*identity["sha256_of_clouds"]}) == 6  # points, labels and weights of both parts


def test_training_moves_the_sampler_towards_the_task(tmp_path):
    """The loss on soft samples falls."""
    weights = np.ones((9, 40), dtype=np.float32)
    settings = replace(TINY_SAMPLER, epochs=12, learning_rate=3e-2, dropout=0.0, batch_size=6)
    path = train(tmp_path, "uniform", weights=weights, settings=settings)
    training_losses = [float(row[1]) for row in losses(path)]
    assert min(training_losses[6:]) < training_losses[0]
