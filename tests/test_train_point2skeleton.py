import csv
import json

import numpy as np
import pytest
import torch
from tiny_point2skeleton import TINY

from morphoskel.errors import InputError
from morphoskel.learning import resumable_fit as fitting
from morphoskel.learning.train_point2skeleton import train_point2skeleton
from morphoskel.networks.point2skeleton_network import load_point2skeleton


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def clouds():
    generator = np.random.default_rng(0)
    return [generator.normal(size=(80, 3)) * (1, 0.5, 0.2) for _ in range(7)]


def train(clouds, folder, seed=1, settings=TINY):
    return train_point2skeleton(clouds[:5], clouds[5:], settings, folder, seed, accelerator="cpu", progress=False)


@pytest.fixture(scope="module")
def trained(clouds, tmp_path_factory):
    return train(clouds, tmp_path_factory.mktemp("training"))


def weights(path):
    return torch.load(path, weights_only=True)["weights"]


def losses(path):
    with path.open(newline="") as file:
        return [row[:3] for row in csv.reader(file)]  # without the seconds


def test_a_training_writes_a_network_and_its_losses(trained, clouds):
    network = load_point2skeleton(trained)
    assert network.settings == TINY
    assert not network.training
    for name, epochs in (("pretrain", 2), ("skeleton", 3), ("links", 2)):
        header, *rows = losses(trained.parent / f"{name}.csv")
        assert header == ["epoch", "training_loss", "validation_loss"]
        assert [int(row[0]) for row in rows] == list(range(epochs))
        assert np.isfinite(np.array(rows, dtype=float)).all()


def test_every_phase_trains_its_own_part_only(trained):
    states = [
        torch.load(trained.parent / name / "best.ckpt", weights_only=True)["state_dict"]
        for name in ("skeleton", "links")
    ]
    final = weights(trained)
    for name, value in states[0].items():
        assert torch.equal(final[name.replace("network.", "skeletal_points.", 1)], value)
    assert all(torch.equal(final[name.removeprefix("network.")], value) for name, value in states[1].items())


def test_the_same_seed_gives_the_same_network_and_another_seed_another(trained, clouds, tmp_path):
    state = torch.get_rng_state()
    again, other = weights(train(clouds, tmp_path / "again")), weights(train(clouds, tmp_path / "other", seed=2))
    assert torch.equal(torch.get_rng_state(), state)
    first = weights(trained)
    assert all(torch.equal(first[name], again[name]) for name in first)
    assert not all(torch.equal(first[name], other[name]) for name in first)


@pytest.mark.parametrize("killed_after", [("skeleton", 0, 1), ("skeleton", 1, 0), ("links", 0, 1)])
def test_a_killed_training_goes_on_to_the_same_result(trained, clouds, tmp_path, monkeypatch, killed_after):
    """Killed in the middle of an epoch or before its first step, it ends with the very same weights and losses."""

    class KilledError(Exception):
        pass

    original = fitting.BatchedPhase.training_step

    def step(phase, batch, index):
        if (phase.name, phase.current_epoch, index) == killed_after:
            raise KilledError
        return original(phase, batch, index)

    monkeypatch.setattr(fitting.BatchedPhase, "training_step", step)
    with pytest.raises(KilledError):
        train(clouds, tmp_path)
    monkeypatch.undo()
    resumed = train(clouds, tmp_path)
    first, second = weights(trained), weights(resumed)
    assert all(torch.equal(first[name], second[name]) for name in first)
    for name in ("pretrain", "skeleton", "links"):
        assert losses(resumed.parent / f"{name}.csv") == losses(trained.parent / f"{name}.csv")


def test_a_folder_of_another_training_is_refused(trained, clouds):
    with pytest.raises(InputError, match="other settings, clouds or seed"):
        train(clouds, trained.parent, seed=2)
    assert json.loads((trained.parent / "training.json").read_text())["seed"] == 1
    assert train(clouds, trained.parent) == trained  # a finished training is not repeated


def test_clouds_are_needed(clouds, tmp_path):
    with pytest.raises(InputError, match="at least one training cloud"):
        train_point2skeleton([], clouds, TINY, tmp_path, 0)
    with pytest.raises(InputError, match="at least one validation cloud"):
        train_point2skeleton(clouds, [], TINY, tmp_path, 0)
