import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from morphoskel.seeds import derive_generator, derive_seed


@given(st.integers(0, 2**64), st.lists(st.text(max_size=5), max_size=3), st.integers(1, 256))
def test_seeds_repeat_and_stay_in_range(seed, names, bits):
    value = derive_seed(seed, *names, bits=bits)
    assert value == derive_seed(seed, *names, bits=bits)
    assert 1 <= value <= 2**bits


def test_seeds_tell_shape_stage_and_global_seed_apart():
    seeds = [derive_seed(seed, shape, stage) for seed in (0, 1) for shape in "ab" for stage in ("udf", "dilation")]
    assert len(set(seeds)) == len(seeds)
    assert derive_seed(0, "ab", "c") != derive_seed(0, "a", "bc")


def test_a_seed_is_the_same_on_every_machine():
    assert derive_seed(20250325, "chair-test-0000", "occupancy") == 7571827990660171669


def test_generators_repeat():
    draws = [derive_generator(3, "shape", "stage").random(4) for _ in range(2)]
    assert np.array_equal(*draws)
