"""Compiled search for the nearest triangle of many points at once.

Points come in spatial order and go down the tree of boxes in packets; the bounds of all points of a packet are tested
in one vector loop, and the search starts from the triangles that were nearest to the packet before.

The search is done in float32, on offsets from the node or triangle at hand. It settles which triangle is nearest; the
distance to that one is then computed in float64.
"""

import numpy as np

from morphoskel.compiled import kernel

LANES = 16
"""Points in a packet: two vectors of eight float32 numbers."""


@kernel
def _any_closer(xs, ys, zs, best, nodes, i):
    """Tell whether the box of a node is closer to any point of the packet than what it has found."""
    x0, y0, z0 = nodes[i, 0], nodes[i, 1], nodes[i, 2]
    ax, ay, az = nodes[i, 3], nodes[i, 4], nodes[i, 5]
    bx, by, bz = nodes[i, 6], nodes[i, 7], nodes[i, 8]
    cx, cy, cz = nodes[i, 9], nodes[i, 10], nodes[i, 11]
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
    ux, uy, uz = frames[t, 3], frames[t, 4], frames[t, 5]
    vx, vy, vz = frames[t, 6], frames[t, 7], frames[t, 8]
    wx, wy, wz = frames[t, 9], frames[t, 10], frames[t, 11]
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
    ux, uy, uz = (
        corners[t, 1, 0] - corners[t, 0, 0],
        corners[t, 1, 1] - corners[t, 0, 1],
        corners[t, 1, 2] - corners[t, 0, 2],
    )
    vx, vy, vz = (
        corners[t, 2, 0] - corners[t, 0, 0],
        corners[t, 2, 1] - corners[t, 0, 1],
        corners[t, 2, 2] - corners[t, 0, 2],
    )
    uu, uv, vv = ux * ux + uy * uy + uz * uz, ux * vx + uy * vy + uz * vz, vx * vx + vy * vy + vz * vz
    along_u, along_v = x * ux + y * uy + z * uz, x * vx + y * vy + z * vz
    first_share, second_share = vv * along_u - uv * along_v, uu * along_v - uv * along_u
    if first_share > 0 and second_share > 0 and first_share + second_share < uu * vv - uv * uv:
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        best = min(best, (x * nx + y * ny + z * nz) ** 2 / (nx * nx + ny * ny + nz * nz))
    return np.sqrt(best)


@kernel
def measure(points, corners, nodes, frames, depth, distances, start, stop):
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
