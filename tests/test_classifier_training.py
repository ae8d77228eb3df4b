import dataclasses

import numpy as np
import pytest
import torch
from tiny_classifier import NAMES, TINY
from tiny_clouds import same_weights, tiny_clouds

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import ConfigError, InputError
from morphoskel.learning.classifier_training import train_classifier_on_files
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.train_classifier import train_classifier
from morphoskel.networks.pointnet_classifier import load_classifier
from morphoskel.seeds import derive_seed

CLOUDS = tiny_clouds(shapes=8)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("classifier")
    write_cloud_set(CLOUDS, folder / "clouds.npz")
    train(folder, "task")
    return folder


def train(folder, result, name="task", seed=3, clouds="clouds.npz", **changes):
    settings = {**TINY.as_mapping(), **changes}
    train_classifier_on_files(
        name, folder / clouds, folder / f"{result}.pt", folder / "checkpoints", seed=seed, settings=settings,
        validation_share=0.25, accelerator="cpu",
    )  # fmt: skip
    return folder / f"{result}.pt"


def trainings(folder):
    return sorted(path.name for path in (folder / "checkpoints").iterdir())


def test_the_file_holds_a_classifier_of_the_classes(files):
    network = load_classifier(files / "task.pt")
    assert network.class_names == NAMES
    assert network.settings == TINY
    CLOUDS.check_classes(network.class_names)


def test_the_network_is_that_of_training_on_arrays(files, tmp_path):
    parts = hold_out(CLOUDS.categories.tolist(), 0.25, 3)
    training, validation = (
        (torch.from_numpy(CLOUDS.points[part]), torch.from_numpy(CLOUDS.labels[part])) for part in parts
    )
    seed = derive_seed(3, "classifier", "task")
    expected = train_classifier(training, validation, NAMES, TINY, tmp_path, seed, accelerator="cpu", progress=False)
    assert same_weights(files / "task.pt", expected)


def test_a_finished_training_gives_its_file_again_without_training(files, monkeypatch):
    before = trainings(files)
    monkeypatch.setattr("morphoskel.learning.train_classifier.resumable_fit", None)  # cannot be called
    assert train(files, "again").read_bytes() == (files / "task.pt").read_bytes()
    assert trainings(files) == before
    assert not list(files.glob("*.partial"))


def test_other_names_seeds_settings_and_clouds_are_trainings_of_their_own(files):
    other = dataclasses.replace(CLOUDS, points=np.ascontiguousarray(CLOUDS.points[:, ::-1]))
    write_cloud_set(other, files / "other.npz")
    before = len(trainings(files))
    changes = [{"name": "teacher_0"}, {"seed": 4}, {"shift": 0.05}, {"clouds": "other.npz"}]
    for number, change in enumerate(changes, start=1):
        changed = train(files, f"changed{number}", **change)
        assert len(trainings(files)) == before + number
        assert not same_weights(changed, files / "task.pt")
    assert train(files, "back").read_bytes() == (files / "task.pt").read_bytes()


def test_bad_input_is_refused(tmp_path):
    write_cloud_set(CLOUDS, tmp_path / "clouds.npz")
    with pytest.raises(InputError, match=r"absent\.npz: expected a file of clouds"):
        train(tmp_path, "task", clouds="absent.npz")
    with pytest.raises(ConfigError, match="epochs: expected at least 1"):
        train(tmp_path, "task", epochs=0)
    assert [path.name for path in tmp_path.iterdir()] == ["clouds.npz"]
