import numpy as np
import pytest

from morphoskel.skeleton.l1_medial import L1MedialSettings
from morphoskel.skeleton.l1_medial.contraction import contract, density_weights, explained_by_branches, first_radius
from morphoskel.skeleton.l1_medial.directionality import directionality, update_smoothed_directionality
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples
from tests.tubes import CYLINDER, RADIUS, distance_to_axes, noisy_tubes


def gaussian(distance, radius):
    return np.exp(-4 * (distance / radius) ** 2) if distance < radius else 0.0


def contract_naive(samples, points, weights, radius, settings):
    """The fixed point iteration, sample by sample."""
    live = [i for i in range(len(samples.points)) if samples.states[i] != REMOVED]
    pushes, values = {}, {}
    for i in live:
        push, total, scatter, count = np.zeros(3), 0.0, np.zeros((3, 3)), 0
        for j in live:
            offset = samples.points[i] - samples.points[j]
            length = np.linalg.norm(offset)
            if i == j or length >= radius:
                continue
            weight = gaussian(length, radius) / max(length, 0.001 * radius) ** settings.repulsion_power
            push, total, count = push + weight * offset, total + weight, count + 1
            scatter += gaussian(length, radius) * np.outer(offset, offset)
        pushes[i] = push / total if total else push
        values[i] = directionality(scatter[None])[0] if count > 3 else 0.5
    low, high = min(values.values()), max(values.values())
    moved = samples.points.copy()
    for i in live:
        if samples.states[i] == FIXED:
            continue
        sums, total = np.zeros(3), 0.0
        for point, weight in zip(points, weights, strict=True):
            length = np.linalg.norm(samples.points[i] - point)
            alpha = weight * gaussian(length, radius)
            alpha *= max(length, 0.001 * radius) ** (settings.average_power - 2)
            sums, total = sums + alpha * point, total + alpha
        strength = 0.15 + (0.35 - 0.15) * (values[i] - low) / (high - low)
        moved[i] = (sums / total if total else samples.points[i]) + strength * pushes[i]
    return moved, [values.get(i, 0.5) for i in range(len(moved))]


@pytest.mark.parametrize("powers", [(2, 1), (1, 2), (1.5, 0.5)])
@pytest.mark.parametrize("radius", [0.3, 0.6, 2.0])
def test_equals_the_naive_twin(powers, radius):
    generator = np.random.default_rng(0)
    points, samples = generator.random((80, 3)), Samples(generator.random((30, 3)))
    samples.points[3] = points[5]  # distance 0, which the powers divide by
    samples.states[:8], samples.states[8:12] = FIXED, REMOVED
    weights = generator.random(80)
    settings = L1MedialSettings(average_power=powers[0], repulsion_power=powers[1])
    expected, values = contract_naive(samples, points, weights, radius, settings)
    before = samples.points.copy()
    moved = contract(samples, points, weights, radius, settings)
    np.testing.assert_allclose(samples.points, expected, atol=1e-7)
    np.testing.assert_allclose(samples.directionality, values, atol=1e-7)
    assert moved == pytest.approx(np.linalg.norm(expected - before, axis=1)[samples.states == MOVING].mean())


def test_samples_contract_to_the_axis_of_a_tube_and_form_a_line():
    points = noisy_tubes(CYLINDER, 1500, 0).points
    samples = Samples(points[::3].copy())
    for _ in range(55):
        contract(samples, points, np.ones(len(points)), 0.35, L1MedialSettings())
    update_smoothed_directionality(samples, 6)
    assert (samples.directionality > 0.9).mean() > 0.9
    assert distance_to_axes(samples.points, CYLINDER).mean() < 0.15 * RADIUS


def test_a_lonely_sample_and_none_at_all_stay():
    samples = Samples(np.zeros((1, 3)))
    assert contract(samples, np.ones((5, 3)), np.ones(5), 0.1, L1MedialSettings()) == 0
    assert np.array_equal(samples.points, np.zeros((1, 3)))
    samples.states[0] = FIXED
    assert contract(samples, np.zeros((5, 3)), np.ones(5), 0.1, L1MedialSettings()) == 0


def test_equal_directionalities_take_the_least_repulsion():
    samples = Samples(np.array([[0.0, 0, 0], [0.5, 0, 0]]))
    contract(samples, np.array([[9.0, 9, 9]]), np.ones(1), 1.0, L1MedialSettings())
    np.testing.assert_allclose(samples.points[:, 0], [-0.15 * 0.5, 0.5 + 0.15 * 0.5])


def test_first_radius():
    box = np.array([[0.0, 0, 0], [3, 0, 0], [0, 4, 0], [0, 0, 12], *[[1.0, 1, 1]] * 4])
    assert first_radius(box) == pytest.approx(13 / 2)
    assert first_radius(box, 2.0) == pytest.approx(13)
    flat = np.array([[0.0, 0, 7], [3, 0, 7], [0, 4, 7], [1, 1, 7]])
    assert first_radius(flat) == pytest.approx(2 * 5 / 2)


def test_dense_places_weigh_less():
    points = np.random.default_rng(0).random((40, 3))
    expected = [1 / sum(gaussian(np.linalg.norm(a - b), 0.4) for b in points) for a in points]
    np.testing.assert_allclose(density_weights(points, 0.4), expected, rtol=1e-7)
    assert density_weights(np.array([[0.0, 0, 0], [5, 0, 0]]), 1.0).tolist() == [1, 1]
    assert density_weights(np.zeros((4, 3)), 1.0).tolist() == [0.25] * 4


def test_points_near_a_branch_are_explained():
    points = np.array([[0.0, 0, 0], [0.4, 0, 0], [0.6, 0, 0]])
    samples = Samples(np.zeros((2, 3)))
    assert not explained_by_branches(points, samples, 1.0).any()
    samples.states[1] = FIXED
    assert explained_by_branches(points, samples, 1.0).tolist() == [True, True, False]
