"""Compiled sums over the neighbours of each inner point.

Strategy. The inner points are sorted along one axis. Around each point only those are looked at that differ by less
than the range of the sum along this axis. Nothing is stored for a pair, so points that crowd together cost no memory.
The results have the order of the sorted points.
"""

import numpy as np

from morphoskel.compiled import kernel


@kernel
def _range_along(inner, i, axis, reach):
    """Return the first and, exclusive, the last point that is at most `reach` away from `i` along `axis`."""
    first, last = i, i + 1
    while first > 0 and inner[i, axis] - inner[first - 1, axis] <= reach:
        first -= 1
    while last < len(inner) and inner[last, axis] - inner[i, axis] <= reach:
        last += 1
    return first, last


@kernel
def averages(inner, axis, radius):
    """Return the weighted mean and the scatter matrix about each point, and the number of its neighbours."""
    count = len(inner)
    means, scatters = np.zeros((count, 3)), np.zeros((count, 3, 3))
    neighbours = np.zeros(count, np.int64)
    difference = np.empty(3)
    for i in range(count):
        first, last = _range_along(inner, i, axis, radius)
        total = 0.0
        for j in range(first, last):
            square = 0.0
            for a in range(3):
                difference[a] = inner[j, a] - inner[i, a]
                square += difference[a] ** 2
            if square > radius * radius:
                continue
            weight = np.exp(-4.0 * square / (radius * radius))
            total += weight
            neighbours[i] += 1 if j != i else 0
            for a in range(3):
                means[i, a] += weight * inner[j, a]
                for b in range(3):
                    scatters[i, a, b] += weight * difference[a] * difference[b]
        for a in range(3):
            means[i, a] /= total  # the point itself counts 1
    return means, scatters, neighbours


@kernel
def alignments(inner, links, axes, axis, radius):
    """Return, for the axes ``axes[i, :, k]``, the sum of ``|link . axis|`` over each point and its neighbours."""
    count = len(inner)
    sums = np.zeros((count, 3))
    for i in range(count):
        first, last = _range_along(inner, i, axis, radius)
        for j in range(first, last):
            square = 0.0
            for a in range(3):
                square += (inner[j, a] - inner[i, a]) ** 2
            if square > radius * radius:
                continue
            for k in range(3):
                along = 0.0
                for a in range(3):
                    along += links[j, a] * axes[i, a, k]
                sums[i, k] += abs(along)
    return sums


@kernel
def repulsions(inner, axes, half_sides, scales, axis, radius, power):
    """Return the weighted mean of the differences to the points in a box, along each of its axes.

    A difference is damped by ``exp(-4 d² / radius²)``, where ``d`` is measured with each axis divided by its scale,
    and weighted by the reciprocal Euclidean distance to a power.
    """
    count = len(inner)
    pushes = np.zeros((count, 3))
    along = np.empty(3)
    for i in range(count):
        reach = 0.0
        for k in range(3):
            reach += half_sides[i, k] * abs(axes[i, axis, k])
        first, last = _range_along(inner, i, axis, reach)
        total = 0.0
        for j in range(first, last):
            outside = j == i
            square, damped = 0.0, 0.0
            for k in range(3):
                along[k] = 0.0
                for a in range(3):
                    along[k] += (inner[i, a] - inner[j, a]) * axes[i, a, k]
                outside = outside or abs(along[k]) >= half_sides[i, k]
                square += along[k] ** 2
                damped += (along[k] / scales[i, k]) ** 2
            if outside:
                continue
            distance = max(np.sqrt(square), 1e-3 * radius)
            weight = np.exp(-4.0 * damped / (radius * radius)) * (radius / distance) ** power
            total += weight
            for k in range(3):
                pushes[i, k] += weight * along[k]
        if total > 0.0:
            for k in range(3):
                pushes[i, k] /= total
    return pushes
