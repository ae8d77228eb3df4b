import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.sampling.random_points import random_points


def test_indices_are_distinct_and_within_the_cloud():
    for seed in range(20):
        chosen = random_points(30, 20, np.random.default_rng(seed))
        assert chosen.dtype == np.int64
        assert len({*chosen.tolist()}) == 20
        assert set(chosen.tolist()) <= set(range(30))
    assert sorted(random_points(30, 30, np.random.default_rng(0))) == list(range(30))


def test_a_smaller_choice_begins_a_larger_one():
    large = random_points(100, 50, np.random.default_rng(3))
    assert random_points(100, 20, np.random.default_rng(3)).tolist() == large[:20].tolist()
    assert random_points(100, 50, np.random.default_rng(4)).tolist() != large.tolist()


def test_every_point_and_every_pair_is_equally_likely():
    generator = np.random.default_rng(5)
    draws, available, count = 6000, 6, 2
    pairs = np.zeros((available, available))
    for _ in range(draws):
        pairs[tuple(random_points(available, count, generator))] += 1
    expected = draws / (available * (available - 1))
    off_diagonal = pairs[~np.eye(available, dtype=bool)]
    assert np.diag(pairs).sum() == 0
    assert ((off_diagonal - expected) ** 2 / expected).sum() < 58  # chi-square, 29 degrees of freedom, p = 0.001


@pytest.mark.parametrize("count", [0, 5])
def test_a_count_out_of_range_is_refused(count):
    with pytest.raises(InputError, match=f"expected 1 to 4, the number of points, got {count}"):
        random_points(4, count, np.random.default_rng(0))
