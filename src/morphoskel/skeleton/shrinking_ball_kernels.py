"""Compiled shrinking of balls, with a search tree whose queries end at the ball.

The nearest point to a centre matters only if it lies inside the ball. Branches of the tree outside it are left out,
which is what makes round shapes fast: there all points are nearly equally far from the centre, and a search for the
nearest one would visit them all.
"""

import numpy as np

from morphoskel.compiled import kernel

STACK = 64
"""Branches that a search can put aside; it needs one a level of the tree and one more."""


@kernel
def build_tree(points, depth, order, ranges, boxes):
    """Sort `order`, the indices of the points, into a balanced tree of boxes.

    The children of node i are 2 i and 2 i + 1, the root is node 1. Node i holds the points
    ``order[ranges[i, 0]:ranges[i, 1]]``; its box is from ``boxes[i, 0]`` to ``boxes[i, 1]``.
    """
    ranges[1, 0], ranges[1, 1] = 0, len(points)
    for node in range(1, len(ranges)):
        start, stop = ranges[node, 0], ranges[node, 1]
        for axis in range(3):
            low, high = np.inf, -np.inf
            for i in range(start, stop):
                low, high = min(low, points[order[i], axis]), max(high, points[order[i], axis])
            boxes[node, 0, axis], boxes[node, 1, axis] = low, high
        if node >= 2**depth:
            continue
        axis = np.argmax(boxes[node, 1] - boxes[node, 0])
        own = order[start:stop].copy()
        order[start:stop] = own[np.argsort(points[own, axis], kind="mergesort")]
        middle = (start + stop) // 2
        ranges[2 * node, 0], ranges[2 * node, 1] = start, middle
        ranges[2 * node + 1, 0], ranges[2 * node + 1, 1] = middle, stop


@kernel
def _squared_gap(boxes, node, centre):
    """Return the squared distance from a point to the box of a node."""
    total = 0.0
    for axis in range(3):
        beyond = max(boxes[node, 0, axis] - centre[axis], centre[axis] - boxes[node, 1, axis], 0.0)
        total += beyond * beyond
    return total


@kernel
def _nearest_within(sorted_points, ranges, boxes, centre, squared_bound, nodes, gaps):
    """Return the place of the nearest point, or -1 if none is nearer than the bound."""
    nearest = -1
    count = 1
    nodes[0], gaps[0] = 1, _squared_gap(boxes, 1, centre)
    while count:
        count -= 1
        node = nodes[count]
        if gaps[count] >= squared_bound:
            continue
        if 2 * node < len(ranges):
            left, right = _squared_gap(boxes, 2 * node, centre), _squared_gap(boxes, 2 * node + 1, centre)
            nodes[count], gaps[count] = 2 * node + (left <= right), max(left, right)
            nodes[count + 1], gaps[count + 1] = 2 * node + (left > right), min(left, right)
            count += 2
            continue
        for i in range(ranges[node, 0], ranges[node, 1]):
            squared = 0.0
            for axis in range(3):
                squared += (sorted_points[i, axis] - centre[axis]) ** 2
            if squared < squared_bound:
                nearest, squared_bound = i, squared
    return nearest


@kernel
def shrink(points, normals, order, ranges, boxes, rounds, rounding, tolerance, radii, second):
    """Shrink the ball of each point from the radius given in `radii`, and write the second point that it touches.

    `second` holds -1 at first. A ball with one touching point is done if no point lies in it deeper than the share
    `rounding` of the radius, one with two if none lies deeper than the share `tolerance`.
    """
    sorted_points = points[order]
    nodes, gaps = np.empty(STACK, np.int64), np.empty(STACK)
    centre, gap = np.empty(3), np.empty(3)
    for i in range(len(points)):
        for _ in range(rounds):
            centre[:] = points[i] - radii[i] * normals[i]
            bound = radii[i] * (1 - (rounding if second[i] < 0 else tolerance))
            place = _nearest_within(sorted_points, ranges, boxes, centre, bound * bound, nodes, gaps)
            if place < 0:
                break
            gap[:] = points[i] - sorted_points[place]
            height = gap[0] * normals[i, 0] + gap[1] * normals[i, 1] + gap[2] * normals[i, 2]
            if height <= 0:  # only by rounding: a point inside the ball lies below the tangent plane
                break
            radii[i] = (gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]) / (2 * height)
            second[i] = order[place]
