import numpy as np
import pandas as pd
import pytest
import torch
from tiny_classifier import NAMES
from tiny_clouds import same_weights, select, tiny_classifier, tiny_clouds, tiny_priors
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import ConfigError, DatasetError, InputError
from morphoskel.evaluation.sampled_shapes import evaluate_files
from morphoskel.learning import resumable_fit as fitting
from morphoskel.learning.sampler_training import train_sampler_on_files
from morphoskel.learning.train_sampler import SamplerTraining, train_sampler
from morphoskel.networks.point_generator import load_generator
from morphoskel.networks.pointnet_classifier import save_classifier
from morphoskel.networks.skeleton_sampler import load_skeleton_sampler
from morphoskel.sampling.choose_for_split import choose_for_split
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.prior_set import write_prior_set
from morphoskel.sampling.sampler_weights import sampler_weights

CLOUDS = tiny_clouds(shapes=9)
PRIORS = tiny_priors(CLOUDS, failed=(2,))
PRIOR = {"bins": 6, "sharpness": 1.0}


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    write_cloud_set(CLOUDS, folder / "clouds.npz")
    write_prior_set(PRIORS, folder / "priors.npz")
    for seed, name in enumerate(("task", "teacher")):
        save_classifier(tiny_classifier(seed=seed), NAMES, folder / f"{name}.pt")
    return folder


def train(files, result, sampler="ms3d", clouds="clouds.npz", priors="priors.npz", judges=("task",), **changes):
    generates = sampler in ("snet", "samplenet", "metasampler")
    own = (TINY if generates else TINY_SAMPLER).as_mapping()
    lists = {name: list(value) if isinstance(value, tuple) else value for name, value in own.items()}
    values = {"ratio": 5, "number": 0, "seed": 3, "settings": lists, "prior": PRIOR, "steps": 6,
              "validation_share": 0.34, "accelerator": "cpu"}  # fmt: skip
    train_sampler_on_files(
        sampler, files / clouds, [files / f"{name}.pt" for name in judges],
        None if priors is None or generates else files / priors, result, result.parents[2] / "checkpoints",
        **{**values, **changes},
    )  # fmt: skip
    return result


@pytest.fixture(scope="module")
def trained(files):
    return train(files, files / "networks" / "5" / "0" / "network.pt")


def trainings(files):
    return sorted(path.name for path in (files / "networks" / "checkpoints").iterdir())


def test_the_network_is_that_of_training_on_arrays(trained, tmp_path):
    training = SamplerTraining("ms3d", 8, TINY_SAMPLER, 6, 0.34, 3, 0, {"prior": PRIOR})
    weights = sampler_weights("ms3d", CLOUDS, PRIORS, PriorSettings(**PRIOR), 3)
    judges = [tiny_classifier()]
    expected = train_sampler(training, CLOUDS, weights, judges, tmp_path, accelerator="cpu", progress=False)
    assert same_weights(trained, expected)


def test_the_file_tells_how_it_was_trained(files, trained, tmp_path):
    network = load_skeleton_sampler(trained)
    assert network.samples == 40 // 5
    assert network.origin == {"sampler": "ms3d", "points": 40, "prior": PRIOR}
    generator = load_generator(train(files, tmp_path / "5" / "0" / "network.pt", "snet"))
    assert generator.samples == 8
    assert generator.origin == {"sampler": "snet", "points": 40}


def test_trainings_with_other_settings_do_not_mix(files, trained):
    before = len(trainings(files))
    write_prior_set(tiny_priors(CLOUDS, failed=(3,)), files / "other_priors.npz")
    write_cloud_set(select(CLOUDS, list(range(8, -1, -1))), files / "other_clouds.npz")
    write_prior_set(select(PRIORS, list(range(8, -1, -1))), files / "priors_of_other_clouds.npz")
    changes = [
        {"ratio": 10}, {"number": 1}, {"seed": 4}, {"prior": {"bins": 3, "sharpness": 1.0}},
        {"judges": ("teacher",)}, {"priors": "other_priors.npz"}, {"sampler": "shuffled"},
        {"clouds": "other_clouds.npz", "priors": "priors_of_other_clouds.npz"},
    ]  # fmt: skip
    for number, change in enumerate(changes, start=1):
        changed = train(files, files / "networks" / "changed" / str(number) / "network.pt", **change)
        assert len(trainings(files)) == before + number
        assert changed.read_bytes() != trained.read_bytes()
    # Fewer steps may keep the same epoch, but never by the other training's checkpoints.
    train(files, files / "networks" / "changed" / "steps" / "network.pt", steps=3)
    assert len(trainings(files)) == before + len(changes) + 1


