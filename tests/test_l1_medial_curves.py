from itertools import pairwise

import numpy as np
import pytest

from morphoskel.skeleton.l1_medial.branches import Branch
from morphoskel.skeleton.l1_medial.curves import chains_between_junctions, resample, smooth


def edges_of(chains):
    return sorted(tuple(sorted(edge)) for chain in chains for edge in pairwise(chain))


def test_a_branch_that_ends_on_another_cuts_it():
    chains = chains_between_junctions([Branch([0, 1, 2, 3, 4]), Branch([7, 6, 5, 2])])
    assert sorted(map(sorted, chains)) == [[0, 1, 2], [2, 3, 4], [2, 5, 6, 7]]


def test_branches_that_share_an_end_are_one_curve():
    assert chains_between_junctions([Branch([2, 1, 0]), Branch([2, 3])]) == [[0, 1, 2, 3]]


def test_rings_and_repeated_edges():
    assert chains_between_junctions([Branch([3, 1, 2, 3])]) == [[1, 2, 3, 1]]
    chains = chains_between_junctions([Branch([0, 1, 2, 3, 1]), Branch([1, 0])])
    assert sorted(map(len, chains)) == [2, 4]


def test_every_edge_is_in_one_chain():
    generator = np.random.default_rng(0)
    for _ in range(50):
        branches = [Branch(generator.integers(0, 12, 5).tolist()) for _ in range(3)]
        steps = [edge for branch in branches for edge in pairwise(branch.nodes)]
        expected = sorted({tuple(sorted(edge)) for edge in steps if edge[0] != edge[1]})
        assert edges_of(chains_between_junctions(branches)) == expected


def test_resampling_is_even_and_keeps_the_ends():
    curve = np.array([[0.0, 0, 0], [0.3, 0, 0], [0.3, 0.4, 0], [0.3, 0.4, 0.3]])
    points = resample(curve, 0.1)
    assert len(points) == 11
    assert np.array_equal(points[[0, -1]], curve[[0, -1]])
    np.testing.assert_allclose(np.linalg.norm(np.diff(points, axis=0), axis=1), 0.1)


def test_short_curves_and_rings_keep_enough_points():
    assert len(resample(np.array([[0.0, 0, 0], [0.01, 0, 0]]), 0.1)) == 2
    ring = np.array([[0.0, 0, 0], [0.01, 0, 0], [0, 0.01, 0], [0, 0, 0]])
    assert len(resample(ring, 0.1)) == 4


def test_smoothing_rounds_corners_and_leaves_the_rest():
    zigzag = np.array([[0.0, 0, 0], [1, 1, 0], [2, 0, 0], [3, 1, 0], [4, 0, 0]])
    smoothed = smooth(zigzag, 16)
    assert np.array_equal(smoothed[[0, -1]], zigzag[[0, -1]])
    assert (
        np.linalg.norm(np.diff(smoothed, axis=0), axis=1).sum() < np.linalg.norm(np.diff(zigzag, axis=0), axis=1).sum()
    )
    assert np.array_equal(smooth(zigzag, 100), zigzag)
    corner = smooth(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]), 89)[1]
    assert corner == pytest.approx([0.75, 0.25, 0])
