"""Compiled parity tests for many points against a closed surface.

Strategy. All coordinates are rounded to a lattice of 2**25 steps an axis of the box, about the resolution of float32.
Products of two differences of such integers are exact in float64, so it is decided without error whether a line along
an axis passes left or right of an edge, and a line that meets an edge or a corner is counted by the same rule for all
triangles that share it. A line therefore crosses a closed surface an even number of times, always; no vote among
several rays is needed.

Tiles that no triangle touches lie inside or outside as a whole; one line for each column of tiles settles all of them.
A point in a tile that is touched follows a line along an axis to the nearest tile that is not, and only the triangles
of the tiles on the way count. Where a crossing lies on the boundary of two tiles, its coordinate, always computed in
the same way, puts it into one of them.
"""

import numpy as np

from morphoskel.compiled import kernel

LATTICE = 2**25
NO_WAY = np.uint8(6)
"""Direction of a tile from which no line reaches a tile that is not touched; else 2 * axis + (1 if upward)."""
FAR = 1 << 30


@kernel
def _mix(number):
    """Scramble 64 bits (the finalizer of MurmurHash3)."""
    number = np.uint64(number)
    number ^= number >> np.uint64(33)
    number *= np.uint64(0xFF51AFD7ED558CCD)
    number ^= number >> np.uint64(33)
    number *= np.uint64(0xC4CEB9FE1A85EC53)
    return number ^ (number >> np.uint64(33))


@kernel
def edge_checksum(corners):
    """Return 0 if every edge borders an even number of triangles; else, but for one chance in 2**64, not 0.

    Edges are known by the coordinates of their ends, so that duplicated vertices do not matter. Each edge gives a
    random-looking number, and equal ones cancel.
    """
    total = np.uint64(0)
    ends = np.empty(3, np.uint64)
    for t in range(len(corners)):
        for corner in range(3):
            number = np.uint64(0)
            for axis in range(3):
                number = _mix(number + np.uint64(np.int64(corners[t, corner, axis])) + np.uint64(1))
            ends[corner] = number
        for corner in range(3):
            first, second = ends[corner], ends[(corner + 1) % 3]
            if first != second:
                total ^= _mix(first + second)
    return total


@kernel
def _left_of_edge(u0, v0, u1, v1, u, v):
    """Tell whether a ray from (u, v) towards larger u crosses an edge; equal for both directions of the edge."""
    if v0 > v1:
        u0, v0, u1, v1 = u1, v1, u0, v0
    return (v0 <= v) & (v < v1) & ((u1 - u0) * (v - v0) > (u - u0) * (v1 - v0))


@kernel
def _height(corners, t, u_axis, v_axis, axis, u, v):
    """Return where a line along `axis` through (u, v), which lies in the projected triangle, meets its plane."""
    u0, v0 = corners[t, 0, u_axis], corners[t, 0, v_axis]
    u1, v1 = corners[t, 1, u_axis] - u0, corners[t, 1, v_axis] - v0
    u2, v2 = corners[t, 2, u_axis] - u0, corners[t, 2, v_axis] - v0
    u, v = u - u0, v - v0
    area = u1 * v2 - u2 * v1
    share_1, share_2 = (u * v2 - u2 * v) / area, (u1 * v - u * v1) / area
    height = corners[t, 0, axis]
    return height + share_1 * (corners[t, 1, axis] - height) + share_2 * (corners[t, 2, axis] - height)


@kernel
def columns_inside(corners, centres):
    """Tell which centres of tiles lie inside, ``(n, n, n)`` uint8, by one line for each column along z.

    `centres` is ``(3, n)``, in lattice steps.
    """
    n = centres.shape[1]
    inside = np.zeros((n, n, n), np.uint8)
    for t in range(len(corners)):
        a, b, c = corners[t, 0], corners[t, 1], corners[t, 2]
        low_x, high_x = min(a[0], min(b[0], c[0])), max(a[0], max(b[0], c[0]))
        low_y, high_y = min(a[1], min(b[1], c[1])), max(a[1], max(b[1], c[1]))
        for i in range(np.searchsorted(centres[0], low_x), n):
            x = centres[0, i]
            if x > high_x:
                break
            for j in range(np.searchsorted(centres[1], low_y), n):
                y = centres[1, j]
                if y > high_y:
                    break
                hit = _left_of_edge(a[0], a[1], b[0], b[1], x, y)
                hit ^= _left_of_edge(b[0], b[1], c[0], c[1], x, y)
                hit ^= _left_of_edge(c[0], c[1], a[0], a[1], x, y)
                if hit:
                    above = np.searchsorted(centres[2], _height(corners, t, 0, 1, 2, x, y), side="right")
                    if above < n:
                        inside[i, j, above] ^= 1
    for i in range(n):
        for j in range(n):
            for k in range(1, n):
                inside[i, j, k] ^= inside[i, j, k - 1]
    return inside


