import math

import pytest
import torch

from morphoskel.learning.augmentation import drop_points, jitter, rotate_about_y, scale_and_shift


@pytest.fixture(autouse=True)
def seeded():
    with torch.random.fork_rng():
        torch.manual_seed(0)
        yield


@pytest.fixture
def points():
    return torch.randn(6, 200, 3, generator=torch.Generator().manual_seed(1))


@pytest.mark.parametrize("style", ["overwrite", "remove"])
def test_nothing_is_dropped_if_the_share_is_zero(points, style):
    assert drop_points(points, 0, style) is points


def test_overwritten_points_become_the_first_and_the_others_stay(points):
    before = points.clone()
    dropped = drop_points(points, 0.875, "overwrite")
    changed = (dropped != points).any(dim=-1)
    assert dropped.shape == points.shape
    assert torch.equal(dropped[changed], points[:, :1].expand_as(points)[changed])
    assert torch.equal(points, before)
    shares = changed.float().mean(dim=1)
    assert len(shares.unique()) > 1  # a share of its own for each cloud
    many = torch.cat([(drop_points(points, 0.8, "overwrite") != points).any(-1).float().mean(1) for _ in range(200)])
    assert float(many.mean()) == pytest.approx(0.4, abs=0.03)
    assert float(many.std()) == pytest.approx(0.8 / math.sqrt(12), abs=0.03)
    assert many.max() < 0.9


def test_removed_points_are_gone_from_all_clouds(points):
    counts = []
    for _ in range(300):
        kept = drop_points(points, 0.8, "remove")
        counts.append(kept.shape[1])
    assert min(counts) >= 40
    assert max(counts) <= 200
    assert sum(counts) / len(counts) == pytest.approx(120, abs=8)
    rows = {tuple(row) for row in points[2].tolist()}
    assert len({tuple(row) for row in kept[2].tolist()} & rows) == kept.shape[1]
    assert drop_points(points[:, :1], 0.99, "remove").shape == (6, 1, 3)


def test_scales_and_shifts_stay_in_their_ranges():
    corners = torch.tensor([[0.0, 0, 0], [1, 1, 1]]).expand(500, 2, 3)
    changed = scale_and_shift(corners, 0.8, 1.25, 0.1)
    shift, factor = changed[:, 0], changed[:, 1] - changed[:, 0]
    torch.testing.assert_close(factor, factor[:, :1].expand(-1, 3))  # the same along all axes
    assert 0.8 <= factor.min() < 0.82
    assert 1.23 < factor.max() <= 1.25
    assert -0.1 <= shift.min() < -0.09
    assert 0.09 < shift.max() <= 0.1
    assert shift.mean(dim=0).abs().max() < 0.01
    torch.testing.assert_close(scale_and_shift(corners, 1, 1, 0), corners)


def test_rotations_keep_heights_and_distances(points):
    turned = rotate_about_y(points)
    assert torch.equal(turned[..., 1], points[..., 1])
    distances, expected = (torch.cdist(each.double(), each.double()) for each in (turned, points))
    torch.testing.assert_close(distances, expected, atol=1e-5, rtol=1e-5)
    angles = []
    for _ in range(100):
        moved = rotate_about_y(torch.tensor([[[1.0, 0, 0], [0, 0, 1]]]).expand(20, 2, 3))
        determinant = moved[:, 0, 0] * moved[:, 1, 2] - moved[:, 0, 2] * moved[:, 1, 0]
        torch.testing.assert_close(determinant, torch.ones(20))  # no reflection
        angles.append(torch.atan2(moved[:, 0, 2], moved[:, 0, 0]))
    counts = torch.histc(torch.cat(angles), 4, -math.pi, math.pi)
    assert counts.min() > 400


def test_the_noise_has_its_size_and_is_clipped(points):
    noise = jitter(points, 0.01, 0.02) - points
    assert noise.abs().max() == pytest.approx(0.02, abs=1e-6)
    assert float(noise.std()) == pytest.approx(0.01, rel=0.1)
    assert (noise[0] - noise[1]).abs().max() > 0
