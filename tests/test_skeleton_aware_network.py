from dataclasses import replace

import pytest
import torch
from tiny_skeleton_aware import TINY_SKELETON

from morphoskel.errors import InputError
from morphoskel.networks.pointnet2 import farthest_points
from morphoskel.networks.seed_neighbourhoods import seed_neighbourhoods
from morphoskel.networks.skeleton_aware_network import (
    SkeletonAwareNetwork,
    cloud_neighbourhoods,
    load_skeleton_aware,
    predict_skeleton,
    save_skeleton_aware,
)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture
def network():
    with torch.random.fork_rng():
        torch.manual_seed(0)
        return SkeletonAwareNetwork(TINY_SKELETON)


@pytest.fixture(scope="module")
def points():
    return torch.rand(3, 40, 3, generator=torch.Generator().manual_seed(0)) - 0.5


@pytest.fixture(scope="module")
def neighbourhoods(points):
    return cloud_neighbourhoods(points, TINY_SKELETON)


def naive_weights(network, points, neighbourhoods):
    """Run the layers on every pair of a seed and a neighbour, with the position and features put side by side."""
    features = network.features(points)
    rows = torch.stack(
        [
            torch.cat([points[cloud, index] - points[cloud, row[0]], features[cloud, index]])
            for cloud in range(len(points))
            for row in neighbourhoods[cloud].tolist()
            for index in row
        ]
    )
    for linear, normalise in zip(network.weights.linear, network.weights.normalise, strict=True):
        rows = normalise(linear(rows)).clamp(min=0)
    return rows.view(*neighbourhoods.shape, -1).amax(dim=2)


@pytest.mark.parametrize("training", [True, False])
def test_the_weights_are_those_of_the_naive_layers(network, points, neighbourhoods, training):
    """Also their gradients: that the first layer is applied before points are gathered changes nothing."""
    network.train(training)
    weights = network(points, neighbourhoods).weights
    naive = naive_weights(network, points, neighbourhoods)
    torch.testing.assert_close(weights, naive, rtol=1e-4, atol=1e-5)
    parameters = list(network.parameters())
    for fast, slow in zip(
        *(torch.autograd.grad(part.square().sum(), parameters) for part in (weights, naive)), strict=True
    ):
        torch.testing.assert_close(fast, slow, rtol=1e-3, atol=1e-4)


def test_balls_are_sums_over_the_neighbourhood(network, points, neighbourhoods):
    balls = network(points, neighbourhoods)
    assert (balls.weights >= 0).all()
    for cloud in range(3):
        for seed in range(6):
            around, weights = points[cloud, neighbourhoods[cloud, seed]], balls.weights[cloud, seed]
            centre = sum(weight * point for weight, point in zip(weights, around, strict=True))
            radius = sum(weight * (point - centre).norm() for weight, point in zip(weights, around, strict=True))
            torch.testing.assert_close(balls.centres[cloud, seed], centre)
            torch.testing.assert_close(balls.radii[cloud, seed], radius)


def test_a_smaller_initial_scale_starts_with_smaller_weights(points, neighbourhoods):
    sums = []
    for scale in (1.0, 0.1):
        torch.manual_seed(0)
        network = SkeletonAwareNetwork(replace(TINY_SKELETON, initial_scale=scale))
        sums.append(network(points, neighbourhoods).weights.detach().sum(dim=-1).mean())
    assert float(sums[0]) > 1.5
    assert float(sums[1] / sums[0]) == pytest.approx(0.1, rel=1e-3)


def test_neighbourhoods_are_around_the_farthest_points(points, neighbourhoods):
    assert neighbourhoods.shape == (3, 6, 9)
    assert neighbourhoods.dtype == torch.int32
    seeds = farthest_points(points, 6)
    assert torch.equal(neighbourhoods[:, :, 0].long(), seeds)
    single = seed_neighbourhoods(points[1].numpy(), seeds[1].numpy(), 9, "delaunay", 2)
    assert neighbourhoods[1].tolist() == single.tolist()
    nearest = cloud_neighbourhoods(points, replace(TINY_SKELETON, neighbourhood="nearest"))
    assert nearest[1].tolist() == seed_neighbourhoods(points[1].numpy(), seeds[1].numpy(), 9, "nearest", 2).tolist()
    with pytest.raises(InputError, match="40 points a cloud are too few for 41 skeletal points"):
        cloud_neighbourhoods(points, replace(TINY_SKELETON, skeletal_points=41))


def test_prediction_goes_batch_by_batch_without_training(network, points, neighbourhoods):
    before = {name: value.clone() for name, value in network.state_dict().items()}
    centres, radii = predict_skeleton(network, points)
    assert network.training
    assert all(torch.equal(before[name], value) for name, value in network.state_dict().items())
    assert not centres.requires_grad
    whole = network.eval()(points, neighbourhoods)
    torch.testing.assert_close(centres, whole.centres.detach())
    torch.testing.assert_close(radii, whole.radii.detach())


@torch.no_grad()
def test_a_network_survives_its_file(network, points, neighbourhoods, tmp_path):
    network(points, neighbourhoods)  # moves the running statistics away from where they start
    save_skeleton_aware(network, tmp_path / "network.pt")
    loaded = load_skeleton_aware(tmp_path / "network.pt")
    assert (loaded.settings, loaded.training) == (TINY_SKELETON, False)
    assert torch.equal(loaded(points, neighbourhoods).centres, network.eval()(points, neighbourhoods).centres)


def test_a_file_that_is_no_network_is_refused(network, tmp_path):
    with pytest.raises(InputError, match="no trained skeleton-aware skeleton network there"):
        load_skeleton_aware(tmp_path / "none.pt")
    (tmp_path / "noise.pt").write_bytes(b"noise")
    settings, weights = TINY_SKELETON.as_mapping(), network.state_dict()
    torch.save({"settings": settings | {"neighbours": 10}, "weights": weights}, tmp_path / "size.pt")
    torch.save({"settings": settings | {"hops": 0}, "weights": weights}, tmp_path / "range.pt")
    torch.save({"weights": weights}, tmp_path / "other.pt")
    for name in ("noise.pt", "size.pt", "range.pt", "other.pt"):
        with pytest.raises(InputError, match="not a skeleton-aware skeleton network of this version"):
            load_skeleton_aware(tmp_path / name)
