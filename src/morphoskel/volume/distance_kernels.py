"""Compiled search for the nearest triangle of many points at once.

Strategy. The triangles are split by medians into a complete binary tree with a few triangles a leaf, so that no
pointers are stored: node ``i`` has the children ``2 i`` and ``2 i + 1``. Each node has a box that is turned with the
mean normal of its triangles. A piece of a smooth surface then has a box whose thickness shrinks with the square of its
size, while a box along the axes shrinks in proportion; a point deep inside a shape, far from all of its surface alike,
would meet dozens of those before it is sure of the nearest triangle.

Points come in spatial order and go down the tree in packets; the bounds of all points of a packet are tested in one
vector loop, and the search starts from the triangles that were nearest to the packet before.

The search is done in float32, on offsets from the node or triangle at hand. It settles which triangle is nearest; the
distance to that one is then computed in float64.
"""

import numpy as np

from morphoskel.compiled import kernel

LANES = 16
"""Points in a packet: two vectors of eight float32 numbers."""

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
    """Write a right-handed frame, rounded to float32, whose first axis is `normal` unless it is nearly cancelled out."""
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


@kernel
def _any_closer(xs, ys, zs, best, nodes, i):
    """Tell whether the box of a node is closer to any point of the packet than what it has found."""
    x0, y0, z0 = nodes[i, 0], nodes[i, 1], nodes[i, 2]
    ax, ay, az, bx, by, bz, cx, cy, cz = (
        nodes[i, 3], nodes[i, 4], nodes[i, 5], nodes[i, 6], nodes[i, 7], nodes[i, 8], nodes[i, 9], nodes[i, 10], nodes[i, 11],
    )  # fmt: skip
    half_a, half_b, half_c = nodes[i, 12], nodes[i, 13], nodes[i, 14]
    zero = np.float32(0)
    closer = np.int32(0)
    for j in range(LANES):
        x, y, z = xs[j] - x0, ys[j] - y0, zs[j] - z0
        a = max(abs(ax * x + ay * y + az * z) - half_a, zero)
        b = max(abs(bx * x + by * y + bz * z) - half_b, zero)
        c = max(abs(cx * x + cy * y + cz * z) - half_c, zero)
        closer |= np.int32(1) if a * a + b * b + c * c < best[j] else np.int32(0)
    return closer != 0


@kernel
def _try_triangle(xs, ys, zs, best, nearest, frames, t):
    """Lower the squared distance of each point of the packet to that of a triangle, if it is closer.

    In the triangle's frame its corners are (0, 0), (length, 0) and (along, height): the distance in the plane is 0
    inside, else that to the nearest of three edges.
    """
    x0, y0, z0 = frames[t, 0], frames[t, 1], frames[t, 2]
    ux, uy, uz, vx, vy, vz, wx, wy, wz = (
        frames[t, 3], frames[t, 4], frames[t, 5], frames[t, 6], frames[t, 7], frames[t, 8], frames[t, 9], frames[t, 10], frames[t, 11],
    )  # fmt: skip
    length, along, height = frames[t, 12], frames[t, 13], frames[t, 14]
    per_second, per_third = frames[t, 15], frames[t, 16]
    back = along - length
    zero, one = np.float32(0), np.float32(1)
    name = np.int32(t)
    for j in range(LANES):
        x, y, z = xs[j] - x0, ys[j] - y0, zs[j] - z0
        u = ux * x + uy * y + uz * z
        v = vx * x + vy * y + vz * z
        w = wx * x + wy * y + wz * z
        off = u - min(max(u, zero), length)
        plane = off * off + v * v
        share = min(max((u * along + v * height) * per_third, zero), one)
        off_u, off_v = u - share * along, v - share * height
        plane = min(plane, off_u * off_u + off_v * off_v)
        from_second = u - length
        share = min(max((from_second * back + v * height) * per_second, zero), one)
        off_u, off_v = from_second - share * back, v - share * height
        plane = min(plane, off_u * off_u + off_v * off_v)
        inside = (v > zero) & (v * along < u * height) & (from_second * height < v * back)
        square = (zero if inside else plane) + w * w
        closer = square < best[j]
        nearest[j] = name if closer else nearest[j]
        best[j] = square if closer else best[j]


