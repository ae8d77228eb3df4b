"""Compiled search for the nearest neighbours of many points at once, fused with what is done with their values.

Strategy. The points are sorted into cubic cells of about eight. The points of a cell share one window of cells around
it, whose coordinates are copied side by side (cells along z are neighbours in memory, so the copy takes few long
runs). For each point the squared distances to the whole window are computed in one vector loop. The `k`-th smallest
of them is found by counting: a threshold, first that of the point before, is moved until exactly `k` distances do not
exceed it; where several are equal, all of them are taken. Counting 200 distances takes two dozen
vector instructions, far less than keeping a sorted list of the nearest. The window is certain to hold the neighbours
if the threshold reaches no farther than its sides; else a wider one is taken.

Non-negative float32 numbers and the int32 numbers of the same bits are ordered alike. Distances and values are
therefore compared as integers, whose minima and maxima the compiler turns into vector instructions.
"""

import numpy as np

from morphoskel.compiled import kernel

LARGEST = np.int32(2**31 - 1)
SMALLEST = np.int32(-(2**31))
CLOSE = np.int32(2)
"""Distances too many below a threshold, from which on they are taken away one by one."""
STEPS = 10
"""Thresholds tried by proportion, after which ties are suspected and distances are taken away one by one."""
COUNTS = 1024
"""Counts up to which the rule of proportion is tabulated."""
SAFETY = 1e-3
"""Share of a cell's side by which a window is trusted less than it reaches: points may be put to the neighbouring
cell by rounding."""


@kernel
def growth_table():
    """Return, for each count, two thirds of its binary logarithm in units of the last place of a float32.

    Around a point in a solid, counts grow like the distance cubed, so squared distances grow like the count to the
    power of two thirds; and the bits of a float32, read as an integer, are close to its logarithm.
    """
    table = np.zeros(COUNTS, np.int32)
    for count in range(2, COUNTS):
        table[count] = np.int32(np.log2(count) * (2 / 3) * 2**23)
    return table


@kernel
def _set_limits(cells, cell, rings, limits):
    """Write the first and, exclusive, the last cell along each axis of the window of `rings` around `cell`."""
    limits[2, 0], limits[2, 1] = cell % cells[2], cell % cells[2] + 1
    row = cell // cells[2]
    limits[1, 0], limits[1, 1] = row % cells[1], row % cells[1] + 1
    limits[0, 0], limits[0, 1] = row // cells[1], row // cells[1] + 1
    for axis in range(3):
        limits[axis, 0] = max(limits[axis, 0] - rings, 0)
        limits[axis, 1] = min(limits[axis, 1] + rings, cells[axis])


@kernel
def _copy_window(sorted_points, keys, starts, cells, limits, window, near_keys):
    """Copy the points and keys of a window of cells; return how many there are, or -1 if they do not fit."""
    size = 0
    for x in range(limits[0, 0], limits[0, 1]):
        for y in range(limits[1, 0], limits[1, 1]):
            row = (x * cells[1] + y) * cells[2]
            start, stop = starts[row + limits[2, 0]], starts[row + limits[2, 1]]
            length = stop - start
            if size + length > window.shape[1]:
                return -1
            for axis in range(3):
                for i in range(length):
                    window[axis, size + i] = sorted_points[axis, start + i]
            for i in range(length):
                near_keys[size + i] = keys[start + i]
            size += length
    return size


@kernel
def _set_sides(limits, lower, side, cells, sides):
    """Write the coordinates between which the window holds all points; infinite where there are none beyond."""
    for axis in range(3):
        low, high = limits[axis, 0], limits[axis, 1]
        sides[axis, 0] = lower[axis] + side * (low + SAFETY) if low > 0 else -np.inf
        sides[axis, 1] = lower[axis] + side * (high - SAFETY) if high < cells[axis] else np.inf


@kernel
def _square_distances(window, size, x, y, z, distances):
    for i in range(size):
        dx, dy, dz = window[0, i] - x, window[1, i] - y, window[2, i] - z
        distances[i] = dx * dx + dy * dy + dz * dz


@kernel
def _count_up_to(bits, size, threshold):
    count = np.int32(0)
    for i in range(size):
        count = np.int32(count + (np.int32(1) if bits[i] <= threshold else np.int32(0)))
    return count


@kernel
def _largest_key(bits, size, threshold, keys):
    largest = np.int32(SMALLEST)
    for i in range(size):
        if bits[i] <= threshold and keys[i] > largest:
            largest = keys[i]
    return largest


