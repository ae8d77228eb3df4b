from dataclasses import replace

import numpy as np
import pytest
import torch
from scipy.spatial.distance import cdist
from tiny_clouds import seeded, select, tiny_clouds, tiny_priors
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.errors import ConfigError, InputError
from morphoskel.networks.point_generator import PointGenerator
from morphoskel.networks.skeleton_sampler import SkeletonSampler
from morphoskel.sampling import choose_points as choosing
from morphoskel.sampling.choose_points import Request, choose_points
from morphoskel.sampling.lfs import LfsSettings, lfs_points
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.sampler_weights import sampler_weights

CLOUDS = tiny_clouds(shapes=6)
FAILED = 2
PRIORS = tiny_priors(CLOUDS, failed=(FAILED,))
WEIGHTS = sampler_weights("ms3d", CLOUDS, PRIORS, PriorSettings(bins=6, sharpness=1.0), 0)
LFS = LfsSettings(exponent=1.0, floor=0.1)
M = 10


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


GENERATOR = seeded(PointGenerator, M, TINY)
NETWORK = seeded(SkeletonSampler, M, TINY_SAMPLER)
with torch.no_grad():
    NETWORK.linear.weight *= 1000  # the weights of an untrained network hardly favour any point

EVERY_KIND = {"random": {"drawn"}, "fps": {"fixed"}, "lfs": {"fixed"}, "samplenet": {"fixed"},
              "ms3d": {"drawn", "argmax", "completed"}}  # fmt: skip


def choose(sampler, positions=range(6), draws=3, seed=5, number=0, samples=M):
    positions = list(positions)
    more = {"lfs": {"sizes": PRIORS.distances[positions], "lfs": LFS}, "samplenet": {"network": GENERATOR},
            "ms3d": {"network": NETWORK, "weights": WEIGHTS[positions]}}  # fmt: skip
    request = Request(sampler, samples, draws, seed, number)
    return choose_points(request, select(CLOUDS, positions), progress=False, **more.get(sampler, {}))


def farthest_naive(cloud, chosen, count):
    """Add the point that is farthest from all chosen ones, again and again."""
    chosen = list(chosen)
    cloud = cloud.astype(np.float64)
    while len(chosen) < count:
        chosen.append(int(cdist(cloud, cloud[chosen]).min(axis=1).argmax()))
    return chosen


@pytest.mark.parametrize("sampler", EVERY_KIND)
def test_every_sampler_fills_its_kinds_of_choices(sampler):
    chosen = choose(sampler)
    assert set(chosen) == EVERY_KIND[sampler]
    known = [number for number in range(6) if sampler not in ("lfs", "ms3d") or number != FAILED]
    for kind, choice in chosen.items():
        draws = 3 if kind in ("drawn", "completed") else 1
        assert choice.indices.shape == (draws, 6, M)
        assert choice.distinct.shape == (draws, 6)
        assert choice.indices.dtype == choice.distinct.dtype == np.int32
        assert choice.indices[:, known].min() >= 0
        assert choice.indices.max() < 40
        if sampler != "samplenet":
            naive = [[len({*row.tolist()} - {-1}) for row in rows] for rows in choice.indices]
            assert choice.distinct.tolist() == naive


@pytest.mark.parametrize("sampler", EVERY_KIND)
def test_other_shapes_and_their_order_do_not_change_a_choice(sampler, monkeypatch):
    whole = choose(sampler)
    monkeypatch.setattr(choosing, "BATCH_SIZE", 2)
    for order in ([3], [5, 2, 0, 1]):
        for kind, choice in choose(sampler, order).items():
            assert np.array_equal(choice.indices, whole[kind].indices[:, order])
            assert np.array_equal(choice.distinct, whole[kind].distinct[:, order])


@pytest.mark.parametrize(("sampler", "kind"), [("random", "drawn"), ("ms3d", "drawn"), ("ms3d", "completed")])
def test_noise_depends_on_seed_id_and_draw(sampler, kind):
    first = choose(sampler)[kind].indices
    assert np.array_equal(choose(sampler)[kind].indices, first)
    assert np.array_equal(choose(sampler, draws=5)[kind].indices[:3], first)  # more draws leave the first alone
    assert not np.array_equal(first[0], first[1])
    assert not np.array_equal(choose(sampler, seed=6)[kind].indices, first)
    renamed = replace(CLOUDS, ids=np.array([f"t{number}" for number in range(6)]))
    more = {} if sampler == "random" else {"network": NETWORK, "weights": WEIGHTS}
    other = choose_points(Request(sampler, M, 3, 5), renamed, progress=False, **more)[kind].indices
    assert not np.array_equal(other[:, 0], first[:, 0])


def test_the_number_of_the_training_changes_the_noise_but_not_the_most_probable_points():
    first, second = choose("ms3d"), choose("ms3d", number=1)
    assert not np.array_equal(first["drawn"].indices, second["drawn"].indices)
    assert np.array_equal(first["argmax"].indices, second["argmax"].indices)


