"""Where the ends of branches meet: junctions of three and more, and joints of two."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.l1_medial.branches import Branch, angle_between
from morphoskel.skeleton.l1_medial.samples import FIXED, REMOVED, Samples
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings

SHORT = 1.1
"""Branches whose own ends are no farther apart than this times the merge distance form no groups."""

End = tuple[int, bool]
"""An end of a branch: the number of the branch, and whether it is its end rather than its start."""


def merge_ends(branches: list[Branch], samples: Samples, settings: L1MedialSettings, *, join: bool) -> None:
    """Merge the ends of branches that are close to each other.

    Three and more become a junction at their mean. Two are joined to one branch if they lead into each other, or
    become a common end if they coincide.

    Parameters
    ----------
    branches
        Changed in place.
    samples
        Changed in place: ends are moved and fixed.
    settings
        Merge distance and join angle.
    join
        Whether ends are merged in pairs, too. The released program does so only at the end of a stage.
    """
    while any(_merge_group(group, branches, samples, settings, join) for group in _groups(branches, samples, settings)):
        pass


def _groups(branches: list[Branch], samples: Samples, settings: L1MedialSettings) -> list[list[End]]:
    """Return, for each end, the ends close to it, itself included: of each branch only the closer one."""
    if len(branches) < 2:
        return []
    ends = samples.points[np.array([(branch.nodes[0], branch.nodes[-1]) for branch in branches])]
    long = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1) > SHORT * settings.merge_distance
    groups = []
    for number, side in np.ndindex(ends.shape[:2]):
        if long[number]:
            distances = np.linalg.norm(ends - ends[number, side], axis=2)
            members = np.flatnonzero(distances.min(axis=1) < settings.merge_distance)
            groups.append([(int(member), bool(np.argmin(distances[member]))) for member in members])
    return [group for group in groups if len(group) > 1]


def _merge_group(
    group: list[End], branches: list[Branch], samples: Samples, settings: L1MedialSettings, join: bool
) -> bool:
    """Merge a group of ends if it can be; return whether anything has changed."""
    nodes = {_node(branches[number], at_end) for number, at_end in group}
    is_open = any(_is_open(branches[number], at_end) for number, at_end in group)
    if len(group) > 2:
        if len(nodes) > 1 or is_open:
            _unify(nodes, samples.points[[_node(branches[number], side) for number, side in group]], branches, samples)
            return True
        return False
    if not join:
        return False
    (first, first_side), (second, second_side) = group
    if _joint_angle(branches, group, samples) > settings.join_angle:
        _join(branches, first, first_side, second, second_side)
        samples.states[branches[min(first, second)].fixed_nodes] = FIXED
        return True
    positions = samples.points[sorted(nodes)]
    coincide = np.linalg.norm(positions[0] - positions[-1]) < settings.duplicate_distance
    if coincide and (len(nodes) > 1 or is_open):
        _unify(nodes, positions, branches, samples)
        return True
    return False


def _unify(nodes: set[int], positions: FloatArray, branches: list[Branch], samples: Samples) -> None:
    """Replace some samples by one in the middle, in all branches; it is fixed."""
    kept = min(nodes)
    samples.points[kept] = positions.mean(axis=0)
    samples.states[sorted(nodes)] = REMOVED
    samples.states[kept] = FIXED
    for branch in branches:
        branch.open_start &= branch.nodes[0] not in nodes
        branch.open_end &= branch.nodes[-1] not in nodes
        branch.nodes = _without_repeats([kept if node in nodes else node for node in branch.nodes])
    branches[:] = [branch for branch in branches if len(branch.nodes) > 1]


def _join(branches: list[Branch], first: int, first_side: bool, second: int, second_side: bool) -> None:
    """Make one branch of two; it takes the place of the first."""
    if not first_side:
        branches[first].reverse()
    if second_side:
        branches[second].reverse()
    head, tail = branches[first], branches[second]
    branches[min(first, second)] = Branch(_without_repeats([*head.nodes, *tail.nodes]), head.open_start, tail.open_end)
    del branches[max(first, second)]


def _joint_angle(branches: list[Branch], group: list[End], samples: Samples) -> float:
    """Return the largest angle between headings out of two ends; 180 if they lead straight into each other.

    A bridge has two headings, its own and that of the branch up to it.
    """
    first, second = (_headings_out(branches[number], at_end, samples) for number, at_end in group)
    return max(angle_between(one, other) for one in first for other in second)


def _headings_out(branch: Branch, at_end: bool, samples: Samples) -> list[FloatArray]:
    nodes = branch.nodes if at_end else branch.nodes[::-1]
    steps = [samples.points[node] - samples.points[before] for before, node in pairwise(nodes[-3:])]
    return steps if _is_open(branch, at_end) else steps[-1:]


def _node(branch: Branch, at_end: bool) -> int:
    return branch.nodes[-1] if at_end else branch.nodes[0]


def _is_open(branch: Branch, at_end: bool) -> bool:
    return branch.open_end if at_end else branch.open_start


def _without_repeats(nodes: list[int]) -> list[int]:
    return nodes[:1] + [node for before, node in pairwise(nodes) if node != before]
