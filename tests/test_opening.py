import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.morphology import dilation, erosion, opening


def random_function(seed, count):
    generator = np.random.default_rng(seed)
    return generator.random((count, 3), dtype=np.float32), generator.normal(size=count).astype(np.float32)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 150), st.integers(1, 30))
def test_is_anti_extensive_idempotent_and_increasing(seed, count, k):
    points, values = random_function(seed, count)
    opened = opening(points, values, k)
    assert (opened <= values).all()
    assert np.array_equal(opening(points, opened, k), opened)
    assert (opening(points, np.maximum(values, 0.3), k) >= opened).all()


def test_dilating_over_the_same_neighbourhoods_would_be_no_opening():
    """Guards the reason for the adjoint: the published way exceeds the function."""
    points, values = random_function(1, 1500)
    published = dilation(points, erosion(points, values))
    assert (published > values).mean() > 0.05


def test_cuts_off_a_peak_and_keeps_a_plateau():
    points, values = random_function(2, 2000)
    values = np.where(points[:, 0] > 0.5, np.float32(1), np.float32(0))
    peak = np.argmin(np.linalg.norm(points - 0.25, axis=1))
    values[peak] = 5
    opened = opening(points, values)
    assert opened[peak] == 0
    assert (opened[points[:, 0] > 0.8] == 1).all()
