import numpy as np
import pytest
import torch

from morphoskel.errors import InputError
from morphoskel.networks.feature_neighbour_kernels import select_smallest
from morphoskel.networks.feature_neighbours import nearest_by_sorting, nearest_in_features


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def features_of(batch, points, channels, seed=0, dtype=torch.float32):
    return torch.rand(batch, points, channels, generator=torch.Generator().manual_seed(seed), dtype=dtype) * 2 - 1


def nearest_naive(features, k):
    exact = features.double()
    squares = (exact[:, :, None] - exact[:, None]).square().sum(dim=-1)
    return squares.sort(dim=-1, stable=True).indices[..., :k]


def distances_to(features, neighbours):
    exact = features.double()
    others = torch.stack([cloud[rows] for cloud, rows in zip(exact, neighbours, strict=True)])
    return (others - exact[:, :, None]).norm(dim=-1)


@pytest.mark.parametrize(
    ("points", "channels", "k"), [(30, 3, 1), (30, 3, 30), (200, 64, 20), (333, 5, 40), (64, 1, 7)]
)
def test_neighbours_equal_the_definition(points, channels, k):
    features = features_of(2, points, channels, dtype=torch.float64)
    neighbours = nearest_in_features(features, k)
    assert neighbours.dtype == torch.int64
    torch.testing.assert_close(neighbours, nearest_naive(features, k))


@pytest.mark.parametrize("offset", [0.0, 100.0])
def test_single_precision_finds_neighbours_as_near_wherever_the_cloud_is(offset):
    features = features_of(2, 300, 16) + offset
    found = distances_to(features, nearest_in_features(features, 12))
    torch.testing.assert_close(found, distances_to(features, nearest_naive(features, 12)), atol=1e-3, rtol=0)


def test_the_kernel_and_the_tensor_library_find_the_same_neighbours():
    features = features_of(3, 150, 8, dtype=torch.float64)
    squares = features.square().sum(dim=-1)[:, None]
    torch.testing.assert_close(nearest_in_features(features, 10), nearest_by_sorting(features, squares, 10))


@pytest.mark.parametrize(("count", "k", "levels"), [(10, 4, 3), (64, 20, 2), (500, 20, 30), (500, 20, 1), (97, 90, 9)])
def test_of_equal_numbers_the_first_are_taken(count, k, levels):
    rows = np.random.default_rng(1).integers(0, levels, (20, count)).astype(np.float32)
    chosen = np.full((20, k), -1)
    assert select_smallest(rows, chosen, 0, 20)
    np.testing.assert_array_equal(chosen, np.argsort(rows, axis=1, kind="stable")[:, :k])


def test_duplicated_points_have_different_neighbours_at_distance_zero():
    features = features_of(2, 10, 3).repeat(1, 6, 1)
    neighbours = nearest_in_features(features, 6)
    assert all(len(set(row)) == 6 for row in neighbours.flatten(0, 1).tolist())
    assert distances_to(features, neighbours).max() == 0
    constant = nearest_in_features(torch.ones(1, 50, 4), 20)
    assert constant.tolist() == [[list(range(20))] * 50]


def test_a_point_is_its_own_nearest_neighbour():
    nearest = nearest_in_features(features_of(2, 100, 3), 5)[..., 0]
    torch.testing.assert_close(nearest, torch.arange(100).expand(2, -1))


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16])
def test_autocast_does_not_lower_the_precision_of_distances(dtype):
    features = features_of(1, 200, 16).to(dtype)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        lowered = nearest_in_features(features, 10)
    torch.testing.assert_close(lowered, nearest_in_features(features.float(), 10))


def test_neighbours_do_not_depend_on_the_number_of_threads():
    features = features_of(2, 300, 3)
    alone = nearest_in_features(features, 20)
    torch.set_num_threads(2)
    together = nearest_in_features(features, 20)
    torch.set_num_threads(1)
    assert torch.equal(alone, together)


@pytest.mark.parametrize("k", [0, 11])
def test_too_many_neighbours_are_refused(k):
    with pytest.raises(InputError, match=f"k: expected 1 to 10, the number of points of a cloud, got {k}"):
        nearest_in_features(features_of(1, 10, 3), k)


@pytest.mark.parametrize("number", [torch.nan, torch.inf])
def test_numbers_that_are_not_finite_are_refused(number):
    features = features_of(2, 300, 3)
    features[1, 7, 2] = number
    with pytest.raises(InputError, match="features: expected finite numbers"):
        nearest_in_features(features, 20)
