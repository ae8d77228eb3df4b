"""Compiled selection of the smallest numbers of many rows.

Strategy. A row is read as a table of some columns. The smallest number of each column, found by a vector loop, says
almost everything: the `k`-th smallest of these minima is a bound that at least `k` numbers do not exceed, and few more
than `k` do not. Only columns whose minimum does not exceed it are looked at again. The `k`-th smallest minimum is found
by counting, for each minimum, those below it, which is a vector loop, too, and needs no branches.
"""

import numpy as np

from morphoskel.compiled import kernel

FEWEST_COLUMNS = 64
COLUMNS_PER_NUMBER = 3
"""Columns for each number wanted: with more the bound is tighter, but more minima are compared with each other."""


@kernel
def _column_minima(row, minima):
    columns = len(minima)
    minima[:] = row[:columns]
    for first in range(columns, len(row), columns):
        part = row[first : min(first + columns, len(row))]
        for column in range(len(part)):
            minima[column] = min(part[column], minima[column])


@kernel
def _kth_smallest(minima, k, below):
    """Return the `k`-th smallest; `below` is room for how many minima are below each."""
    below[:] = 0
    for other in range(len(minima)):
        number = minima[other]
        for column in range(len(below)):
            below[column] += np.int32(1) if number < minima[column] else np.int32(0)
    kth = minima[0]
    most = np.int32(-1)
    for column in range(len(minima)):
        if most < below[column] < k:
            most = below[column]
            kth = minima[column]
    return kth


@kernel
def _insert(number, position, numbers, positions, size):
    """Put a number into the first `size` of an ascending list, equal ones by position; return the new size."""
    if size == len(numbers):
        last = size - 1
        if number > numbers[last] or (number == numbers[last] and position > positions[last]):
            return size
        size = last
    at = size
    while at > 0 and (number < numbers[at - 1] or (number == numbers[at - 1] and position < positions[at - 1])):
        numbers[at] = numbers[at - 1]
        positions[at] = positions[at - 1]
        at -= 1
    numbers[at] = number
    positions[at] = position
    return size + 1


@kernel
def select_smallest(rows, chosen, start, stop):
    """Write the positions of the smallest numbers of the rows from `start` to `stop`, smallest first; return if found.

    As many are taken as `chosen` has columns, at most the length of a row. Of equal numbers those of smallest position
    are taken. Rows with numbers that are not finite may have no answer.
    """
    count, k = rows.shape[1], chosen.shape[1]
    columns = min(count, max(COLUMNS_PER_NUMBER * k, FEWEST_COLUMNS))
    minima, below = np.empty(columns, rows.dtype), np.empty(columns, np.int32)
    candidates, numbers = np.empty(count, np.int64), np.empty(k, rows.dtype)
    for r in range(start, stop):
        row, positions = rows[r], chosen[r]
        _column_minima(row, minima)
        bound = _kth_smallest(minima, k, below)
        found = 0
        for column in range(columns):
            if minima[column] <= bound:
                for position in range(column, count, columns):
                    candidates[found] = position
                    found += 1 if row[position] <= bound else 0
        if found < k:
            return False
        size = 0
        for c in range(found):
            size = _insert(row[candidates[c]], candidates[c], numbers, positions, size)
    return True
