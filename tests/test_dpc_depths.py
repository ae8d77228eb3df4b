import numpy as np
import pytest

from morphoskel.errors import ShapeError
from morphoskel.skeleton.dpc.depths import NEIGHBOURS, ROUNDS, complete_depths
from morphoskel.skeleton.dpc.sinking import Sinking


def complete_naively(samples, depths, stopped):
    depths, stopped = depths.copy(), stopped.copy()
    distances = np.linalg.norm(samples[:, None] - samples, axis=2)
    for _ in range(ROUNDS):
        before, known = depths.copy(), stopped.copy()
        for i in np.flatnonzero(~known):
            nearest = np.argsort(distances[i])[: NEIGHBOURS + 1]
            if known[nearest].any():
                depths[i], stopped[i] = before[nearest][known[nearest]].min(), True
    for i in np.flatnonzero(~stopped):
        known = np.flatnonzero(stopped)
        depths[i] = depths[known[np.argmin(distances[i, known])]]
    return depths


@pytest.mark.parametrize("share", [0.7, 0.05])
def test_matches_the_naive_twin(share):
    rng = np.random.default_rng(3)
    samples, depths, stopped = rng.random((200, 3)), rng.random(200), rng.random(200) < share
    completed = complete_depths(samples, Sinking(depths, stopped))
    np.testing.assert_array_equal(completed[stopped], depths[stopped])
    np.testing.assert_array_equal(completed, complete_naively(samples, depths, stopped))


def test_a_far_piece_takes_the_depth_of_the_nearest_known_sample():
    rng = np.random.default_rng(4)
    samples = np.vstack([rng.random((40, 3)), rng.random((40, 3)) + 100.0])
    stopped = np.arange(80) < 40
    depths = np.where(stopped, np.arange(80.0), 1e9)
    completed = complete_depths(samples, Sinking(depths, stopped))
    np.testing.assert_array_equal(completed, complete_naively(samples, depths, stopped))
    assert completed.max() == 39.0


def test_nothing_stopped():
    with pytest.raises(ShapeError, match="none of the 5 inner points met an opposite side"):
        complete_depths(np.random.default_rng(5).random((5, 3)), Sinking(np.ones(5), np.zeros(5, dtype=bool)))
