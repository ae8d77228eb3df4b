import math

import pytest
import torch

from morphoskel.errors import InputError
from morphoskel.networks.skeletal_points import nearest_indices
from morphoskel.networks.soft_projection import SoftProjection


@pytest.fixture
def clouds():
    generator = torch.Generator().manual_seed(0)
    return torch.randn(2, 30, 3, generator=generator), torch.randn(2, 8, 3, generator=generator)


def project_naively(points, query, neighbours, sigma):
    nearest = sorted(points.tolist(), key=lambda point: math.dist(point, query))[:neighbours]
    weights = [math.exp(-(math.dist(point, query) ** 2) / sigma) for point in nearest]
    return [sum(w * point[axis] for w, point in zip(weights, nearest, strict=True)) / sum(weights) for axis in range(3)]


@pytest.mark.parametrize(("neighbours", "temperature"), [(1, 1.0), (7, 1.0), (7, 0.3), (30, 2.0)])
def test_projection_agrees_with_its_definition(clouds, neighbours, temperature):
    points, generated = clouds
    projection = SoftProjection(neighbours, 0.0)
    assert float(projection.sigma().detach()) == 1
    torch.nn.init.constant_(projection.temperature, temperature)
    projected = projection(points, generated)
    expected = [
        [project_naively(points[row], query.tolist(), neighbours, temperature**2) for query in generated[row]]
        for row in range(2)
    ]
    torch.testing.assert_close(projected, torch.tensor(expected), rtol=1e-5, atol=1e-6)


def test_a_vanishing_temperature_gives_the_nearest_point(clouds):
    points, generated = clouds
    projection = SoftProjection(7, 0.0)
    torch.nn.init.constant_(projection.temperature, 0.01)
    nearest = torch.stack([points[row][nearest_indices(points=generated, targets=points)[row]] for row in range(2)])
    torch.testing.assert_close(projection(points, generated), nearest)


def test_an_infinite_temperature_gives_the_mean_of_the_neighbours(clouds):
    points, generated = clouds
    projection = SoftProjection(30, 0.0)
    torch.nn.init.constant_(projection.temperature, 1e4)
    torch.testing.assert_close(projection(points, generated), points.mean(dim=1, keepdim=True).expand(2, 8, 3))


def test_projections_are_convex_combinations(clouds):
    """Points on a plane project into the plane, and inside the square that the points span there."""
    points, generated = clouds
    flat = points.clamp(-1, 1) * torch.tensor([1.0, 1.0, 0.0])
    projected = SoftProjection(5, 0.0)(flat, 3 * generated)
    assert float(projected.detach()[..., 2].abs().max()) == 0
    assert float(projected.detach().abs().max()) <= 1 + 1e-6


def test_gradients_reach_the_generated_points_and_the_temperature(clouds):
    points, generated = clouds
    points, generated = points.double(), generated.double().requires_grad_()
    projection = SoftProjection(4, 0.0).double()
    assert torch.autograd.gradcheck(lambda queries, _: projection(points, queries), (generated, projection.temperature))


def test_sigma_stops_at_its_floor():
    projection = SoftProjection(4, 0.01)
    torch.nn.init.constant_(projection.temperature, 0.05)
    assert float(projection.sigma().detach()) == pytest.approx(0.01)
    torch.nn.init.constant_(projection.temperature, -0.5)
    assert float(projection.sigma().detach()) == 0.25


def test_a_cloud_with_too_few_points_is_refused(clouds):
    points, generated = clouds
    with pytest.raises(InputError, match="expected at least 31, the neighbours, got 30"):
        SoftProjection(31, 0.0)(points, generated)