def test_a_finished_training_gives_its_file_again_without_training(files, trained, monkeypatch):
    before = trainings(files)
    monkeypatch.setattr("morphoskel.learning.train_sampler.resumable_fit", None)  # cannot be called
    again = train(files, files / "networks" / "again" / "0" / "network.pt")
    assert again.read_bytes() == trained.read_bytes()
    assert trainings(files) == before


def test_a_killed_training_goes_on_to_the_same_network(files, trained, tmp_path, monkeypatch):
    class KilledError(Exception):
        pass

    original = fitting.BatchedPhase.training_step
    steps = []

    def step(phase, batch, index):
        if (phase.current_epoch, index) == (1, 0):
            raise KilledError
        return original(phase, batch, index)

    def counted(phase, batch, index):
        steps.append(index)
        return original(phase, batch, index)

    result = tmp_path / "5" / "0" / "network.pt"
    monkeypatch.setattr(fitting.BatchedPhase, "training_step", step)
    with pytest.raises(KilledError):
        train(files, result)
    assert not result.exists()
    # Another training between does not take over what the killed one left.
    monkeypatch.setattr(fitting.BatchedPhase, "training_step", counted)
    train(files, tmp_path / "5" / "1" / "network.pt", number=1)
    every_step = len(steps)
    steps.clear()
    assert same_weights(train(files, result), trained)
    assert 0 < len(steps) < every_step  # the first epoch was not repeated


def chosen_and_judged(files, networks, sampler, folder):
    priors = files / "priors.npz" if sampler == "ms3d" else None
    choose_for_split(
        sampler, files / "clouds.npz", folder / "samples", networks=networks, priors=priors, ratios=(5,), draws=2,
        seed=3, prior=PRIOR, lfs=None,
    )  # fmt: skip
    outputs = (folder / "shapes.csv", folder / "draws.csv")
    judges = {name: files / f"{name}.pt" for name in ("task", "teacher")}
    evaluate_files(sampler, files / "clouds.npz", folder / "samples", priors, judges, outputs)
    return outputs


@pytest.mark.parametrize("sampler", ["ms3d", "samplenet"])
def test_training_choosing_and_judging_give_the_same_numbers_twice(files, tmp_path, sampler):
    found = []
    for name in ("first", "second"):
        network = train(files, tmp_path / name / "5" / "0" / "network.pt", sampler)
        found.append(chosen_and_judged(files, [network], sampler, tmp_path / name))
    for first, second in zip(*found, strict=True):
        assert first.read_bytes() == second.read_bytes()
    shapes, draws = map(pd.read_csv, found[0])
    failed = shapes["status"] == "failed"
    assert shapes.loc[failed, "id"].unique().tolist() == (["s2"] if sampler == "ms3d" else [])
    assert shapes.loc[failed, "correct"].isna().all()
    means = shapes.groupby(["choice", "classifier"])["correct"].mean()
    assert np.allclose(means, draws.groupby(["choice", "classifier"])["oa"].mean())
    assert set(shapes["choice"]) == ({"drawn", "argmax", "completed"} if sampler == "ms3d" else {"fixed"})


def test_missing_and_wrong_files_are_named_and_leave_nothing(files, tmp_path):
    result = tmp_path / "5" / "0" / "network.pt"
    (files / "wrong.pt").write_text("no network")
    write_prior_set(tiny_priors(tiny_clouds(shapes=4)), files / "wrong.npz")
    cases = [
        (InputError, r"absent\.npz: expected a file of clouds", {"clouds": "absent.npz"}),
        (DatasetError, r"absent\.pt: cannot be read", {"judges": ("absent",)}),
        (InputError, r"wrong\.pt: not a classifier", {"judges": ("wrong",)}),
        (InputError, "ms3d: local feature sizes are needed", {"priors": None}),
        (InputError, r"absent\.npz: expected a file of local feature sizes", {"priors": "absent.npz"}),
        (InputError, r"wrong\.npz: belongs to other clouds", {"priors": "wrong.npz"}),
        (InputError, "ms3d: expected one classifier, got 2", {"judges": ("task", "teacher")}),
        (ConfigError, "bins: expected at least 1", {"prior": {"bins": 0, "sharpness": 1.0}}),
        (ConfigError, "samples: expected at least 1 point to choose, got 0", {"ratio": 41}),
    ]
    for error, message, changes in cases:
        with pytest.raises(error, match=message):
            train(files, result, **changes)
    assert not result.exists()
