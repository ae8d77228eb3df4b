"""Move the nodes of curves to the centres of the sections of the cloud (Huang et al., SIGGRAPH 2013, re-centering)."""

from __future__ import annotations

import numpy as np

from morphoskel.shapes import FloatArray

STEPS = 8
"""Each step halves the distance to the centre of a round section."""

FEWEST = 6
"""Points in a section, below which its centre is not looked for."""

WIDEST_GAP = np.pi / 2
"""A node with a wider gap, seen along the curve, is not surrounded by its section."""

LEAST_ROUND = 0.25
"""Standard deviation over mean of the distances from the centre, above which a section is not that of a tube. A square
has 0.11, an ellipse of two to one 0.23."""


def recentre(nodes: FloatArray, tangents: FloatArray, points: FloatArray) -> FloatArray:
    """Move nodes across their curve to the centres of their sections.

    The section of a node are the points for which it is the nearest one, projected along the curve. Its centre is
    the place where the distances in opposite directions balance, averaged over all directions: an uneven density
    does not draw it to one side. The paper fits an ellipse instead. Nodes that their section does not surround, or
    whose section does not resemble that of a tube, stay where they are.

    Parameters
    ----------
    nodes
        ``(K, 3)`` float64.
    tangents
        ``(K, 3)`` float64, along the curve; zero for a node that is to stay where it is, as a junction.
    points
        ``(N, 3)`` float64, the cloud.

    Returns
    -------
    ndarray
        ``(K, 3)`` float64.
    """
    from scipy.spatial import cKDTree

    moved = nodes.copy()
    owners = np.asarray(cKDTree(nodes).query(points)[1])
    order = np.argsort(owners, kind="stable")
    sections = np.split(points[order], np.searchsorted(owners[order], np.arange(1, len(nodes))))
    for node, section in enumerate(sections):
        if tangents[node].any() and len(section) >= FEWEST:
            axes = _axes_across(tangents[node])
            moved[node] += section_centre((section - nodes[node]) @ axes.T) @ axes
    return moved


def section_centre(section: FloatArray) -> FloatArray:
    """Return the point of a plane at which the distances to a section balance in all directions.

    Parameters
    ----------
    section
        ``(N, 2)`` float64, seen from the origin.

    Returns
    -------
    ndarray
        ``(2,)`` float64; the origin if the section does not surround it, or is not round.
    """
    centre = np.zeros(2)
    for _ in range(STEPS):
        offsets = section - centre
        angles = np.arctan2(offsets[:, 1], offsets[:, 0])
        order = np.argsort(angles, kind="stable")
        gaps = np.diff(angles[order], append=angles[order[0]] + 2 * np.pi)
        if gaps.max() > WIDEST_GAP:
            return np.zeros(2)
        # Each point stands for the directions that are closer to it than to its neighbours.
        shares = (gaps + np.roll(gaps, 1)) / (4 * np.pi)
        centre = centre + shares @ offsets[order]
    distances = np.linalg.norm(section - centre, axis=1)
    return centre if distances.std() <= LEAST_ROUND * distances.mean() else np.zeros(2)


def _axes_across(tangent: FloatArray) -> FloatArray:
    """Return two unit vectors, ``(2, 3)``, that are perpendicular to a vector and to each other."""
    smallest = np.zeros(3)
    smallest[np.argmin(np.abs(tangent))] = 1
    first = np.cross(tangent, smallest)
    second = np.cross(tangent, first)
    return np.stack([first / np.linalg.norm(first), second / np.linalg.norm(second)])
