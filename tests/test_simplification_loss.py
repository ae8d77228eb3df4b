import math

import pytest
import torch

from morphoskel.learning.simplification_loss import simplification_loss


def loss_naively(points, generated, gamma, delta):
    total = 0.0
    for cloud, simplified in zip(points.tolist(), generated.tolist(), strict=True):
        to_cloud = [min(math.dist(g, p) ** 2 for p in cloud) for g in simplified]
        from_cloud = [min(math.dist(g, p) ** 2 for g in simplified) for p in cloud]
        total += sum(to_cloud) / len(to_cloud) + max(to_cloud)
        total += (gamma + delta * len(simplified)) * sum(from_cloud) / len(from_cloud)
    return total / len(points)


@pytest.fixture
def clouds():
    generator = torch.Generator().manual_seed(0)
    points = torch.randn(3, 25, 3, generator=generator, dtype=torch.float64)
    return points, torch.randn(3, 6, 3, generator=generator, dtype=torch.float64)


@pytest.mark.parametrize(("gamma", "delta"), [(1.0, 0.0), (0.5, 1 / 30), (0.0, 0.0)])
def test_the_loss_agrees_with_its_definition(clouds, gamma, delta):
    loss = simplification_loss(*clouds, gamma=gamma, delta=delta)
    assert float(loss) == pytest.approx(loss_naively(*clouds, gamma, delta), rel=1e-12)


def test_the_same_points_in_another_order_have_no_loss(clouds):
    points, _ = clouds
    assert float(simplification_loss(points, points.flip(1), gamma=1.0, delta=0.0)) == 0


def test_a_known_case():
    """Points at 0 and 2, generated ones at 0 and 3: 0 and 1 to the cloud, 0 and 1 from it."""
    points = torch.tensor([[[0.0, 0, 0], [2, 0, 0]]])
    generated = torch.tensor([[[0.0, 0, 0], [3, 0, 0]]])
    assert float(simplification_loss(points, generated, gamma=1.0, delta=0.25)) == 0.5 + 1 + 1.5 * 0.5


def test_the_gradient_is_that_of_the_definition(clouds):
    points, generated = clouds
    generated.requires_grad_()
    assert torch.autograd.gradcheck(lambda g: simplification_loss(points, g, gamma=1.0, delta=0.1), (generated,))
