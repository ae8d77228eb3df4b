"""Bridges: the moving ends of branches, along which they grow (Huang et al., SIGGRAPH 2013).

Every function treats the end of a branch; the start is treated by turning the branch round.
"""

from __future__ import annotations

import numpy as np

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.l1_medial.branches import Branch, angle_between
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings


def follow(branch: Branch, samples: Samples, settings: L1MedialSettings) -> None:
    """Make the nearest moving sample ahead of a branch its bridge.

    A bridge that has become a sample of another branch, which grew past it, stays as the joint of the two.

    Parameters
    ----------
    branch
        Changed in place.
    samples
        The samples.
    settings
        Farthest and largest angle.
    """
    if not branch.open_end or len(branch.nodes) <= 3:
        return
    if samples.states[branch.nodes[-1]] == FIXED:
        branch.open_end = False
        return
    last, heading = _last_and_heading(branch, samples)
    moving = samples.indices(MOVING)
    offsets = samples.points[moving] - last
    distances = np.linalg.norm(offsets, axis=1)
    lengths = distances * np.linalg.norm(heading)
    allowed = (distances > settings.duplicate_distance) & (distances < settings.follow_distance)
    allowed &= offsets @ heading > np.cos(np.radians(settings.follow_angle)) * lengths
    if allowed.any():
        branch.nodes[-1] = int(moving[np.argmin(np.where(allowed, distances, np.inf))])


def grow(branch: Branch, samples: Samples, bridges: set[int], settings: L1MedialSettings) -> None:
    """Lengthen a branch past its bridge while the samples there form a line.

    Parameters
    ----------
    branch
        Changed in place.
    samples
        Changed in place: what is added is fixed, what is the same as the bridge is removed.
    bridges
        Samples that are bridges, which are never removed.
    settings
        Longest step, least directionality and largest turn.
    """
    while branch.open_end and len(branch.nodes) >= 3 and samples.states[branch.nodes[-1]] == MOVING:
        before, last, bridge = (samples.points[node] for node in branch.nodes[-3:])
        live = samples.indices(MOVING, FIXED)
        offsets = samples.points[live] - bridge
        distances = np.linalg.norm(offsets, axis=1)
        close = distances < settings.duplicate_distance
        for sample in live[close & (samples.states[live] == MOVING)].tolist():
            if sample not in bridges and sample not in branch.nodes:
                samples.states[sample] = REMOVED
        ahead = ~close & (distances < settings.growth_distance) & (offsets @ (bridge - last) >= 0)
        if not ahead.any():
            return
        following = int(live[np.argmin(np.where(ahead, distances, np.inf))])
        turns = (
            angle_between(last - before, bridge - last),
            angle_between(bridge - last, samples.points[following] - bridge),
        )
        forms_a_line = max(turns) < settings.turn_angle
        if not forms_a_line or samples.directionality[following] < settings.growth_directionality:
            return
        if samples.states[following] == FIXED or following in branch.nodes:
            return
        samples.states[branch.nodes[-1]] = FIXED
        branch.nodes.append(following)


def join_body(branch: Branch, others: list[Branch], samples: Samples, settings: L1MedialSettings) -> None:
    """End a branch on the nearest sample of another branch that its bridge has come close to.

    Parameters
    ----------
    branch
        Changed in place.
    others
        All branches; the branch itself is left out.
    samples
        The samples.
    settings
        Distance at which they merge.
    """
    if not branch.open_end or len(branch.nodes) <= 3 or _bridge_angle(branch, samples) >= settings.bridge_angle:
        return
    last, heading = _last_and_heading(branch, samples)
    bodies = sorted({node for other in others if other is not branch for node in other.nodes} - set(branch.nodes))
    bodies = [node for node in bodies if samples.states[node] == FIXED]
    if not bodies:
        return
    distances = np.linalg.norm(samples.points[bodies] - samples.points[branch.nodes[-1]], axis=1)
    ahead = (samples.points[bodies] - last) @ heading > 0
    distances = np.where(ahead, distances, np.inf)
    if distances.min() < settings.merge_distance:
        branch.nodes[-1] = bodies[int(np.argmin(distances))]
        branch.open_end = False


def drop_lost_bridge(branch: Branch, samples: Samples, settings: L1MedialSettings) -> None:
    """End a branch at its last fixed sample if its bridge has moved astray or there is nothing left to follow.

    Of a branch whose two bridges meet, the one at the larger angle is dropped.

    Parameters
    ----------
    branch
        Changed in place.
    samples
        The samples.
    settings
        Largest angle and farthest distances.
    """
    if not branch.open_end or len(branch.nodes) <= 3:
        return
    last, heading = _last_and_heading(branch, samples)
    bridge = samples.points[branch.nodes[-1]]
    angle = _bridge_angle(branch, samples)
    astray = angle > settings.bridge_angle and float(np.linalg.norm(bridge - last)) > settings.merge_distance
    offsets = samples.points[samples.indices(MOVING)] - last
    ahead = (offsets @ heading >= 0) & (np.linalg.norm(offsets, axis=1) <= settings.follow_distance)
    if branch.open_start and np.linalg.norm(samples.points[branch.nodes[0]] - bridge) < settings.merge_distance:
        branch.reverse()
        astray = astray or _bridge_angle(branch, samples) <= angle
        branch.reverse()
    if astray or not ahead.any():
        branch.nodes.pop()
        branch.open_end = False


def _last_and_heading(branch: Branch, samples: Samples) -> tuple[FloatArray, FloatArray]:
    """Return the last fixed sample before a bridge, and the step that leads to it."""
    last = samples.points[branch.nodes[-2]]
    return last, last - samples.points[branch.nodes[-3]]


def _bridge_angle(branch: Branch, samples: Samples) -> float:
    last, heading = _last_and_heading(branch, samples)
    return angle_between(heading, samples.points[branch.nodes[-1]] - last)
