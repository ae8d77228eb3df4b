import csv

import numpy as np
import pytest
import torch
from tiny_skeleton_aware import TINY_SKELETON

from morphoskel.errors import InputError
from morphoskel.learning import resumable_fit as fitting
from morphoskel.learning.train_skeleton_aware import train_skeleton_aware
from morphoskel.networks.skeleton_aware_network import load_skeleton_aware, predict_skeleton


class KilledError(Exception):
    pass


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def clouds():
    return torch.rand(7, 40, 3, generator=torch.Generator().manual_seed(0)) - 0.5


def train(clouds, folder, seed=1):
    return train_skeleton_aware(clouds[:5], clouds[5:], TINY_SKELETON, folder, seed, accelerator="cpu", progress=False)


@pytest.fixture(scope="module")
def trained(clouds, tmp_path_factory):
    return train(clouds, tmp_path_factory.mktemp("training"))


def weights(path):
    return torch.load(path, weights_only=True)["weights"]


def losses(path):
    with path.open(newline="") as file:
        return [row[:3] for row in csv.reader(file)]  # without the seconds


def test_a_training_writes_a_network_and_its_losses(trained, clouds):
    network = load_skeleton_aware(trained)
    assert network.settings == TINY_SKELETON
    for name, epochs in (("pretrain", 2), ("skeleton", 3)):
        header, *rows = losses(trained.parent / f"{name}.csv")
        assert header == ["epoch", "training_loss", "validation_loss"]
        assert [int(row[0]) for row in rows] == list(range(epochs))
        assert np.isfinite(np.array(rows, dtype=float)).all()
    centres, radii = predict_skeleton(network, clouds)
    assert (centres.shape, radii.shape) == ((7, 6, 3), (7, 6))


def test_the_result_is_the_best_epoch_of_the_second_phase(trained):
    state = torch.load(trained.parent / "skeleton" / "best.ckpt", weights_only=True)["state_dict"]
    assert all(torch.equal(weights(trained)[name.removeprefix("network.")], value) for name, value in state.items())


def test_the_same_seed_gives_the_same_network_and_another_seed_another(trained, clouds, tmp_path):
    state = torch.get_rng_state()
    again, other = weights(train(clouds, tmp_path / "again")), weights(train(clouds, tmp_path / "other", seed=2))
    assert torch.equal(torch.get_rng_state(), state)
    first = weights(trained)
    assert all(torch.equal(first[name], again[name]) for name in first)
    assert not all(torch.equal(first[name], other[name]) for name in first)


@pytest.mark.parametrize("killed_after", [("pretrain", 1, 1), ("skeleton", 0, 1), ("skeleton", 1, 0)])
def test_a_killed_training_goes_on_to_the_same_result(trained, clouds, tmp_path, monkeypatch, killed_after):
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
    for name in ("pretrain", "skeleton"):
        assert losses(resumed.parent / f"{name}.csv") == losses(trained.parent / f"{name}.csv")


def test_a_folder_of_another_training_is_refused(trained, clouds):
    with pytest.raises(InputError, match="other settings"):
        train(clouds, trained.parent, seed=2)
    assert train(clouds, trained.parent) == trained  # a finished training is not repeated


def test_clouds_are_needed(clouds, tmp_path):
    with pytest.raises(InputError, match="training clouds: expected shape"):
        train_skeleton_aware(clouds[:0], clouds, TINY_SKELETON, tmp_path, 0)
    with pytest.raises(InputError, match="validation clouds: expected shape"):
        train_skeleton_aware(clouds, clouds[..., :2], TINY_SKELETON, tmp_path, 0)
