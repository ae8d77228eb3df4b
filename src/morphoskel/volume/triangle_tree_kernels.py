"""Compiled construction of a tree of boxes over triangles, for :mod:`morphoskel.volume.distance_kernels`.

The triangles are split by medians into a complete binary tree with a few triangles a leaf, so that no pointers are
stored: node ``i`` has the children ``2 i`` and ``2 i + 1``. Each node has a box that is turned with the mean normal of
its triangles. A piece of a smooth surface then has a box whose thickness shrinks with the square of its size, while
a box along the axes shrinks in proportion; a point deep inside a shape, far from all of its surface alike, would meet
dozens of those before it is sure of the nearest triangle.
"""

import numpy as np

from morphoskel.compiled import kernel

NODE_NUMBERS = 15
"""Of a node: centre, three axes, three half extents."""

TRIANGLE_NUMBERS = 17
"""Of a triangle: corner, axes along, across and normal, longest edge, third corner in the plane, two inverses."""


@kernel
def _select(order, keys, start, stop, position):
    """Reorder ``order[start:stop]`` so that keys before `position` are no larger, and after it no smaller."""
    left, right = start, stop - 1
    while left < right:
        pivot = keys[order[(left + right) // 2]]
        low, high = left, right
        while low <= high:
            while keys[order[low]] < pivot:
                low += 1
            while keys[order[high]] > pivot:
                high -= 1
            if low <= high:
                order[low], order[high] = order[high], order[low]
                low += 1
                high -= 1
        if position <= high:
            right = high
        elif position >= low:
            left = low
        else:
            return


@kernel
def _set_axes(normal, area, axes):
    """Write a right-handed frame, rounded to float32, whose first axis is `normal` where that is not nearly 0."""
    length = np.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    axes[:] = 0
    if length <= 0.5 * area or length == 0:
        for axis in range(3):
            axes[axis, axis] = 1
        return
    x, y, z = normal[0] / length, normal[1] / length, normal[2] / length
    sign = 1.0 if z >= 0 else -1.0
    a = -1 / (sign + z)
    axes[0, 0], axes[0, 1], axes[0, 2] = x, y, z
    axes[1, 0], axes[1, 1], axes[1, 2] = 1 + sign * x * x * a, sign * x * y * a, -sign * x
    axes[2, 0], axes[2, 1], axes[2, 2] = x * y * a, sign + y * y * a, -y


@kernel
def _fit_box(corners, normals, order, start, stop, axes, node):
    """Write the box of some triangles into `node`, its faces pushed out by more than float32 can be wrong."""
    normal = np.zeros(3)
    area = 0.0
    for s in range(start, stop):
        t = order[s]
        area += np.sqrt(normals[t, 0] ** 2 + normals[t, 1] ** 2 + normals[t, 2] ** 2)
        for axis in range(3):
            normal[axis] += normals[t, axis]
    _set_axes(normal, area, axes)
    t = order[start]
    origin_x, origin_y, origin_z = corners[t, 0, 0], corners[t, 0, 1], corners[t, 0, 2]
    low, high, centre = np.full(3, np.inf), np.full(3, -np.inf), np.zeros(3)
    for s in range(start, stop):
        for corner in range(3):
            x = corners[order[s], corner, 0] - origin_x
            y = corners[order[s], corner, 1] - origin_y
            z = corners[order[s], corner, 2] - origin_z
            for axis in range(3):
                along = axes[axis, 0] * x + axes[axis, 1] * y + axes[axis, 2] * z
                low[axis] = min(low[axis], along)
                high[axis] = max(high[axis], along)
    for axis in range(3):
        for dimension in range(3):
            centre[dimension] += axes[axis, dimension] * (low[axis] + high[axis]) / 2
            node[3 + 3 * axis + dimension] = axes[axis, dimension]
    node[0], node[1], node[2] = origin_x + centre[0], origin_y + centre[1], origin_z + centre[2]
    size = max(high[0] - low[0], max(high[1] - low[1], high[2] - low[2]))
    place = max(abs(origin_x), max(abs(origin_y), abs(origin_z)))
    for axis in range(3):
        node[12 + axis] = (high[axis] - low[axis]) / 2 + 1e-6 * size + 2e-7 * place


@kernel
def build_tree(corners, depth, first, nodes, order):
    """Fill `nodes`, ``(2 ** (depth + 1), 15)``, and sort `order`, the numbers of the triangles, into leaves.

    `corners` is ``(T, 3, 3)`` float64. `first` is the number of leaves, ``2 ** depth``; leaf ``i`` holds the triangles
    ``order[i * T // first : (i + 1) * T // first]``.
    """
    total = len(corners)
    centres, normals = np.empty((3, total)), np.empty((total, 3))
    for t in range(total):
        for axis in range(3):
            centres[axis, t] = (corners[t, 0, axis] + corners[t, 1, axis] + corners[t, 2, axis]) / 3
            y, z = (axis + 1) % 3, (axis + 2) % 3
            normals[t, axis] = (corners[t, 1, y] - corners[t, 0, y]) * (corners[t, 2, z] - corners[t, 0, z]) - (
                corners[t, 1, z] - corners[t, 0, z]
            ) * (corners[t, 2, y] - corners[t, 0, y])
    axes = np.empty((3, 3), np.float32)
    for level in range(depth + 1):
        count = 2**level
        for i in range(count):
            start, stop = i * total // count, (i + 1) * total // count
            _fit_box(corners, normals, order, start, stop, axes, nodes[count + i])
            if level < depth:
                longest, axis_of_longest = -1.0, 0
                for axis in range(3):
                    low, high = np.inf, -np.inf
                    for s in range(start, stop):
                        low = min(low, centres[axis, order[s]])
                        high = max(high, centres[axis, order[s]])
                    if high - low > longest:
                        longest, axis_of_longest = high - low, axis
                _select(order, centres[axis_of_longest], start, stop, (2 * i + 1) * total // (2 * count))


@kernel
def flatten_triangles(corners, frames):
    """Write, ``(T, 17)`` float32, the frame in which each triangle has its longest edge on the first axis.

    Triangles without area have no inside; triangles without extent are their first corner.
    """
    for t in range(len(corners)):
        longest, first = -1.0, 0
        for edge in range(3):
            square = 0.0
            for axis in range(3):
                square += (corners[t, (edge + 1) % 3, axis] - corners[t, edge, axis]) ** 2
            if square > longest:
                longest, first = square, edge
        second, third = (first + 1) % 3, (first + 2) % 3
        length = np.sqrt(longest)
        for axis in range(3):
            frames[t, axis] = corners[t, first, axis]
        if length == 0:
            frames[t, 3] = frames[t, 7] = frames[t, 11] = 1
            continue
        ux = (corners[t, second, 0] - corners[t, first, 0]) / length
        uy = (corners[t, second, 1] - corners[t, first, 1]) / length
        uz = (corners[t, second, 2] - corners[t, first, 2]) / length
        vx = corners[t, third, 0] - corners[t, first, 0]
        vy = corners[t, third, 1] - corners[t, first, 1]
        vz = corners[t, third, 2] - corners[t, first, 2]
        along = vx * ux + vy * uy + vz * uz
        vx, vy, vz = vx - along * ux, vy - along * uy, vz - along * uz
        height = np.sqrt(vx * vx + vy * vy + vz * vz)
        if height <= 1e-7 * length:  # a sliver: any direction across will do, up to an error of this share
            height = 0.0
            vx, vy, vz = (0.0, uz, -uy) if abs(ux) < 0.7 else (-uz, 0.0, ux)
            across = np.sqrt(vx * vx + vy * vy + vz * vz)
        else:
            across = height
        vx, vy, vz = vx / across, vy / across, vz / across
        frames[t, 3], frames[t, 4], frames[t, 5] = ux, uy, uz
        frames[t, 6], frames[t, 7], frames[t, 8] = vx, vy, vz
        frames[t, 9], frames[t, 10], frames[t, 11] = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        frames[t, 12], frames[t, 13], frames[t, 14] = length, along, height
        second_square = (along - length) ** 2 + height**2
        third_square = along**2 + height**2
        frames[t, 15] = 1 / second_square if second_square > 0 else 0.0
        frames[t, 16] = 1 / third_square if third_square > 0 else 0.0
