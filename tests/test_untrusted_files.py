"""Files from elsewhere that would run code if they were read with trust."""

import pickle
import zipfile
from pathlib import Path

import numpy as np
import pytest
import torch
import yaml
from test_resumable_fit import Regression, fit

from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.task import Task
from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.datasets.manifest import ShapeRecord
from morphoskel.errors import InputError
from morphoskel.formats import read_shape
from morphoskel.formats.skeleton_file import read_skeleton
from morphoskel.networks.network_file import read_network
from morphoskel.reporting.page.configuration import read_configuration
from morphoskel.sampling.choice import read_choice


class Evil:
    """Makes a file when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self):
        return Path.touch, (self.path,)


@pytest.fixture
def evil(tmp_path):
    """Hand out the object; after the test, its code must not have run."""
    yield Evil(tmp_path / "executed")
    assert not (tmp_path / "executed").exists()


def objects(evil):
    array = np.empty(3, dtype=object)
    array[:] = evil
    return array


def test_the_object_does_run_where_it_is_trusted(tmp_path):
    path = tmp_path / "executed"
    np.save(tmp_path / "a.npy", objects(Evil(path)), allow_pickle=True)
    assert not path.exists()
    np.load(tmp_path / "a.npy", allow_pickle=True)
    assert path.exists()


@pytest.mark.parametrize("read", [read_shape, read_skeleton, read_cloud_set, read_choice])
def test_arrays_of_objects(tmp_path, evil, read):
    names = ["points", "radii", "residues", "vertices", "triangles", "ids", "labels", "indices", "distinct"]
    np.savez(tmp_path / "a.npz", **{name: objects(evil) for name in names})
    with pytest.raises(InputError):
        read(tmp_path / "a.npz")


def test_an_array_of_objects_as_cloud(tmp_path, evil):
    np.save(tmp_path / "a.npy", objects(evil), allow_pickle=True)
    with pytest.raises(InputError):
        read_shape(tmp_path / "a.npy")


def test_an_archive_of_arrays_with_a_pickle_for_a_header(tmp_path, evil):
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        for name in ("points.npy", "radii.npy", "points", "radii"):
            archive.writestr(name, pickle.dumps(evil))
    with pytest.raises(InputError):
        read_skeleton(tmp_path / "a.npz")


def test_an_intermediate_of_the_chain(tmp_path, evil):
    folder = tmp_path / "occupancy"
    folder.mkdir()
    np.savez(
        folder / "a.npz",
        **{name: objects(evil) for name in ("states", "crossed_mask", "crossed", "lower", "upper", "seed")},
    )
    record = ShapeRecord("a", "any", "test", 0, tmp_path / "a.ply", "0" * 64)
    task = Task(record, {"occupancy": folder}, tmp_path, {"candidates": {"count": 8, "mode": "grid"}}, seed=0)
    with pytest.raises(ValueError, match="allow_pickle"):
        read_inner_points(task)


def test_a_network(tmp_path, evil):
    for content in (evil, {"settings": {}, "weights": evil}):
        torch.save(content, tmp_path / "network.pt")
        with (
            pytest.raises(InputError, match="not a sampler of this version"),
            read_network(tmp_path / "network.pt", "sampler"),
        ):
            pass


@pytest.mark.parametrize("name", ["last.ckpt", "best.ckpt"])
def test_a_checkpoint_that_a_training_goes_on_from(tmp_path, evil, name):
    fit(Regression(), tmp_path, epochs=1)
    path = tmp_path / "line" / name
    torch.save({**torch.load(path, weights_only=True), "extra": evil}, path)
    with pytest.raises(InputError, match="Delete the folder to train anew"):
        fit(Regression(), tmp_path, epochs=1)


def test_a_configuration(tmp_path, evil):
    text = f"run: !!python/object/apply:pathlib.Path.touch [{evil.path}]\n"
    (tmp_path / "config.yaml").write_text(text)
    with pytest.raises(InputError, match="as YAML"):
        read_configuration(tmp_path / "config.yaml")
    with pytest.raises(yaml.YAMLError):
        yaml.safe_load(text)