@kernel
def _kth_smallest(bits, size, k, threshold, growth):
    """Return a number that is at least the `k`-th smallest of `bits` and less than the next larger one.

    The search starts at `threshold`; `size` is at least `k`.
    """
    low, high, count_high = np.int32(-1), np.int32(LARGEST), np.int32(size)
    for _ in range(STEPS):
        count = _count_up_to(bits, size, threshold)
        if count == k:
            return threshold
        if count > k:
            high, count_high = threshold, count
            if count - k <= CLOSE:
                break
        else:
            low = threshold
        threshold = np.int32(threshold + growth[k] - growth[min(count, COUNTS - 1)])
        if threshold <= low or threshold >= high:
            threshold = np.int32((np.int64(low) + np.int64(high)) // 2)
    while count_high > k:
        largest = _largest_key(bits, size, high, bits)
        count_high = _count_up_to(bits, size, np.int32(largest - 1))
        if count_high < k:
            return largest
        high = np.int32(largest - 1)
    return high


@kernel
def dilate_cells(sorted_points, keys, starts, cells, lower, side, k, growth, first, last, dilated, radii):
    """Write, for the points of cells `first` to `last`, the largest key among the `k` nearest points of each.

    Where `radii` is not empty, the squared distance of the `k`-th goes there, as the bits of a float32.
    """
    capacity = 1024
    window, near_keys = np.empty((3, capacity), np.float32), np.empty(capacity, np.int32)
    distances = np.empty(capacity, np.float32)
    bits = distances.view(np.int32)
    limits, sides = np.empty((3, 2), np.int64), np.empty((3, 2), np.float64)
    number = np.full(1, side * side, np.float32)
    number_bits = number.view(np.int32)
    threshold = number_bits[0]
    total = sorted_points.shape[1]
    xs, ys, zs = sorted_points[0], sorted_points[1], sorted_points[2]
    for cell in range(first, last):
        rings, size = 1, -1
        p = starts[cell]
        while p < starts[cell + 1]:
            if size < 0:
                _set_limits(cells, cell, rings, limits)
                size = _copy_window(sorted_points, keys, starts, cells, limits, window, near_keys)
                if size < 0:
                    capacity *= 2
                    window, near_keys = np.empty((3, capacity), np.float32), np.empty(capacity, np.int32)
                    distances = np.empty(capacity, np.float32)
                    bits = distances.view(np.int32)
                    continue
                _set_sides(limits, lower, side, cells, sides)
            if size >= k:
                x, y, z = xs[p], ys[p], zs[p]
                _square_distances(window, size, x, y, z, distances)
                threshold = _kth_smallest(bits, size, k, threshold, growth)
                reach = min(
                    min(min(x - sides[0, 0], sides[0, 1] - x), min(y - sides[1, 0], sides[1, 1] - y)),
                    min(z - sides[2, 0], sides[2, 1] - z),
                )
                number_bits[0] = threshold
                if size == total or (reach > 0 and number[0] <= reach * reach):
                    dilated[p] = _largest_key(bits, size, threshold, near_keys)
                    if len(radii):
                        radii[p] = _largest_key(bits, size, threshold, bits)
                    p += 1
                    continue
            rings, size = rings + 1, -1


@kernel
def spread_over_cells(sorted_points, keys, radii, starts, cells, side, first, last, spread):
    """Raise `spread`, at each point, to the largest key of those points whose structuring element holds it.

    Only points of cells `first` to `last` spread their keys. The structuring element of a point holds what lies
    within its squared radius, which is given as the bits of a float32.
    """
    limits = np.empty((3, 2), np.int64)
    number = np.empty(1, np.float32)
    number_bits = number.view(np.int32)
    xs, ys, zs = sorted_points[0], sorted_points[1], sorted_points[2]
    for cell in range(first, last):
        for p in range(starts[cell], starts[cell + 1]):
            number_bits[0] = radii[p]
            _set_limits(cells, cell, int(np.sqrt(number[0]) / side + 1 + SAFETY), limits)
            for x in range(limits[0, 0], limits[0, 1]):
                for y in range(limits[1, 0], limits[1, 1]):
                    row = (x * cells[1] + y) * cells[2]
                    for q in range(starts[row + limits[2, 0]], starts[row + limits[2, 1]]):
                        dx, dy, dz = xs[q] - xs[p], ys[q] - ys[p], zs[q] - zs[p]
                        number[0] = dx * dx + dy * dy + dz * dz
                        if number_bits[0] <= radii[p] and keys[p] > spread[q]:
                            spread[q] = keys[p]
