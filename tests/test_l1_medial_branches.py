import numpy as np
import pytest

from morphoskel.skeleton.l1_medial import L1MedialSettings
from morphoskel.skeleton.l1_medial.branches import Branch, BranchSearch, angle_between, bridges_of
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples


def line_of(count, step=0.06):
    samples = Samples(np.outer(np.arange(count), [step, 0, 0]))
    samples.directionality[:] = 0.95
    return samples


def test_traces_a_line_in_both_directions():
    samples = line_of(10)
    samples.directionality[4] = 0.99
    search = BranchSearch(samples, [], L1MedialSettings())
    assert search.seed() == 4
    branch = search.trace(4)
    assert branch.nodes in (list(range(10)), list(range(9, -1, -1)))
    assert not branch.open_start
    assert not branch.open_end


def test_what_is_no_candidate_becomes_a_bridge():
    samples = line_of(10)
    samples.directionality[[2, 7]] = 0.8
    branch = BranchSearch(samples, [], L1MedialSettings()).trace(5)
    assert sorted(branch.nodes) == [2, 3, 4, 5, 6, 7]
    assert branch.open_start
    assert branch.open_end
    assert sorted(branch.fixed_nodes) == [3, 4, 5, 6]
    assert bridges_of([branch]) == {2, 7}


@pytest.mark.parametrize(("turn", "length"), [(20, 10), (30, 7)])
def test_a_sharp_turn_ends_a_branch(turn, length):
    samples = line_of(10)
    samples.points[6:] = samples.points[5] + np.outer(
        np.arange(1, 5) * 0.06, [np.cos(np.radians(turn)), np.sin(np.radians(turn)), 0]
    )
    branch = BranchSearch(samples, [], L1MedialSettings(trace_neighbours=4)).trace(2)
    assert len(branch.nodes) == length
    assert (branch.open_start or branch.open_end) == (turn > 25)


def test_duplicates_on_the_way_are_removed():
    samples = line_of(10)
    samples.points[9] = samples.points[5] + [0, 0.001, 0]
    branch = BranchSearch(samples, [], L1MedialSettings()).trace(2)
    removed = np.flatnonzero(samples.states == REMOVED)
    assert len(removed) == 1
    assert removed[0] in (5, 9)
    assert len(branch.nodes) == 9


def test_a_branch_that_reaches_another_one_shares_its_sample_if_that_is_near():
    for gap, shared in ((0.12, True), (0.2, False)):
        samples = line_of(8)
        samples.points[7:, 0] = samples.points[6, 0] + gap
        samples.states[7] = FIXED
        branch = BranchSearch(samples, [], L1MedialSettings()).trace(3)
        assert (7 in branch.nodes) == shared
        assert not branch.open_start
        assert not branch.open_end


def test_a_ring_is_closed():
    angles = np.linspace(0, 2 * np.pi, 30, endpoint=False)
    samples = Samples(np.column_stack([np.cos(angles), np.sin(angles), 0 * angles]) * 0.3)
    samples.directionality[:] = 0.95
    branch = BranchSearch(samples, [], L1MedialSettings(trace_neighbours=4)).trace(0)
    assert branch.nodes[0] == branch.nodes[-1] == 0
    assert sorted(branch.nodes[1:]) == list(range(30))


def test_bridges_and_rejected_samples_are_no_seeds():
    samples = line_of(3)
    search = BranchSearch(samples, [Branch([5, 6, 0], False, True)], L1MedialSettings())
    assert search.seed() == 1
    search.reject([1])
    assert search.seed() == 2
    search.accept(Branch([2, 1], True, False))
    assert search.seed() is None
    samples.states[:] = MOVING
    assert search.trace(0) is None


def test_turning_round():
    branch = Branch([1, 2, 3], open_end=True)
    seen = [list(branch.nodes) for _ in branch.both_ways()]
    assert seen == [[1, 2, 3], [3, 2, 1]]
    assert branch == Branch([1, 2, 3], open_end=True)


def test_angles():
    assert angle_between(np.array([1.0, 0, 0]), np.array([0, 2.0, 0])) == pytest.approx(90)
    assert angle_between(np.array([1.0, 0, 0]), np.array([-3.0, 0, 0])) == pytest.approx(180)
    assert angle_between(np.zeros(3), np.ones(3)) == 0
