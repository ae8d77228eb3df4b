import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.skeleton.l1_medial.directionality import (
    directionality,
    nearest_samples,
    update_smoothed_directionality,
)
from morphoskel.skeleton.l1_medial.samples import FIXED, REMOVED, Samples


def test_a_line_a_disc_and_a_ball():
    scatters = np.stack([np.diag([0, 2.0, 0]), np.diag([1.0, 0, 1]), np.eye(3), np.zeros((3, 3))])
    np.testing.assert_allclose(directionality(scatters), [1, 1 / 2, 1 / 3, 0.5])


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 40), st.integers(1, 12))
def test_nearest_samples_equal_the_naive_twin(seed, size, count):
    points = np.random.default_rng(seed).random((size, 3))
    found = nearest_samples(points, count)
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    for sample in range(size):
        others = [other for other in np.argsort(distances[sample]) if other != sample]
        assert found[sample].tolist() == others[:count]


def test_a_sample_is_never_its_own_neighbour_though_others_are_at_its_place():
    found = nearest_samples(np.zeros((9, 3)), 4)
    assert found.shape == (9, 4)
    assert (found != np.arange(9)[:, None]).all()


def smoothed_naive(samples, count):
    live = [i for i in range(len(samples.points)) if samples.states[i] != REMOVED]
    nearest, raw = {}, {}
    for i in live:
        others = sorted((np.linalg.norm(samples.points[i] - samples.points[j]), j) for j in live if j != i)
        nearest[i] = [j for _, j in others[:count]]
        offsets = [samples.points[j] - samples.points[i] for j in nearest[i] if samples.states[j] != FIXED]
        eigenvalues = np.linalg.eigvalsh(sum(np.outer(o, o) for o in offsets)) if len(offsets) >= 3 else None
        raw[i] = 0.95 if eigenvalues is None else eigenvalues[-1] / eigenvalues.sum()
    return {i: np.mean([raw[i]] + [raw[j] for j in nearest[i]]) for i in live}


def test_smoothed_directionality_equals_the_naive_twin():
    samples = Samples(np.random.default_rng(0).random((60, 3)))
    samples.states[:25], samples.states[25:30] = FIXED, REMOVED
    expected = smoothed_naive(samples, 6)
    update_smoothed_directionality(samples, 6)
    np.testing.assert_allclose(samples.directionality[list(expected)], list(expected.values()))
    assert (samples.directionality[25:30] == 0.5).all()


@pytest.mark.parametrize("count", [1, 4])
def test_too_few_samples_tell_nothing(count):
    samples = Samples(np.random.default_rng(0).random((count, 3)))
    samples.directionality[:] = 1
    update_smoothed_directionality(samples, 6)
    assert (samples.directionality == 0.5).all()