@kernel
def _exact_distance(x, y, z, corners, t):
    """Return the distance of a point to triangle `t`, in float64."""
    best = np.inf
    for first in range(3):
        second = (first + 1) % 3
        px, py, pz = x - corners[t, first, 0], y - corners[t, first, 1], z - corners[t, first, 2]
        dx = corners[t, second, 0] - corners[t, first, 0]
        dy = corners[t, second, 1] - corners[t, first, 1]
        dz = corners[t, second, 2] - corners[t, first, 2]
        square = dx * dx + dy * dy + dz * dz
        share = 0.0
        if square > 0:
            share = min(max((px * dx + py * dy + pz * dz) / square, 0.0), 1.0)
        px, py, pz = px - share * dx, py - share * dy, pz - share * dz
        best = min(best, px * px + py * py + pz * pz)
    x, y, z = x - corners[t, 0, 0], y - corners[t, 0, 1], z - corners[t, 0, 2]
    ux, uy, uz = (corners[t, 1, 0] - corners[t, 0, 0], corners[t, 1, 1] - corners[t, 0, 1], corners[t, 1, 2] - corners[t, 0, 2])
    vx, vy, vz = (corners[t, 2, 0] - corners[t, 0, 0], corners[t, 2, 1] - corners[t, 0, 1], corners[t, 2, 2] - corners[t, 0, 2])
    uu, uv, vv = ux * ux + uy * uy + uz * uz, ux * vx + uy * vy + uz * vz, vx * vx + vy * vy + vz * vz
    along_u, along_v = x * ux + y * uy + z * uz, x * vx + y * vy + z * vz
    first_share, second_share = vv * along_u - uv * along_v, uu * along_v - uv * along_u
    if first_share > 0 and second_share > 0 and first_share + second_share < uu * vv - uv * uv:
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        best = min(best, (x * nx + y * ny + z * nz) ** 2 / (nx * nx + ny * ny + nz * nz))
    return np.sqrt(best)


@kernel
def measure(points, corners, nodes, frames, depth, start, stop, distances):
    """Write the distances of the points from `start` to `stop`; triangles are in the order of the leaves."""
    total, first = len(corners), 2**depth
    xs, ys, zs = np.empty(LANES, np.float32), np.empty(LANES, np.float32), np.empty(LANES, np.float32)
    best, nearest = np.empty(LANES, np.float32), np.zeros(LANES, np.int32)
    stack = np.empty(depth + 2, np.int64)
    for packet in range(start, stop, LANES):
        for j in range(LANES):
            p = min(packet + j, stop - 1)
            xs[j], ys[j], zs[j] = points[p, 0], points[p, 1], points[p, 2]
            best[j] = np.inf
        before, last = nearest[0], nearest[LANES - 1]
        _try_triangle(xs, ys, zs, best, nearest, frames, before)
        _try_triangle(xs, ys, zs, best, nearest, frames, last)
        stack[0] = 1
        waiting = 1
        while waiting > 0:
            waiting -= 1
            node = stack[waiting]
            if not _any_closer(xs, ys, zs, best, nodes, node):
                continue
            if node >= first:
                leaf = node - first
                for t in range(leaf * total // first, (leaf + 1) * total // first):
                    _try_triangle(xs, ys, zs, best, nearest, frames, t)
                continue
            far, near = 2 * node, 2 * node + 1
            far_square, near_square = np.float32(0), np.float32(0)
            for axis, at in ((0, xs[0]), (1, ys[0]), (2, zs[0])):
                far_square += (nodes[far, axis] - at) ** 2
                near_square += (nodes[near, axis] - at) ** 2
            if far_square < near_square:
                far, near = near, far
            stack[waiting], stack[waiting + 1] = far, near
            waiting += 2
        for j in range(min(LANES, stop - packet)):
            distances[packet + j] = _exact_distance(
                np.float64(xs[j]), np.float64(ys[j]), np.float64(zs[j]), corners, nearest[j]
            )
