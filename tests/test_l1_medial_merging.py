import numpy as np
import pytest

from morphoskel.skeleton.l1_medial import L1MedialSettings
from morphoskel.skeleton.l1_medial.branches import Branch
from morphoskel.skeleton.l1_medial.merging import merge_ends
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples

SETTINGS = L1MedialSettings()


def spokes(angles, inner=0.03, count=4):
    """Branches that point away from the origin, each of `count` samples, the first of which is a bridge."""
    rays = np.column_stack([np.cos(np.radians(angles)), np.sin(np.radians(angles)), np.zeros(len(angles))])
    samples = Samples(np.concatenate([np.outer(inner + 0.1 * np.arange(count), ray) for ray in rays]))
    samples.states[:] = FIXED
    branches = [Branch(list(range(i * count, (i + 1) * count)), open_start=True) for i in range(len(angles))]
    samples.states[[branch.nodes[0] for branch in branches]] = MOVING
    return branches, samples


@pytest.mark.parametrize("join", [True, False])
def test_three_ends_become_a_junction_at_their_mean(join):
    branches, samples = spokes([0, 120, 240])
    merge_ends(branches, samples, SETTINGS, join=join)
    assert len(branches) == 3
    assert {branch.nodes[0] for branch in branches} == {0}
    assert not any(branch.open_start for branch in branches)
    np.testing.assert_allclose(samples.points[0], 0, atol=1e-12)
    assert samples.states[[0, 4, 8]].tolist() == [FIXED, REMOVED, REMOVED]


def test_ends_farther_apart_stay():
    branches, samples = spokes([0, 120, 240], inner=0.06)
    merge_ends(branches, samples, SETTINGS, join=True)
    assert [branch.nodes[0] for branch in branches] == [0, 4, 8]
    assert all(branch.open_start for branch in branches)


@pytest.mark.parametrize(("angle", "joined"), [(180, True), (150, True), (130, False)])
def test_two_ends_join_if_they_lead_into_each_other(angle, joined):
    branches, samples = spokes([0, angle])
    merge_ends(branches, samples, SETTINGS, join=True)
    if not joined:
        assert len(branches) == 2
        assert all(branch.open_start for branch in branches)
        return
    assert branches == [Branch([3, 2, 1, 0, 4, 5, 6, 7])]
    assert (samples.states == FIXED).all()


def test_two_ends_are_not_joined_in_the_middle_of_a_stage():
    branches, samples = spokes([0, 180])
    merge_ends(branches, samples, SETTINGS, join=False)
    assert len(branches) == 2


def test_the_outer_ends_of_joined_branches_stay_open():
    branches, samples = spokes([0, 180])
    for branch in branches:
        branch.open_end = True
    merge_ends(branches, samples, SETTINGS, join=True)
    assert branches == [Branch([3, 2, 1, 0, 4, 5, 6, 7], open_start=True, open_end=True)]


def test_two_ends_that_coincide_at_an_angle_are_closed():
    branches, samples = spokes([0, 90], inner=0.001)
    merge_ends(branches, samples, SETTINGS, join=True)
    assert [branch.nodes[0] for branch in branches] == [0, 0]
    assert not any(branch.open_start for branch in branches)


def test_a_branch_with_both_ends_in_a_group_takes_part_once():
    branches, samples = spokes([0, 120, 240])
    samples.points = np.vstack([samples.points, [[0, 0, 0.01], [0, 0.02, 0.03], [0, 0, 0.07]]])
    samples.states = np.append(samples.states, [FIXED] * 3)
    branches.append(Branch([12, 13, 14]))
    merge_ends(branches, samples, SETTINGS, join=True)
    assert [branch.nodes for branch in branches][-1] == [0, 13, 14]
    assert {branch.nodes[0] for branch in branches} == {0}