def test_random_points_are_equally_likely_and_distinct():
    indices = choose("random", draws=400)["drawn"].indices
    assert all(len({*row}) == M for row in indices.reshape(-1, M).tolist())
    expected = 400 * M / 40
    for shape in range(6):
        counts = np.bincount(indices[:, shape].ravel(), minlength=40)
        assert ((counts - expected) ** 2 / expected).sum() < 80  # chi square of 39 degrees: 80 is beyond 1 in 10000


def test_farthest_points_start_with_the_first():
    for cloud, row in zip(CLOUDS.points, choose("fps")["fixed"].indices[0], strict=True):
        assert row.tolist() == farthest_naive(cloud, [0], M)


def test_lfs_uses_the_sizes_of_each_shape():
    choice = choose("lfs")["fixed"]
    for number in range(6):
        if number == FAILED:
            continue
        cloud, sizes = CLOUDS.points[number].astype(np.float64), PRIORS.distances[number].astype(np.float64)
        assert choice.indices[0, number].tolist() == lfs_points(cloud, sizes, M, LFS).tolist()


def test_generated_points_are_matched_and_completed():
    choice = choose("samplenet")["fixed"]
    with torch.no_grad():
        generated = GENERATOR(torch.from_numpy(CLOUDS.points)).double().numpy()
    for number, cloud in enumerate(CLOUDS.points):
        nearest = dict.fromkeys(cdist(generated[number], cloud.astype(np.float64)).argmin(axis=1).tolist())
        assert choice.distinct[0, number] == len(nearest)  # before the completion
        assert choice.indices[0, number].tolist() == farthest_naive(cloud, nearest, M)
    assert choice.distinct.min() < M


@pytest.fixture(scope="module")
def logits():
    with torch.no_grad():
        return NETWORK(torch.from_numpy(CLOUDS.points), torch.from_numpy(WEIGHTS)).numpy()


def test_the_argmax_takes_the_most_probable_point_of_each_output(logits):
    indices = choose("ms3d")["argmax"].indices[0]
    for number in range(6):
        if number != FAILED:
            assert indices[number].tolist() == [int(row.argmax()) for row in logits[number]]


def test_points_are_drawn_with_the_probabilities_of_the_network(logits):
    draws = 1500
    indices = choose("ms3d", positions=[0], draws=draws)["drawn"].indices[:, 0]
    probabilities = np.exp(logits[0] - logits[0].max(axis=1, keepdims=True))
    probabilities /= probabilities.sum(axis=1, keepdims=True)
    assert probabilities.max() > 3 / 40  # far from equal
    for output in range(M):
        shares = np.bincount(indices[:, output], minlength=40) / draws
        deviation = np.sqrt(probabilities[output] * (1 - probabilities[output]) / draws)
        assert (np.abs(shares - probabilities[output]) < 5 * deviation + 1 / draws).all()


def test_a_completed_draw_is_the_draw_without_repetitions_and_with_farthest_points():
    chosen = choose("ms3d")
    assert chosen["drawn"].distinct[:, 0].min() < M  # something to complete
    for drawn, completed in zip(chosen["drawn"].indices, chosen["completed"].indices, strict=True):
        for number in range(6):
            if number != FAILED:
                start = dict.fromkeys(drawn[number].tolist())
                assert completed[number].tolist() == farthest_naive(CLOUDS.points[number], start, M)


@pytest.mark.parametrize("sampler", ["lfs", "ms3d"])
def test_nothing_is_chosen_of_a_shape_without_a_skeleton(sampler):
    for choice in choose(sampler).values():
        assert (choice.indices[:, FAILED] == -1).all()
        assert (choice.distinct[:, FAILED] == 0).all()
    for choice in choose(sampler, [FAILED]).values():  # also where no shape of a batch has one
        assert (choice.indices == -1).all()


def test_all_points_can_be_chosen():
    for sampler, kind in (("random", "drawn"), ("fps", "fixed"), ("lfs", "fixed")):
        rows = choose(sampler, [0, 1], samples=40)[kind].indices
        assert all(sorted(row) == list(range(40)) for row in rows.reshape(-1, 40).tolist())


@pytest.mark.parametrize(
    ("sampler", "samples", "given", "message"),
    [
        ("fps", 41, {}, "samples: 41 of 40 points cannot be chosen"),
        ("lfs", M, {}, "lfs: expected local feature sizes and settings"),
        ("lfs", M, {"sizes": PRIORS.distances}, "lfs: expected local feature sizes and settings"),
        ("snet", M, {}, "snet: expected a network trained to choose 10 points"),
        ("snet", 9, {"network": GENERATOR}, "snet: expected a network trained to choose 9 points"),
        ("snet", M, {"network": NETWORK}, "a network that generates points, got a skeleton-aware sampler"),
        ("dpc", M, {"network": NETWORK}, "dpc: expected the weights of its prior"),
        ("dpc", M, {"network": GENERATOR, "weights": WEIGHTS}, "got a network that generates points"),
    ],
)
def test_what_does_not_fit_is_refused(sampler, samples, given, message):
    with pytest.raises(InputError, match=message):
        choose_points(Request(sampler, samples, 1, 0), CLOUDS, progress=False, **given)


def test_an_unknown_sampler_is_refused():
    with pytest.raises(ConfigError, match="did you mean 'fps'"):
        choose_points(Request("fpss", M, 1, 0), CLOUDS, progress=False)
