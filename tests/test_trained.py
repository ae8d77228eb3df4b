import numpy as np
import pytest
import torch
from scipy.spatial.distance import cdist
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER, TINY_SKELETON

from morphoskel.errors import InputError
from morphoskel.networks.point_generator import PointGenerator, save_generator
from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork, predict_skeleton, save_skeleton_aware
from morphoskel.networks.skeleton_sampler import SkeletonSampler, save_skeleton_sampler
from morphoskel.sampling.trained import choose_trained, load_skeleton_network, load_trained, skeletonize_trained


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def seeded(network, *arguments):
    with torch.random.fork_rng():
        torch.manual_seed(0)
        return network(*arguments).eval()


POINTS = np.random.default_rng(0).uniform(-0.5, 0.5, (60, 3)).astype(np.float32)
WEIGHTS = np.random.default_rng(1).uniform(0.1, 0.3, 60)


def completed_naive(first_choices, count):
    """Drop repetitions, then add the point that is farthest from all chosen ones."""
    chosen = list(dict.fromkeys(first_choices))
    while len(chosen) < count:
        gaps = cdist(POINTS.astype(np.float64), POINTS[chosen].astype(np.float64)).min(axis=1)
        chosen.append(int(gaps.argmax()))
    return chosen


@torch.no_grad()
def test_generated_points_are_replaced_by_the_nearest_and_completed():
    network = seeded(PointGenerator, 12, TINY)
    chosen = choose_trained(network, POINTS, None)
    generated = network(torch.from_numpy(POINTS)[None])[0].numpy()
    nearest = cdist(generated.astype(np.float64), POINTS.astype(np.float64)).argmin(axis=1).tolist()
    assert chosen.indices.tolist() == completed_naive(nearest, 12)
    assert chosen.matched == len({*nearest})


@torch.no_grad()
def test_the_most_probable_points_are_taken_and_completed():
    network = seeded(SkeletonSampler, 12, TINY_SAMPLER)
    chosen = choose_trained(network, POINTS, WEIGHTS)
    logits = network(torch.from_numpy(POINTS)[None], torch.tensor(WEIGHTS, dtype=torch.float32)[None])[0]
    best = [int(row.argmax()) for row in logits]
    assert chosen.indices.tolist() == completed_naive(best, 12)
    assert chosen.matched == len({*best})


def test_noise_draws_points_that_the_seed_fixes():
    network = seeded(SkeletonSampler, 12, TINY_SAMPLER)

    def draw(seed):
        return choose_trained(network, POINTS, WEIGHTS, torch.Generator().manual_seed(seed)).indices.tolist()

    assert draw(1) == draw(1) != draw(2)
    assert draw(1) != choose_trained(network, POINTS, WEIGHTS).indices.tolist()
    drawn = [draw(seed) for seed in range(200)]
    assert all(len({*indices}) == 12 for indices in drawn)
    assert len({index for indices in drawn for index in indices}) > 50  # of 60: the untrained network favours few


def test_a_network_needs_as_many_points_as_it_chooses():
    network = seeded(PointGenerator, 61, TINY)
    with pytest.raises(InputError, match="has 60 points, the network chooses 61"):
        choose_trained(network, POINTS, None)


def test_files_of_the_right_kind_are_read(tmp_path):
    save_generator(seeded(PointGenerator, 12, TINY), tmp_path / "generator.pt")
    save_skeleton_sampler(seeded(SkeletonSampler, 7, TINY_SAMPLER), tmp_path / "sampler.pt")
    save_skeleton_aware(seeded(SkeletonAwareNetwork, TINY_SKELETON), tmp_path / "skeleton.pt")
    assert load_trained("samplenet", tmp_path / "generator.pt").samples == 12
    assert load_trained("dpc", tmp_path / "sampler.pt").samples == 7
    assert not load_skeleton_network(tmp_path / "skeleton.pt").training
    for load, wrong in [
        (lambda path: load_trained("snet", path), "sampler.pt"),
        (lambda path: load_trained("ms3d", path), "generator.pt"),
        (load_skeleton_network, "sampler.pt"),
        (lambda path: load_trained("ms3d", path), "absent.pt"),
    ]:
        with pytest.raises(InputError, match=wrong):
            load(tmp_path / wrong)


def test_a_predicted_skeleton_comes_back_in_the_unit_of_the_shape():
    network = seeded(SkeletonAwareNetwork, TINY_SKELETON)
    skeleton = skeletonize_trained(network, POINTS, np.array([10.0, -3.0, 2.0]), 5.0)
    centres, radii = predict_skeleton(network, torch.from_numpy(POINTS)[None])
    assert len(skeleton) == TINY_SKELETON.skeletal_points
    assert skeleton.points == pytest.approx(centres[0].double().numpy() * 5 + [10, -3, 2], rel=1e-6)
    assert skeleton.radii == pytest.approx(radii[0].double().numpy() * 5, rel=1e-6)
