import numpy as np
import pytest
import torch

from morphoskel.errors import InputError
from morphoskel.networks.cloud_preparation import prepare_cloud
from morphoskel.shapes import PointCloud


@pytest.fixture
def points():
    return np.random.default_rng(0).uniform(-1, 1, (300, 3)) * (4, 1, 2) + (10, -20, 30)


def test_the_largest_extent_fills_the_unit_cube_and_back(points):
    prepared = prepare_cloud(points, 300)
    assert prepared.points.dtype == torch.float32
    low, high = prepared.points.amin(dim=0), prepared.points.amax(dim=0)
    torch.testing.assert_close(low, -high)
    assert float(high.max()) == pytest.approx(1)
    back = prepared.points.double().numpy() * prepared.scale + prepared.centre
    np.testing.assert_allclose(back, points, atol=1e-5)


def test_a_larger_cloud_is_covered_evenly_by_its_farthest_points(points):
    prepared = prepare_cloud(PointCloud(points), 40)
    all_points = prepare_cloud(points, 300).points
    assert prepared.points.shape == (40, 3)
    gaps = torch.cdist(all_points, prepared.points).amin(dim=1)
    spacing = torch.cdist(prepared.points, prepared.points).fill_diagonal_(torch.inf).amin()
    assert gaps.max() <= spacing  # true of farthest points: the last one was at least as far as any that is left
    torch.testing.assert_close(prepared.points[0], all_points[0])


def test_a_smaller_cloud_is_repeated(points):
    prepared = prepare_cloud(points[:7], 17)
    torch.testing.assert_close(prepared.points, prepare_cloud(points[:7], 7).points.repeat(3, 1)[:17])


def test_a_cloud_without_extent_is_refused():
    with pytest.raises(InputError, match="at least 4 distinct"):
        prepare_cloud(np.zeros((10, 3)), 10)
