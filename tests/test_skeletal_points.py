import pytest
import torch
from scipy.optimize import linprog

from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.networks.skeletal_points import SkeletalPointNetwork, combine_radii, nearest_distances, nearest_indices


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def settings():
    return Point2SkeletonSettings(
        points=80,
        skeletal_points=12,
        centroids=(40, 20),
        radii=((0.3, 0.6), (0.8,)),
        neighbours=((4, 8), (8,)),
        channels=((8, 8), (16, 16)),
        head_channels=(16,),
        initial_sharpness=3.0,
        valid_neighbours=4,
    )


@pytest.fixture(scope="module")
def skeletal(settings):
    torch.manual_seed(0)
    with torch.no_grad():
        return SkeletalPointNetwork(settings)(torch.rand(3, 80, 3) * 2 - 1)


def test_the_weights_of_a_skeletal_point_are_a_distribution(skeletal):
    assert skeletal.weights.shape == (3, 12, 20)
    assert (skeletal.weights >= 0).all()
    torch.testing.assert_close(skeletal.weights.sum(dim=-1), torch.ones(3, 12))
    assert skeletal.features.shape == (3, 12, 16)


def test_skeletal_points_lie_in_the_convex_hull_of_the_samples(skeletal):
    """Whether a point is a convex combination is decided by a linear program that knows nothing of the weights."""

    def inside(point, corners):
        equations = torch.cat([corners.T, torch.ones(1, len(corners))]).double().numpy()
        target = torch.cat([point, torch.ones(1)]).double().numpy()
        return linprog([0] * len(corners), A_eq=equations, b_eq=target).success

    for centres, samples in zip(skeletal.centres, skeletal.samples, strict=True):
        assert all(inside(centre, samples) for centre in centres)
        assert not inside(samples.amax(dim=0) + 0.1, samples)


def test_radii_combine_the_distances_to_the_nearest_skeletal_points(skeletal):
    for b in range(3):
        for k in range(12):
            radius = sum(
                skeletal.weights[b, k, m] * min((skeletal.samples[b, m] - c).norm() for c in skeletal.centres[b])
                for m in range(20)
            )
            assert float(skeletal.radii[b, k]) == pytest.approx(float(radius), rel=1e-4)


def test_a_sharper_start_spreads_the_skeletal_points(settings):
    spread = []
    for sharpness in (1.0, 8.0):
        torch.manual_seed(0)
        network = SkeletalPointNetwork(
            Point2SkeletonSettings(**settings.as_mapping() | {"initial_sharpness": sharpness})
        )
        centres = network(torch.rand(2, 80, 3) * 2 - 1).centres.detach()
        spread.append(float(centres.std(dim=1).mean()))
    assert spread[1] > 2 * spread[0]


def test_nearest_targets():
    points, targets = torch.rand(2, 9, 3, dtype=torch.float64), torch.rand(2, 5, 3, dtype=torch.float64)
    distances = (points[:, :, None] - targets[:, None]).norm(dim=-1)
    torch.testing.assert_close(nearest_distances(points, targets), distances.amin(dim=-1))
    torch.testing.assert_close(nearest_indices(points, targets), distances.argmin(dim=-1))
    assert torch.autograd.gradcheck(nearest_distances, (points.requires_grad_(), targets.requires_grad_()))


def test_the_gradient_of_a_distance_of_zero_is_zero():
    points = torch.rand(1, 4, 3, requires_grad=True)
    nearest_distances(points, points.detach().clone()).sum().backward()
    assert torch.equal(points.grad, torch.zeros(1, 4, 3))


def test_equal_distances_combine_to_the_same_radius():
    weights = torch.rand(2, 6, 10).softmax(dim=-1)
    torch.testing.assert_close(combine_radii(weights, torch.full((2, 10), 0.3)), torch.full((2, 6), 0.3))
