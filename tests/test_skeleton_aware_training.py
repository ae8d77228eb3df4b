import numpy as np
import pytest
import torch
from scipy.spatial.distance import cdist
from tiny_clouds import same_weights, select, tiny_clouds
from tiny_skeleton_aware import TINY_SAMPLER, TINY_SKELETON

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import InputError
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.skeleton_aware_training import predict_local_feature_sizes, train_skeleton_aware_on_files
from morphoskel.learning.train_skeleton_aware import train_skeleton_aware
from morphoskel.networks.skeleton_aware_network import load_skeleton_aware, predict_skeleton
from morphoskel.networks.skeleton_sampler import SkeletonSampler, save_skeleton_sampler
from morphoskel.sampling.prior_set import read_prior_set, write_prior_set

CLOUDS = tiny_clouds(shapes=6)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("skeleton_aware")
    write_cloud_set(CLOUDS, folder / "clouds.npz")
    train(folder, "network")
    return folder


def train(folder, result, seed=3, clouds="clouds.npz", **changes):
    settings = {**TINY_SKELETON.as_mapping(), **changes}
    lists = {name: list(value) if isinstance(value, tuple) else value for name, value in settings.items()}
    train_skeleton_aware_on_files(
        folder / clouds, folder / f"{result}.pt", folder / "checkpoints", seed=seed, settings=lists,
        validation_share=0.34, accelerator="cpu",
    )  # fmt: skip
    return folder / f"{result}.pt"


def trainings(folder):
    return sorted(path.name for path in (folder / "checkpoints").iterdir())


def test_the_network_is_that_of_training_on_arrays(files, tmp_path):
    parts = hold_out(CLOUDS.categories.tolist(), 0.34, 3)
    training, validation = (torch.from_numpy(CLOUDS.points[part]) for part in parts)
    expected = train_skeleton_aware(training, validation, TINY_SKELETON, tmp_path, 3, accelerator="cpu", progress=False)
    assert same_weights(files / "network.pt", expected)
    assert load_skeleton_aware(files / "network.pt").settings == TINY_SKELETON


def test_a_finished_training_gives_its_file_again_without_training(files, monkeypatch):
    before = trainings(files)
    monkeypatch.setattr("morphoskel.learning.train_skeleton_aware.resumable_fit", None)  # cannot be called
    assert train(files, "again").read_bytes() == (files / "network.pt").read_bytes()
    assert trainings(files) == before


def test_other_seeds_settings_and_clouds_are_trainings_of_their_own(files):
    write_cloud_set(select(CLOUDS, [1, 0, 2, 3, 4]), files / "other.npz")
    before = len(trainings(files))
    changes = [{"seed": 4}, {"learning_rate": 2e-3}, {"clouds": "other.npz"}]
    for number, change in enumerate(changes, start=1):
        changed = train(files, f"changed{number}", **change)
        assert len(trainings(files)) == before + number
        assert not same_weights(changed, files / "network.pt")
    assert train(files, "back").read_bytes() == (files / "network.pt").read_bytes()


def test_local_feature_sizes_are_distances_to_the_predicted_skeleton(files):
    priors = predict_local_feature_sizes(files / "clouds.npz", files / "network.pt")
    centres, _ = predict_skeleton(load_skeleton_aware(files / "network.pt"), torch.from_numpy(CLOUDS.points))
    assert priors.ids.tolist() == CLOUDS.ids.tolist()
    assert priors.reasons.tolist() == [""] * 6
    assert priors.distances.dtype == np.float32
    for cloud, skeleton, distances in zip(CLOUDS.points, centres.numpy(), priors.distances, strict=True):
        naive = cdist(cloud.astype(np.float64), skeleton.astype(np.float64)).min(axis=1)
        np.testing.assert_allclose(distances, naive, atol=1e-6)
    write_prior_set(priors, files / "priors.npz")
    again = read_prior_set(files / "priors.npz", CLOUDS)
    assert np.array_equal(again.distances, priors.distances)
    assert again.reasons.tolist() == [""] * 6


def test_other_shapes_do_not_change_a_prediction(files, tmp_path):
    order = [4, 1, 3]
    write_cloud_set(select(CLOUDS, order), tmp_path / "some.npz")
    whole = predict_local_feature_sizes(files / "clouds.npz", files / "network.pt")
    some = predict_local_feature_sizes(tmp_path / "some.npz", files / "network.pt")
    np.testing.assert_allclose(some.distances, whole.distances[order], atol=1e-5)


def test_bad_files_are_refused(files, tmp_path):
    with pytest.raises(InputError, match=r"absent\.npz: expected a file of clouds"):
        train(tmp_path, "network", clouds="absent.npz")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(InputError, match=r"absent\.npz: expected a file of clouds"):
        predict_local_feature_sizes(tmp_path / "absent.npz", files / "network.pt")
    with pytest.raises(InputError, match=r"absent\.pt: "):
        predict_local_feature_sizes(files / "clouds.npz", tmp_path / "absent.pt")
    save_skeleton_sampler(SkeletonSampler(3, TINY_SAMPLER), tmp_path / "sampler.pt")
    with pytest.raises(InputError, match=r"sampler\.pt: not a"):
        predict_local_feature_sizes(files / "clouds.npz", tmp_path / "sampler.pt")
