"""Finished curves: branches cut at the junctions, smoothed and resampled."""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise

import numpy as np

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.l1_medial.branches import Branch, angle_between

SMOOTHINGS = 3
"""Passes over a curve, at most."""


def chains_between_junctions(branches: list[Branch]) -> list[list[int]]:
    """Cut branches where they meet, and put together what is connected without a junction.

    Parameters
    ----------
    branches
        Samples that occur in several of them are common to them.

    Returns
    -------
    list
        Chains of samples. Only the first and last of a chain can occur in others; they are equal in a ring.
    """
    neighbours: dict[int, set[int]] = defaultdict(set)
    for branch in branches:
        for first, second in pairwise(branch.nodes):
            if first != second:
                neighbours[first].add(second)
                neighbours[second].add(first)
    chains: list[list[int]] = []
    used: set[tuple[int, int]] = set()
    stops = {node for node, others in neighbours.items() if len(others) != 2}
    for start in [*sorted(stops), *sorted(neighbours)]:  # rings have no stop; they are cut at their first sample
        for step in sorted(neighbours[start]):
            if (start, step) in used:
                continue
            chain = [start, step]
            while chain[-1] not in stops and chain[-1] != start:
                chain.append(next(node for node in sorted(neighbours[chain[-1]]) if node != chain[-2]))
            used.update(pairwise(chain))
            used.update(pairwise(chain[::-1]))
            chains.append(chain)
    return chains


def smooth(points: FloatArray, angle: float) -> FloatArray:
    """Round off the corners of a curve; its ends stay where they are.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, in order.
    angle
        Corners that turn by more than this are rounded, degrees.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64.
    """
    smoothed = points.copy()
    for _ in range(SMOOTHINGS):
        before = smoothed.copy()
        for node in range(1, len(smoothed) - 1):
            if angle_between(smoothed[node] - smoothed[node - 1], smoothed[node + 1] - smoothed[node]) > angle:
                smoothed[node] = smoothed[node] / 2 + (smoothed[node - 1] + smoothed[node + 1]) / 4
        if np.array_equal(before, smoothed):
            break
    return smoothed


def resample(points: FloatArray, spacing: float) -> FloatArray:
    """Spread points evenly along a curve.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, at least two, in order.
    spacing
        Distance aimed at, along the curve.

    Returns
    -------
    ndarray
        ``(M, 3)`` float64; the ends are those of the curve. A ring has at least three different points.
    """
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    least = 3 if np.array_equal(points[0], points[-1]) else 1
    places = np.linspace(0, lengths[-1], max(round(float(lengths[-1]) / spacing), least) + 1)
    return np.column_stack([np.interp(places, lengths, points[:, axis]) for axis in range(3)])
