"""The nodes and edges of the finished skeleton."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from morphoskel.shapes import FloatArray, IntArray
from morphoskel.skeleton.l1_medial.branches import Branch
from morphoskel.skeleton.l1_medial.curves import chains_between_junctions, resample, smooth
from morphoskel.skeleton.l1_medial.recentring import recentre
from morphoskel.skeleton.l1_medial.samples import MOVING, Samples
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings

SMOOTHED_TURN = 1.5
"""Corners are rounded from the largest turn of a branch over this on."""


def assemble(
    branches: list[Branch], samples: Samples, points: FloatArray, settings: L1MedialSettings
) -> tuple[FloatArray, IntArray]:
    """Turn branches into evenly spaced nodes and the edges between them.

    Parameters
    ----------
    branches
        Chains of samples; a bridge at their ends counts as a sample like the others.
    samples
        The samples.
    points
        ``(N, 3)`` float64, the cloud.
    settings
        Spacing, and what is done with nodes and with samples that are on no branch.

    Returns
    -------
    nodes, edges
        ``(K, 3)`` float64 and ``(E, 2)`` int64.
    """
    nodes: list[FloatArray] = []
    links: list[tuple[int, int]] = []
    shared: dict[int, int] = {}
    count = 0
    for chain in chains_between_junctions(branches):
        curve = resample(smooth(samples.points[chain], settings.turn_angle / SMOOTHED_TURN), settings.spacing)
        numbers = list(range(count, count + len(curve) - 2))
        nodes.extend(curve[1:-1])
        count += len(numbers)
        for sample, place in ((chain[0], 0), (chain[-1], -1)):
            if sample not in shared:
                shared[sample] = count
                nodes.append(curve[place])
                count += 1
        path = [shared[chain[0]], *numbers, shared[chain[-1]]]
        links.extend(pairwise(path))
    edges = np.array(links, dtype=np.int64).reshape(-1, 2)
    centres = np.array(nodes).reshape(-1, 3)
    if settings.recentre and len(centres):
        centres = recentre(centres, _tangents(centres, edges), points)
    if settings.keep_leftover:
        used = {node for branch in branches for node in branch.nodes}
        leftover = [sample for sample in samples.indices(MOVING).tolist() if sample not in used]
        centres = np.vstack([centres, samples.points[leftover]])
    return centres, edges


def _tangents(nodes: FloatArray, edges: IntArray) -> FloatArray:
    """Return the direction of the curve at each node; zero where more than two pieces meet."""
    tangents = np.zeros_like(nodes)
    for first, second in edges:
        step = nodes[second] - nodes[first]
        for node in (first, second):
            # Where two curves make one, their edges may run against each other.
            tangents[node] += -step if tangents[node] @ step < 0 else step
    tangents[np.bincount(edges.ravel(), minlength=len(nodes)) > 2] = 0
    return tangents
