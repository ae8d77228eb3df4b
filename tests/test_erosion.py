import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.morphology import dilation, erosion


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 120), st.integers(1, 30))
def test_lies_below_the_identity_and_is_dual_to_dilation(seed, count, k):
    generator = np.random.default_rng(seed)
    points, values = generator.random((count, 3), dtype=np.float32), generator.normal(size=count).astype(np.float32)
    eroded = erosion(points, values, k)
    assert (eroded <= values).all()
    assert np.array_equal(eroded, -dilation(points, -values, k))
    assert eroded.min() == values.min()
