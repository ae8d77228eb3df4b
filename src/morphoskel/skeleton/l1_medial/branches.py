"""Branches: chains of samples, and how they are found (Huang et al., SIGGRAPH 2013)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.l1_medial.directionality import nearest_samples
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings


@dataclass
class Branch:
    """A chain of samples.

    Parameters
    ----------
    nodes
        Indices of samples, in order. They are fixed, except for a bridge at an open end.
    open_start, open_end
        Whether the chain ends in a bridge there: a sample that still moves, along which the branch may grow.
    """

    nodes: list[int]
    open_start: bool = False
    open_end: bool = False

    @property
    def fixed_nodes(self) -> list[int]:
        """All nodes but the bridges."""
        return self.nodes[self.open_start : len(self.nodes) - self.open_end]

    def reverse(self) -> None:
        """Turn the chain round."""
        self.nodes.reverse()
        self.open_start, self.open_end = self.open_end, self.open_start

    def both_ways(self) -> Iterator[None]:
        """Present the chain in both directions, so that what treats its end treats its start, too."""
        for _ in range(2):
            yield
            self.reverse()


def bridges_of(branches: Iterable[Branch]) -> set[int]:
    """Return the samples that are the bridge of a branch."""
    ends = {branch.nodes[-1] for branch in branches if branch.open_end}
    return ends | {branch.nodes[0] for branch in branches if branch.open_start}


def angle_between(first: FloatArray, second: FloatArray) -> float:
    """Return the angle between two vectors, degrees; 0 if one of them has no length."""
    lengths = float(np.linalg.norm(first) * np.linalg.norm(second))
    if lengths == 0:
        return 0.0
    return float(np.degrees(np.arccos(np.clip(first @ second / lengths, -1, 1))))


class BranchSearch:
    """Search for new branches among the samples of high directionality.

    Parameters
    ----------
    samples
        Changed in place.
    branches
        Known already; their bridges are no candidates.
    settings
        Thresholds.
    """

    def __init__(self, samples: Samples, branches: list[Branch], settings: L1MedialSettings) -> None:
        self.samples = samples
        self.settings = settings
        self.bridges = bridges_of(branches)
        self.candidates = (samples.states == MOVING) & (samples.directionality > settings.directionality)
        self.candidates[list(self.bridges)] = False
        live = samples.indices(MOVING, FIXED)
        nearest = live[nearest_samples(samples.points[live], settings.trace_neighbours)]
        self.neighbours: dict[int, list[int]] = dict(zip(live.tolist(), nearest.tolist(), strict=True))

    def seed(self) -> int | None:
        """Return the candidate of largest directionality, the first of equals, or ``None``."""
        left = np.flatnonzero(self.candidates & (self.samples.states == MOVING))
        if len(left) == 0:
            return None
        return int(left[np.argmax(self.samples.directionality[left])])

    def reject(self, nodes: list[int]) -> None:
        """Let samples be no candidates any more."""
        self.candidates[nodes] = False

    def accept(self, branch: Branch) -> None:
        """Let the bridges of a new branch be no candidates any more."""
        self.bridges |= bridges_of([branch])
        self.candidates[list(self.bridges)] = False

    def trace(self, seed: int) -> Branch | None:
        """Return the chain of candidates through one of them, in both directions, or ``None`` if it is alone.

        The heading at the start is towards the nearest candidate.
        """
        others = [other for other in self.neighbours[seed] if self._is_candidate(other)]
        if not others:
            return None
        heading = self.samples.points[others[0]] - self.samples.points[seed]
        forward, open_end = self._trace_one_way(seed, heading, {seed})
        if len(forward) > 1 and forward[-1] == seed:
            return Branch(forward)
        visited = set(forward)
        backward, open_start = self._trace_one_way(seed, -heading, visited)
        return Branch([*reversed(backward[1:]), *forward], open_start, open_end)

    def _trace_one_way(self, seed: int, heading: FloatArray, visited: set[int]) -> tuple[list[int], bool]:
        """Return the chain from a candidate on, and whether it ends in a bridge."""
        points, path = self.samples.points, [seed]
        visited = set(visited)
        while (following := self._next(path[-1], heading, visited)) is not None:
            step = points[following] - points[path[-1]]
            if following in visited:
                closes = following == seed and len(path) > 2
                return ([*path, seed] if closes else path), False
            if self.samples.states[following] == FIXED:
                # The released program lets the end move on from there; a joint keeps the branches connected.
                near = float(np.linalg.norm(step)) <= self.settings.growth_distance
                return ([*path, following] if near else path), False
            path.append(following)
            if angle_between(heading, step) > self.settings.turn_angle or not self._is_candidate(following):
                return path, True
            visited.add(following)
            heading = step
        return path, False

    def _next(self, current: int, heading: FloatArray, visited: set[int]) -> int | None:
        """Return the nearest sample ahead; remove those that are the same as the current one."""
        for other in self.neighbours[current]:
            state = self.samples.states[other]
            step = self.samples.points[other] - self.samples.points[current]
            distance = float(np.linalg.norm(step))
            if distance > self.settings.trace_distance:
                return None
            if state == REMOVED:
                continue
            if distance < self.settings.duplicate_distance:
                if state == MOVING and other not in visited and other not in self.bridges:
                    self.samples.states[other] = REMOVED
                continue
            if step @ heading >= 0:
                return other
        return None

    def _is_candidate(self, sample: int) -> bool:
        return bool(self.candidates[sample]) and self.samples.states[sample] == MOVING
