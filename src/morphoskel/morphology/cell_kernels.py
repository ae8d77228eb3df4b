"""Compiled sorting of points into cubic cells."""

import numpy as np

from morphoskel.compiled import kernel


@kernel
def bounds(points):
    """Return the lower and upper corners, ``(2, 3)`` float64, of the points' box; NaN if a coordinate is not finite."""
    corners = np.empty((2, 3))
    for axis in range(3):
        low, high, sum_of_zeros = points[0, axis], points[0, axis], np.float32(0)
        for p in range(len(points)):
            at = points[p, axis]
            low, high = min(low, at), max(high, at)
            sum_of_zeros += at - at
        corners[0, axis] = low + sum_of_zeros
        corners[1, axis] = high + sum_of_zeros
    return corners


@kernel
def cell_numbers(points, lower, side, cells, numbers, start, stop):
    """Write the number of the cell that holds each point from `start` to `stop`; z runs fastest."""
    per_side = 1 / side
    for p in range(start, stop):
        number = 0
        for axis in range(3):
            along = int((points[p, axis] - lower[axis]) * per_side)
            number = number * cells[axis] + min(along, cells[axis] - 1)
        numbers[p] = number


@kernel
def count_points(numbers, count):
    """Return the number of points in each of `count` cells, at positions one further, ``(count + 1,)`` int64."""
    counts = np.zeros(count + 1, np.int64)
    for number in numbers:
        counts[number + 1] += 1
    return counts


@kernel
def sort_into_cells(numbers, starts):
    """Return the points in the order of their cells, ``(N,)`` int32, where the first of each cell is to be put."""
    following = starts[:-1].copy()
    order = np.empty(len(numbers), np.int32)
    for p in range(len(numbers)):
        order[following[numbers[p]]] = p
        following[numbers[p]] += 1
    return order


@kernel
def take(points, order, sorted_points, start, stop):
    """Write the points from `start` to `stop` of the order, one axis after the other."""
    for p in range(start, stop):
        for axis in range(3):
            sorted_points[axis, p] = points[order[p], axis]
