import numpy as np
import pytest

from morphoskel.skeleton.dpc import DeepPointsSettings
from morphoskel.skeleton.dpc.meso_skeleton import axis_strengths, form_meso_skeleton


def iterate_naively(samples, inner, h, settings):
    moved = np.empty_like(inner)
    links = samples - inner
    lengths = np.linalg.norm(links, axis=1, keepdims=True)
    links = np.where(lengths > 0, links / np.where(lengths > 0, lengths, 1), 0)
    for i, centre in enumerate(inner):
        differences = inner - centre
        distances = np.linalg.norm(differences, axis=1)
        near = distances <= h
        weights = np.exp(-4 * distances[near] ** 2 / h**2)
        average = weights @ inner[near] / weights.sum()
        axes = np.linalg.eigh((differences[near].T * weights) @ differences[near])[1]
        strengths = axis_strengths(np.abs(links[near] @ axes).mean(axis=0)[None], settings.contrast)[0]
        if near.sum() - 1 < 4:
            axes, strengths = np.eye(3), np.full(3, 1 / 3)
        along = -differences @ axes
        boxed = (np.abs(along) < h * (settings.box + settings.box_growth * strengths)).all(axis=1)
        boxed[i] = False
        scales = strengths if settings.repulsion_distance == "ellipsoid" else np.ones(3)
        damping = np.exp(-4 * ((along[boxed] / scales) ** 2).sum(axis=1) / h**2)
        weights = damping / np.maximum(distances[boxed], 1e-3 * h) ** settings.repulsion_power
        push = weights @ along[boxed] / weights.sum() if weights.sum() > 0 else np.zeros(3)
        strong = strengths > settings.least_strength
        moved[i] = average + axes @ (settings.repulsion * np.where(strong, strengths * push, 0))
    return moved


@pytest.mark.parametrize("repulsion_distance", ["euclidean", "ellipsoid"])
def test_matches_the_naive_twin(repulsion_distance):
    rng = np.random.default_rng(6)
    inner = rng.random((120, 3)) * [1.0, 3.0, 0.3]
    inner[:3] += 50.0  # too few neighbours for axes
    samples = inner + rng.normal(size=(120, 3))
    samples[7] = inner[7]  # a link without direction
    settings = DeepPointsSettings(repulsion_distance=repulsion_distance, iterations=1)
    np.testing.assert_allclose(
        form_meso_skeleton(samples, inner, 0.1, settings), iterate_naively(samples, inner, 0.5, settings), atol=1e-9
    )


def test_strengths_of_a_sheet_and_of_a_curve():
    settings = DeepPointsSettings()
    sheet = axis_strengths(np.array([[0.0, 0.0, 1.0]]), settings.contrast)[0]
    curve = axis_strengths(np.array([[0.0, 2 / np.pi, 2 / np.pi]]), settings.contrast)[0]
    none = axis_strengths(np.zeros((1, 3)), settings.contrast)[0]
    np.testing.assert_allclose(sheet, [0.5, 0.5, 0.0])
    assert curve[0] > 0.98
    np.testing.assert_allclose(none, 1 / 3)


def test_a_thick_curve_contracts_across_and_spreads_along():
    rng = np.random.default_rng(7)
    angles = rng.uniform(0, 2 * np.pi, 600)
    around = np.column_stack([np.zeros(600), np.cos(angles), np.sin(angles)])
    along = np.column_stack([rng.uniform(0, 20, 600), np.zeros(600), np.zeros(600)])
    inner, samples = along + around * rng.uniform(0, 0.4, (600, 1)), along + 3.0 * around
    settings = DeepPointsSettings()
    spread = form_meso_skeleton(samples, inner, 0.3, settings)
    pulled = form_meso_skeleton(samples, inner, 0.3, DeepPointsSettings(repulsion=0.0))
    distances = [np.median(np.hypot(points[:, 1], points[:, 2])) for points in (inner, spread)]
    assert distances[1] < 0.3 * distances[0]
    gaps = [np.quantile(np.diff(np.sort(points[:, 0])), 0.1) for points in (pulled, spread)]
    assert gaps[1] > gaps[0]


def test_order_does_not_matter_and_a_far_point_stays():
    rng = np.random.default_rng(8)
    samples, inner = rng.random((100, 3)), 0.3 * rng.random((100, 3))
    inner[5] = [9.0, 9.0, 9.0]
    settings = DeepPointsSettings()
    expected = form_meso_skeleton(samples, inner, 0.05, settings)
    order = rng.permutation(100)
    np.testing.assert_allclose(
        form_meso_skeleton(samples[order], inner[order], 0.05, settings), expected[order], atol=1e-9
    )
    np.testing.assert_array_equal(expected[5], inner[5])
