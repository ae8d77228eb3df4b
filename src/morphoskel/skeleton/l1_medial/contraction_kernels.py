"""Compiled sums over the neighbourhoods of the samples.

Strategy. All pairs are visited: neighbourhoods grow until they hold the whole shape, so a search structure would gain
little. Each sample has two passes over its neighbours. The first writes the weights; it has no branches and no sums,
so that the compiler turns it into vector instructions. The second adds them up in order.
"""

import numpy as np

from morphoskel.compiled import kernel

SHARPNESS = 4.0
"""The Gaussian is exp(-4 (distance / radius)²)."""

CLOSEST = 1e-3
"""Distances are taken to be at least this share of the radius before anything is divided by them."""


@kernel
def write_gaussians(place, columns, radius, squares, gaussians):
    """Write the squared distances of points, in `columns` (3, N), from a place, and the Gaussian of those in reach.

    The exponential function is the 16th power of eight terms of its series, exact to 1e-9 in the range that occurs.
    """
    reach = radius * radius
    x, y, z = place[0], place[1], place[2]
    scale = -SHARPNESS / (16 * reach)
    for point in range(columns.shape[1]):
        dx, dy, dz = columns[0, point] - x, columns[1, point] - y, columns[2, point] - z
        square = dx * dx + dy * dy + dz * dz
        t = scale * square
        # Horner's scheme; multiplying by constants is much faster than dividing by them.
        root = 1 + t * (1 / 7) * (1 + t * (1 / 8))
        root = 1 + t * (1 / 4) * (1 + t * (1 / 5) * (1 + t * (1 / 6) * root))
        root = 1 + t * (1 + t * (1 / 2) * (1 + t * (1 / 3) * root))
        root = root * root
        root = root * root
        root = root * root
        squares[point] = square
        gaussians[point] = root * root if square < reach else 0.0


@kernel
def averages(samples, columns, weights, radius, power):
    """Return the weighted mean of the points around each sample, or the sample where there is no point.

    The points are given as `columns` (3, N).
    """
    means = samples.copy()
    squares, gaussians = np.empty(columns.shape[1]), np.empty(columns.shape[1])
    for sample in range(len(samples)):
        write_gaussians(samples[sample], columns, radius, squares, gaussians)
        if power < 2:
            for point in range(len(squares)):
                length = max(np.sqrt(squares[point]), CLOSEST * radius)
                gaussians[point] /= length if power == 1 else length ** (2 - power)
        total, x, y, z = 0.0, 0.0, 0.0, 0.0
        for point in range(len(squares)):
            weight = gaussians[point] * weights[point]
            total += weight
            x += weight * columns[0, point]
            y += weight * columns[1, point]
            z += weight * columns[2, point]
        if total > 0:
            means[sample, 0], means[sample, 1], means[sample, 2] = x / total, y / total, z / total
    return means


@kernel
def densities(columns, radius):
    """Return the sum of the Gaussian over the points, `columns` (3, N), around each of them, itself included."""
    count = columns.shape[1]
    sums, squares, gaussians = np.zeros(count), np.empty(count), np.empty(count)
    for point in range(count):
        write_gaussians(columns[:, point], columns, radius, squares, gaussians)
        for other in range(count):
            sums[point] += gaussians[other]
    return sums


@kernel
def repulsions(columns, radius, power):
    """Return the mean push on each sample, the scatter of its neighbours around it, and how many there are.

    The samples are given as `columns` (3, N).
    """
    count = columns.shape[1]
    pushes, scatters, counts = np.zeros((count, 3)), np.zeros((count, 3, 3)), np.zeros(count, np.int64)
    squares, gaussians = np.empty(count), np.empty(count)
    for sample in range(count):
        write_gaussians(columns[:, sample], columns, radius, squares, gaussians)
        gaussians[sample] = 0
        total = 0.0
        for other in range(count):
            gaussian = gaussians[other]
            if gaussian == 0:
                continue
            counts[sample] += 1
            dx = columns[0, sample] - columns[0, other]
            dy = columns[1, sample] - columns[1, other]
            dz = columns[2, sample] - columns[2, other]
            scatters[sample, 0, 0] += gaussian * dx * dx
            scatters[sample, 1, 1] += gaussian * dy * dy
            scatters[sample, 2, 2] += gaussian * dz * dz
            scatters[sample, 0, 1] += gaussian * dx * dy
            scatters[sample, 0, 2] += gaussian * dx * dz
            scatters[sample, 1, 2] += gaussian * dy * dz
            length = max(np.sqrt(squares[other]), CLOSEST * radius)
            weight = gaussian / (length if power == 1 else length**power)
            total += weight
            pushes[sample, 0] += weight * dx
            pushes[sample, 1] += weight * dy
            pushes[sample, 2] += weight * dz
        if total > 0:
            for axis in range(3):
                pushes[sample, axis] /= total
        scatters[sample, 1, 0] = scatters[sample, 0, 1]
        scatters[sample, 2, 0] = scatters[sample, 0, 2]
        scatters[sample, 2, 1] = scatters[sample, 1, 2]
    return pushes, scatters, counts