@kernel
def list_triangles(corners, edges, margin, starts, triangles):
    """Count or, where `triangles` is not empty, list the triangles that touch each tile, grown by `margin`.

    To count, `starts` has to be zero; afterwards ``starts[i + 1]`` is the number of tile ``i``. To list, `starts` is
    where each tile's list begins; afterwards it is where each one ends.
    """
    n = edges.shape[1] - 1
    first, last = np.empty(3, np.int64), np.empty(3, np.int64)
    for t in range(len(corners)):
        a, b, c = corners[t, 0], corners[t, 1], corners[t, 2]
        for axis in range(3):
            low, high = min(a[axis], min(b[axis], c[axis])), max(a[axis], max(b[axis], c[axis]))
            first[axis] = max(np.searchsorted(edges[axis], low - margin[axis], side="left") - 1, 0)
            last[axis] = min(np.searchsorted(edges[axis], high + margin[axis], side="right"), n)
        nx = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])
        ny = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])
        nz = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        for i in range(first[0], last[0]):
            x, half_x = (edges[0, i] + edges[0, i + 1]) / 2 - a[0], (edges[0, i + 1] - edges[0, i]) / 2 + margin[0]
            for j in range(first[1], last[1]):
                y, half_y = (edges[1, j] + edges[1, j + 1]) / 2 - a[1], (edges[1, j + 1] - edges[1, j]) / 2 + margin[1]
                for k in range(first[2], last[2]):
                    z = (edges[2, k] + edges[2, k + 1]) / 2 - a[2]
                    half_z = (edges[2, k + 1] - edges[2, k]) / 2 + margin[2]
                    reach = abs(nx) * half_x + abs(ny) * half_y + abs(nz) * half_z
                    if abs(nx * x + ny * y + nz * z) <= reach * (1 + 1e-9):
                        tile = (i * n + j) * n + k
                        if len(triangles) == 0:
                            starts[tile + 1] += 1
                        else:
                            triangles[starts[tile]] = t
                            starts[tile] += 1


@kernel
def choose_directions(touched, ends_free):
    """Return, for each tile, the direction in which the fewest touched tiles lie before one that is not.

    `touched` is ``(n, n, n)`` bool. `ends_free` tells for each direction whether the surface ends before the tiles do.
    """
    n = len(touched)
    directions = np.full((n, n, n), NO_WAY, np.uint8)
    shortest = np.full((n, n, n), FAR, np.int32)
    place = np.empty(3, np.int64)
    for direction in range(6):
        axis, upward = direction // 2, direction % 2 == 1
        for u in range(n):
            for v in range(n):
                way = 0 if ends_free[direction] else FAR
                for step in range(n):
                    place[axis] = n - 1 - step if upward else step
                    place[(axis + 1) % 3], place[(axis + 2) % 3] = u, v
                    i, j, k = place
                    way = min(way + 1, FAR) if touched[i, j, k] else 0
                    if way < shortest[i, j, k]:
                        shortest[i, j, k] = way
                        directions[i, j, k] = direction
    return directions


@kernel
def _flip_crossed(points, first, last, corners, t, axis, upward, low, high, inside):
    """Flip `inside` for the points whose line meets triangle `t` ahead of them and between `low` and `high`."""
    u_axis, v_axis = (axis + 1) % 3, (axis + 2) % 3
    ua, va = corners[t, 0, u_axis], corners[t, 0, v_axis]
    ub, vb = corners[t, 1, u_axis], corners[t, 1, v_axis]
    uc, vc = corners[t, 2, u_axis], corners[t, 2, v_axis]
    low_u, high_u = min(ua, min(ub, uc)), max(ua, max(ub, uc))
    low_v, high_v = min(va, min(vb, vc)), max(va, max(vb, vc))
    for p in range(first, last):
        u, v = points[u_axis, p], points[v_axis, p]
        if u < low_u or u > high_u or v < low_v or v > high_v:
            continue
        hit = _left_of_edge(ua, va, ub, vb, u, v)
        hit ^= _left_of_edge(ub, vb, uc, vc, u, v)
        hit ^= _left_of_edge(uc, vc, ua, va, u, v)
        if hit:
            height = _height(corners, t, u_axis, v_axis, axis, u, v)
            if low <= height < high and (height > points[axis, p]) == upward:
                inside[p] ^= True


@kernel
def test_points(points, offsets, cells, corners, edges, starts, triangles, directions, centres_inside, inside):
    """Write which points lie inside, ``(m,)`` bool.

    `points` is ``(3, m)``, in lattice steps; those of the touched tile in ``cells[i]`` begin at ``offsets[i]``.
    """
    n = len(directions)
    for tile in range(len(cells)):
        i, j, k = cells[tile]
        first, last = offsets[tile], offsets[tile + 1]
        direction = directions[i, j, k]
        if direction == NO_WAY:
            for t in range(len(corners)):
                _flip_crossed(points, first, last, corners, t, 2, True, -np.inf, np.inf, inside)
            continue
        axis, upward = direction // 2, direction % 2 == 1
        place = cells[tile].astype(np.int64)
        start = place[axis]
        reference = False
        while 0 <= place[axis] < n:
            row = (place[0] * n + place[1]) * n + place[2]
            if starts[row] == starts[row + 1]:
                reference = centres_inside[place[0], place[1], place[2]] == 1
                break
            low, high = edges[axis, place[axis]], edges[axis, place[axis] + 1]
            # Rounding may put a point beside its own tile, and a crossing beyond the last tile.
            if place[axis] == 0 or (place[axis] == start and upward):
                low = -np.inf
            if place[axis] == n - 1 or (place[axis] == start and not upward):
                high = np.inf
            for position in range(starts[row], starts[row + 1]):
                _flip_crossed(points, first, last, corners, triangles[position], axis, upward, low, high, inside)
            place[axis] += 1 if upward else -1
        if reference:
            for p in range(first, last):
                inside[p] ^= True
