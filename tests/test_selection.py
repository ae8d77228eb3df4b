import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.skeleton import select_smallest_residues
from morphoskel.skeleton.selection import skeleton_of


def select_naive(residues, udf, count):
    order = sorted(range(len(residues)), key=lambda index: (residues[index], -udf[index], index))
    return order[:count]


@settings(max_examples=200)
@given(st.integers(0, 10_000), st.integers(0, 60), st.integers(1, 80))
def test_equals_the_naive_twin_also_among_ties(seed, size, count):
    generator = np.random.default_rng(seed)
    residues = generator.integers(0, 4, size).astype(np.float32) / 7
    udf = generator.integers(0, 3, size).astype(np.float32)
    assert select_smallest_residues(residues, udf, count).tolist() == select_naive(residues, udf, count)


def test_fewer_inner_points_than_wanted_are_all_kept():
    inner = np.arange(9, dtype=np.float32).reshape(3, 3)
    udf, dilated = np.array([1, 2, 3], dtype=np.float32), np.array([3, 2, 3], dtype=np.float32)
    skeleton = skeleton_of(inner, udf, dilated, 1024)
    assert len(skeleton) == 3
    assert skeleton.radii.tolist() == [3, 2, 1]
    assert skeleton.residues.tolist() == [0, 0, 2]
    assert np.array_equal(skeleton.points, inner[[2, 1, 0]])
