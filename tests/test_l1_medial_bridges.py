import numpy as np
import pytest

from morphoskel.skeleton.l1_medial import L1MedialSettings
from morphoskel.skeleton.l1_medial.branches import Branch
from morphoskel.skeleton.l1_medial.bridges import drop_lost_bridge, follow, grow, join_body
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples

SETTINGS = L1MedialSettings()


def branch_along_x(*others, bridge=(0.3, 0, 0)):
    """Samples 0 to 3 on the x axis, fixed, and 4, their bridge; then others, moving."""
    samples = Samples(np.array([[0.0, 0, 0], [0.1, 0, 0], [0.15, 0, 0], [0.2, 0, 0], bridge, *others]))
    samples.states[:4] = FIXED
    samples.directionality[:] = 0.95
    return Branch([0, 1, 2, 3, 4], open_end=True), samples


@pytest.mark.parametrize(
    ("other", "followed"),
    [
        ((0.25, 0.02, 0), True),
        ((0.205, 0, 0), False),  # the same as the last sample
        ((0.2, 0.05, 0), False),  # at 90 degrees
        ((0.2 + 0.05 * np.cos(np.radians(79)), 0.05 * np.sin(np.radians(79)), 0), True),
        ((0.35, 0, 0), False),  # farther than the bridge is
    ],
)
def test_the_nearest_sample_ahead_becomes_the_bridge(other, followed):
    branch, samples = branch_along_x(other)
    follow(branch, samples, SETTINGS)
    assert branch.nodes[-1] == (5 if followed else 4)


def test_a_bridge_out_of_reach_stays_if_there_is_no_other():
    branch, samples = branch_along_x(bridge=(0.6, 0, 0))
    follow(branch, samples, SETTINGS)
    assert branch.nodes[-1] == 4
    assert branch.open_end


def test_a_bridge_that_another_branch_took_is_a_joint():
    branch, samples = branch_along_x()
    samples.states[4] = FIXED
    follow(branch, samples, SETTINGS)
    assert branch == Branch([0, 1, 2, 3, 4])


def test_grows_along_a_line_up_to_its_last_sample():
    branch, samples = branch_along_x((0.4, 0, 0), (0.5, 0.01, 0), (0.7, 0, 0))
    grow(branch, samples, {4}, SETTINGS)
    assert branch.nodes == [0, 1, 2, 3, 4, 5, 6]
    assert branch.open_end
    assert samples.states.tolist() == [FIXED] * 6 + [MOVING] * 2


@pytest.mark.parametrize(
    ("other", "directionality", "state"),
    [
        ((0.4, 0.06, 0), 0.95, MOVING),  # a turn of 31 degrees
        ((0.4, 0, 0), 0.79, MOVING),
        ((0.46, 0, 0), 0.95, MOVING),  # too far
        ((0.4, 0, 0), 0.95, FIXED),  # on another branch
    ],
)
def test_does_not_grow(other, directionality, state):
    branch, samples = branch_along_x(other)
    samples.directionality[5], samples.states[5] = directionality, state
    grow(branch, samples, {4}, SETTINGS)
    assert branch.nodes == [0, 1, 2, 3, 4]


def test_what_is_the_same_as_the_bridge_is_removed_unless_it_is_one():
    branch, samples = branch_along_x((0.301, 0, 0), (0.302, 0, 0))
    grow(branch, samples, {4, 6}, SETTINGS)
    assert samples.states[5:].tolist() == [REMOVED, MOVING]


@pytest.mark.parametrize(("distance", "joined"), [(0.07, True), (0.09, False)])
def test_ends_on_the_body_of_another_branch(distance, joined):
    branch, samples = branch_along_x((0.3 + distance, -0.01, 0), (0.3 + distance, 0.2, 0))
    samples.states[5:] = FIXED
    join_body(branch, [branch, Branch([5, 6])], samples, SETTINGS)
    assert branch.nodes[-1] == (5 if joined else 4)
    assert branch.open_end != joined


def test_drops_a_bridge_that_is_lost():
    branch, samples = branch_along_x(bridge=(0.1, 0.2, 0))  # behind
    drop_lost_bridge(branch, samples, SETTINGS)
    assert branch == Branch([0, 1, 2, 3])
    branch, samples = branch_along_x(bridge=(0.6, 0, 0))  # out of reach, and nothing else to follow
    drop_lost_bridge(branch, samples, SETTINGS)
    assert branch == Branch([0, 1, 2, 3])
    branch, samples = branch_along_x((0.3, 0.1, 0), bridge=(0.6, 0, 0))
    drop_lost_bridge(branch, samples, SETTINGS)
    assert branch.open_end


def test_of_two_bridges_that_meet_the_one_at_the_larger_angle_is_dropped():
    points = [[0.0, 0.05, 0], [0, 0, 0], [0.1, 0, 0], [0.1, 0.1, 0], [0.02, 0.1, 0]]
    samples = Samples(np.array(points))
    samples.states[1:4] = FIXED
    branch = Branch([0, 1, 2, 3, 4], open_start=True, open_end=True)
    for _ in branch.both_ways():
        drop_lost_bridge(branch, samples, SETTINGS)
    assert branch.open_start != branch.open_end
