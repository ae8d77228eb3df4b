import shutil

import numpy as np
import pytest
import torch
from tiny_classifier import NAMES
from tiny_clouds import seeded, select, tiny_classifier, tiny_clouds, tiny_priors
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.datasets.cloud_set import read_cloud_set, write_cloud_set
from morphoskel.errors import InputError
from morphoskel.networks.point_generator import PointGenerator, save_generator
from morphoskel.networks.pointnet_classifier import save_classifier
from morphoskel.networks.skeleton_sampler import SkeletonSampler, save_skeleton_sampler
from morphoskel.sampling.choice import Choice, write_choice
from morphoskel.sampling.choose_for_split import choose_for_split, read_choices
from morphoskel.sampling.choose_points import Request, choose_points
from morphoskel.sampling.lfs import LfsSettings, lfs_points
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.prior_set import write_prior_set
from morphoskel.sampling.sampler_weights import sampler_weights

CLOUDS = tiny_clouds(shapes=5)
PRIORS = tiny_priors(CLOUDS, failed=(2,))
PRIOR = {"bins": 6, "sharpness": 1.0}
LFS = {"exponent": 1.0, "floor": 0.1}


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A folder with clouds, priors, a classifier and untrained networks of the ratios 4 and 8, two of each."""
    folder = tmp_path_factory.mktemp("files")
    write_cloud_set(CLOUDS, folder / "clouds.npz")
    write_prior_set(PRIORS, folder / "priors.npz")
    save_classifier(tiny_classifier(), NAMES, folder / "task.pt")
    for ratio in (4, 8):
        for number in range(2):
            place = f"{ratio}/{number}/network.pt"
            seed = 10 * ratio + number
            save_generator(seeded(PointGenerator, 40 // ratio, TINY, seed=seed), folder / "snet" / place)
            network = seeded(SkeletonSampler, 40 // ratio, TINY_SAMPLER, seed=seed)
            save_skeleton_sampler(network, folder / "ms3d" / place)
    return folder


def choose(files, sampler, folder, networks=(), ratios=(4, 8), **others):
    values = {"priors": files / "priors.npz", "draws": 2, "seed": 5, "prior": PRIOR, "lfs": LFS}
    choose_for_split(sampler, files / "clouds.npz", folder, networks=networks, ratios=ratios, **{**values, **others})
    return read_choices(folder)


def test_a_sampler_without_training_chooses_once_for_each_ratio(files, tmp_path):
    chosen = choose(files, "fps", tmp_path / "fps", priors=None, ratios=(8, 4, 40))
    assert list(chosen) == [(4, 0, "fixed"), (8, 0, "fixed"), (40, 0, "fixed")]  # by number, not by letters
    assert [choice.indices.shape for choice in chosen.values()] == [(1, 5, 10), (1, 5, 5), (1, 5, 1)]
    assert np.array_equal(chosen[4, 0, "fixed"].indices[..., :5], chosen[8, 0, "fixed"].indices)
    assert sorted(path.name for path in (tmp_path / "fps").iterdir()) == [
        "40_0_fixed.npz", "4_0_fixed.npz", "8_0_fixed.npz"
    ]  # fmt: skip


def test_lfs_takes_the_sizes_of_the_file(files, tmp_path):
    chosen = choose(files, "lfs", tmp_path / "lfs")[4, 0, "fixed"]
    assert (chosen.indices[0, 2] == -1).all()
    assert (np.delete(chosen.indices, 2, axis=1) >= 0).all()
    for number in (0, 1, 3, 4):
        cloud, sizes = (array[number].astype(np.float64) for array in (CLOUDS.points, PRIORS.distances))
        assert chosen.indices[0, number].tolist() == lfs_points(cloud, sizes, 10, LfsSettings(**LFS)).tolist()


@pytest.mark.parametrize(
    ("sampler", "kinds"),
    [("snet", ["fixed"]), *((name, ["argmax", "completed", "drawn"]) for name in ("ms3d", "shuffled"))],
)
def test_every_network_chooses(files, tmp_path, sampler, kinds):
    networks = sorted((files / ("snet" if sampler == "snet" else "ms3d")).glob("*/*/network.pt"))
    assert len(networks) == 4
    chosen = choose(files, sampler, tmp_path / "samples", networks[::-1])
    assert list(chosen) == [(ratio, number, kind) for ratio in (4, 8) for number in (0, 1) for kind in kinds]
    for (ratio, _, _), choice in chosen.items():
        assert choice.indices.shape[1:] == (5, 40 // ratio)
    # No two networks choose the same points.
    assert len({chosen[4, number, kinds[0]].indices.tobytes() for number in (0, 1)}) == 2


def test_the_choices_are_those_of_arrays(files, tmp_path):
    weights = sampler_weights("shuffled", CLOUDS, PRIORS, PriorSettings(**PRIOR), 5)
    path = files / "ms3d" / "8" / "1" / "network.pt"
    network = seeded(SkeletonSampler, 5, TINY_SAMPLER, seed=81)
    expected = choose_points(Request("shuffled", 5, 2, 5, 1), CLOUDS, network=network, weights=weights, progress=False)
    chosen = choose(files, "shuffled", tmp_path / "samples", [path])
    assert set(chosen) == {(8, 1, kind) for kind in expected}  # the ratios that have networks
    for (_, _, kind), choice in chosen.items():
        assert np.array_equal(choice.indices, expected[kind].indices)
        assert np.array_equal(choice.distinct, expected[kind].distinct)


def test_a_choice_is_repeated_to_the_last_bit(files, tmp_path):
    networks = [files / "ms3d" / "8" / "0" / "network.pt"]
    first = choose(files, "ms3d", tmp_path / "samples", networks)
    content = (tmp_path / "samples" / "8_0_drawn.npz").read_bytes()
    (tmp_path / "samples" / "old.txt").touch()
    again = choose(files, "ms3d", tmp_path / "samples", networks)
    assert not (tmp_path / "samples" / "old.txt").exists()  # the folder is replaced as a whole
    assert all(np.array_equal(first[key].indices, again[key].indices) for key in first)
    assert (tmp_path / "samples" / "8_0_drawn.npz").read_bytes() == content
    other = choose(files, "ms3d", tmp_path / "other", networks, seed=6)
    assert not np.array_equal(first[8, 0, "drawn"].indices, other[8, 0, "drawn"].indices)


def test_fewer_shapes_leave_the_choices_of_the_others(files, tmp_path):
    networks = [files / "ms3d" / "8" / "0" / "network.pt"]
    first = choose(files, "ms3d", tmp_path / "first", networks)
    order = [4, 1, 2]
    write_cloud_set(select(read_cloud_set(files / "clouds.npz"), order), tmp_path / "some" / "clouds.npz")
    write_prior_set(select(PRIORS, order), tmp_path / "some" / "priors.npz")
    some = choose(tmp_path / "some", "ms3d", tmp_path / "second", networks)
    assert all(np.array_equal(some[key].indices, first[key].indices[:, order]) for key in first)


def test_networks_choose_as_many_points_in_larger_clouds(files, tmp_path):
    larger = tiny_clouds(shapes=3, points=80)
    write_cloud_set(larger, tmp_path / "clouds.npz")
    networks = [files / "snet" / str(ratio) / str(number) / "network.pt" for ratio in (4, 8) for number in (0, 1)]
    chosen = choose(tmp_path, "snet", tmp_path / "samples", networks, ratios=(8, 16), priors=None)
    assert list(chosen) == [(ratio, number, "fixed") for ratio in (8, 16) for number in (0, 1)]
    assert {key[0]: choice.indices.shape for key, choice in chosen.items()} == {8: (1, 3, 10), 16: (1, 3, 5)}
    assert max(choice.indices.max() for choice in chosen.values()) >= 40


def test_wrong_and_missing_files_are_named_and_nothing_is_left(files, tmp_path):
    ms3d, snet = (files / name / "8" / "0" / "network.pt" for name in ("ms3d", "snet"))
    unnumbered = tmp_path / "first" / "network.pt"
    unnumbered.parent.mkdir()
    shutil.copy(ms3d, unnumbered)
    write_prior_set(tiny_priors(tiny_clouds(shapes=4)), tmp_path / "priors.npz")
    cases = [
        ("ms3d", [files / "9" / "0" / "network.pt"], {}, r"9/0/network\.pt: no trained skeleton-aware sampler there"),
        ("ms3d", [snet], {}, r"network\.pt: not a skeleton-aware sampler"),
        ("snet", [ms3d], {}, r"network\.pt: not a generator of points"),
        ("ms3d", [unnumbered], {}, r"network\.pt: expected its folder to be named by the number"),
        ("ms3d", [ms3d], {"ratios": (4,)}, r"network\.pt: chooses 5 points; expected a network trained to choose 10$"),
        ("ms3d", [], {}, "ms3d: expected a network"),
        ("ms3d", [ms3d], {"priors": None}, "ms3d: local feature sizes are needed"),
        ("ms3d", [ms3d], {"priors": tmp_path / "priors.npz"}, r"priors\.npz: belongs to other clouds"),
        ("ms3d", [ms3d], {"priors": tmp_path / "absent.npz"}, r"absent\.npz: expected a file of local feature sizes"),
        ("lfs", [], {"lfs": None}, "lfs: expected local feature sizes and settings"),
        ("lfs", [], {"priors": None}, "lfs: expected local feature sizes and settings"),
    ]
    for sampler, networks, others, message in cases:
        with pytest.raises(InputError, match=message):
            choose(files, sampler, tmp_path / "samples", networks, **others)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["first", "priors.npz"]


def test_a_folder_without_choices_is_refused(tmp_path):
    with pytest.raises(InputError, match="absent: holds no chosen points"):
        read_choices(tmp_path / "absent")
    write_choice(Choice(np.zeros((1, 1, 1), np.int32), np.ones((1, 1), np.int32)), tmp_path / "mine.npz")
    with pytest.raises(InputError, match=r"mine\.npz: expected a name such as 8_0_drawn\.npz"):
        read_choices(tmp_path)
