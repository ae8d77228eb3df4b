import pytest
import torch

from benchmarks.naive_edge_convolution import NaiveEdgeFeatures
from morphoskel.errors import InputError
from morphoskel.networks.edge_features import EdgeFeatures

SIZES = {"channels": (8, 8, 16), "k": 6, "global_features": 24, "head": (20, 12)}


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def clouds(batch, points, seed=0):
    return torch.rand(batch, points, 3, generator=torch.Generator().manual_seed(seed), dtype=torch.float64) * 2 - 1


def networks():
    """Return the network and its naive twin in the same state, with scales of both signs, in double precision."""
    torch.manual_seed(0)
    naive, ours = NaiveEdgeFeatures(**SIZES).double(), EdgeFeatures(**SIZES).double()
    with torch.no_grad():
        for name, parameter in naive.named_parameters():
            if "normalise" in name:
                parameter.normal_()
    ours.load_state_dict(naive.state_dict())
    return ours, naive


@pytest.mark.parametrize("training", [True, False])
def test_features_and_gradients_equal_those_of_the_naive_network(training):
    """Double precision, so that both find the same neighbours."""
    results = []
    for network in networks():
        points = clouds(2, 50).requires_grad_()
        features = network.train(training)(points)
        features.square().sum().backward()
        gradients = {name: parameter.grad for name, parameter in network.named_parameters()}
        results.append((features.detach(), points.grad, gradients, network.state_dict()))
    torch.testing.assert_close(*results)
    assert results[0][0].shape == (2, 50, 12)


def test_features_move_with_their_points():
    network = EdgeFeatures(**SIZES).double().eval()
    points = clouds(2, 60)
    order = torch.randperm(60, generator=torch.Generator().manual_seed(1))
    torch.testing.assert_close(network(points[:, order]), network(points)[:, order])


def test_clouds_of_a_batch_do_not_see_each_other_in_use():
    network = EdgeFeatures(**SIZES).double().eval()
    points = clouds(3, 40)
    torch.testing.assert_close(network(points)[1:2], network(points[1:2]))


def test_two_runs_are_the_same_to_the_last_bit():
    runs = []
    for _ in range(2):
        torch.manual_seed(0)
        network = EdgeFeatures(**SIZES)
        features = network(clouds(2, 80).float())
        features.square().sum().backward()
        runs.append([features, *(parameter.grad for parameter in network.parameters())])
    assert all(torch.equal(a, b) for a, b in zip(*runs, strict=True))


def test_the_sizes_of_the_paper_are_the_defaults():
    network = EdgeFeatures(k=20, head=(512, 256))
    assert [tuple(layer.linear.weight.shape) for layer in network.edges] == [(64, 6), (64, 128), (128, 128), (256, 256)]
    assert [tuple(layer.weight.shape) for layer in network.head] == [(512, 1024), (256, 512)]
    assert network.cloud.weight.shape == (512, 512)


def test_clouds_of_fewer_points_than_neighbours_are_refused():
    with pytest.raises(InputError, match="k: expected 1 to 5"):
        EdgeFeatures(**SIZES)(clouds(2, 5).float())
