import dataclasses

import numpy as np
import pytest
from tiny_clouds import select, tiny_clouds, tiny_priors

from morphoskel.errors import InputError
from morphoskel.sampling.prior import PriorSettings, prior_weights
from morphoskel.sampling.sampler_weights import sampler_weights

CLOUDS = tiny_clouds(shapes=5)
PRIORS = tiny_priors(CLOUDS, failed=(2,))
SETTINGS = PriorSettings(bins=6, sharpness=1.0)


def weigh(sampler, positions=range(5), priors=PRIORS, seed=3, settings=SETTINGS):
    positions = list(positions)
    chosen = select(priors, positions) if priors else None
    return sampler_weights(sampler, select(CLOUDS, positions), chosen, settings, seed)


@pytest.mark.parametrize("sampler", ["skeleton_aware", "ms3d", "dpc", "l1_medial"])
def test_the_weights_of_each_shape_are_those_of_its_distances(sampler):
    weights = weigh(sampler)
    assert weights.dtype == np.float32
    assert np.isnan(weights[2]).all()
    for number in (0, 1, 3, 4):
        np.testing.assert_allclose(weights[number], prior_weights(PRIORS.distances[number], SETTINGS), rtol=1e-6)
        order = np.argsort(PRIORS.distances[number])
        assert (np.diff(weights[number][order]) <= 0).all()  # the nearer to the skeleton, the heavier


def test_a_shape_that_failed_has_no_weights_even_if_it_has_distances():
    leftover = dataclasses.replace(PRIORS, distances=tiny_priors(CLOUDS).distances)
    assert np.isnan(weigh("ms3d", priors=leftover)[2]).all()


def test_equal_weights_need_no_skeleton():
    weights = weigh("uniform", priors=None)
    assert weights.shape == (5, 40)
    assert np.array_equal(weights, np.full((5, 40), np.float32(1 / 6)))
    assert np.array_equal(weigh("uniform"), weights)  # also of a shape without one
    # Without sharpness all bins weigh the same: the prior says nothing.
    np.testing.assert_allclose(weights[0], weigh("ms3d", settings=PriorSettings(bins=6, sharpness=0.0))[0], rtol=1e-6)


def test_shuffled_weights_are_those_of_ms3d_in_another_order():
    weights, shuffled = weigh("ms3d"), weigh("shuffled")
    assert np.isnan(shuffled[2]).all()
    for number in (0, 1, 3, 4):
        assert np.array_equal(np.sort(shuffled[number]), np.sort(weights[number]))
        assert not np.array_equal(shuffled[number], weights[number])


def test_weights_are_shuffled_by_seed_and_id_alone():
    shuffled = weigh("shuffled")
    assert np.array_equal(weigh("shuffled"), shuffled, equal_nan=True)
    order = [4, 2, 0]
    assert np.array_equal(weigh("shuffled", order), shuffled[order], equal_nan=True)
    assert not np.array_equal(weigh("shuffled", seed=4)[0], shuffled[0])
    twins = dataclasses.replace(PRIORS, distances=np.tile(PRIORS.distances[:1], (5, 1)))
    first, second = weigh("shuffled", priors=twins)[:2]
    assert not np.array_equal(first, second)  # the same distances under two ids


def test_a_prior_needs_local_feature_sizes():
    for sampler in ("ms3d", "shuffled", "skeleton_aware"):
        with pytest.raises(InputError, match=f"{sampler}: local feature sizes are needed"):
            weigh(sampler, priors=None)
