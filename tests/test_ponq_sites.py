import numpy as np
import pytest
import torch
from scipy.spatial import cKDTree
from solids import sphere_cloud

from morphoskel.errors import ShapeError
from morphoskel.surface.ponq.sites import chamfer_gradient, draw_sites, optimise_sites


def chamfer(sites, samples):
    squares = ((samples[:, None] - sites) ** 2).sum(axis=2)
    return squares.min(axis=1).mean() + squares.min(axis=0).mean()


def optimise_by_torch(sites, batches, learning_rate):
    moving = torch.tensor(sites, requires_grad=True)
    adam = torch.optim.Adam([moving], lr=learning_rate)
    for samples in batches:
        adam.zero_grad()
        squares = ((torch.tensor(samples)[:, None] - moving) ** 2).sum(dim=2)
        (squares.min(dim=1).values.mean() + squares.min(dim=0).values.mean()).backward()
        adam.step()
    return moving.detach().numpy()


def test_the_gradient_is_that_of_finite_differences():
    generator = np.random.default_rng(0)
    samples, sites = generator.normal(size=(60, 3)), generator.normal(size=(12, 3))
    expected, step = np.zeros_like(sites), 1e-6
    for index in np.ndindex(sites.shape):
        moved = np.zeros_like(sites)
        moved[index] = step
        expected[index] = (chamfer(sites + moved, samples) - chamfer(sites - moved, samples)) / (2 * step)
    assert np.allclose(chamfer_gradient(sites, samples, cKDTree(samples)), expected, atol=1e-7)


def test_the_optimiser_is_adam():
    points = sphere_cloud(200).points
    sites = draw_sites(points, 30, with_replacement=False, generator=np.random.default_rng(0))
    whole = optimise_sites(sites, points, steps=40, learning_rate=1e-3, batch=200, generator=np.random.default_rng(0))
    assert np.allclose(whole, optimise_by_torch(sites, [points] * 40, 1e-3), atol=1e-9)


def test_a_step_uses_a_batch_of_distinct_samples():
    points = sphere_cloud(200).points
    sites = draw_sites(points, 30, with_replacement=False, generator=np.random.default_rng(0))
    moved = optimise_sites(sites, points, steps=10, learning_rate=1e-3, batch=20, generator=np.random.default_rng(5))
    generator = np.random.default_rng(5)
    batches = [points[generator.choice(200, size=20, replace=False)] for _ in range(10)]
    assert np.allclose(moved, optimise_by_torch(sites, batches, 1e-3), atol=1e-9)


def test_sites_spread_over_the_cloud():
    points = sphere_cloud(2000).points
    sites = draw_sites(points, 500, with_replacement=False, generator=np.random.default_rng(3))
    before = sites.copy()
    moved = optimise_sites(sites, points, steps=200, learning_rate=1e-3, batch=2000, generator=np.random.default_rng(0))
    assert np.array_equal(sites, before)
    assert chamfer(moved, points) < 0.8 * chamfer(sites, points)
    assert np.abs(np.linalg.norm(moved, axis=1) - 1).max() < 0.05


def test_sites_are_drawn_among_the_points():
    points = np.arange(30.0).reshape(10, 3)
    distinct = draw_sites(points, 10, with_replacement=False, generator=np.random.default_rng(0))
    assert np.array_equal(np.sort(distinct, axis=0), points)
    repeated = draw_sites(points, 50, with_replacement=True, generator=np.random.default_rng(0))
    assert len(repeated) == 50
    assert set(repeated[:, 0]) <= set(points[:, 0])
    with pytest.raises(ShapeError, match="cannot draw 11 sites from 10 distinct points"):
        draw_sites(points, 11, with_replacement=False, generator=np.random.default_rng(0))
