"""Compiled passes over the edges of neighbour graphs, none of which keeps anything an edge.

The values of an edge from point `i` to its neighbour `j` are `values[j, :channels] + values[i, channels:]`: the first
half of the channels of a point is what it is to others, the second half what it adds to its own edges.
"""

import numpy as np

from morphoskel.compiled import kernel


@kernel
def _start(row, largest, winners, sums, squares, neighbour):
    for c in range(len(row)):
        largest[c] = row[c]
    winners[:] = neighbour
    sums[:] = 0
    squares[:] = 0


@kernel
def _raise_largest(row, neighbour, largest, winners):
    for c in range(len(row)):
        larger = row[c] > largest[c]
        largest[c] = row[c] if larger else largest[c]
        winners[c] = neighbour if larger else winners[c]


@kernel
def _add_moments(row, reference, sums, squares):
    for c in range(len(row)):
        difference = row[c] - reference[c]
        sums[c] += difference
        squares[c] += difference * difference


@kernel
def reduce_edges(values, neighbours, largest, winners, means, start, stop):
    """Write the largest value among the edges of each point and the point that it comes from, channel by channel.

    Unless `means` is empty, the means of the edges of each point go there. The answer is, for the points from `start`
    to `stop`, the sum of these means, of their squares, and of the squared differences of all edges from the mean of
    their point: ``(3, C)`` float64, zero without means. Squares of numbers that may be far from 0 are in float64 only.
    """
    channels, k = largest.shape[1], neighbours.shape[1]
    moments = np.zeros((3, channels))
    sums, squares = np.empty(channels, values.dtype), np.empty(channels, values.dtype)
    with_moments = len(means) > 0
    for i in range(start, stop):
        best, winner, own = largest[i], winners[i], values[i, channels:]
        reference = values[neighbours[i, 0], :channels]
        _start(reference, best, winner, sums, squares, np.int32(neighbours[i, 0]))
        for n in range(1, k):
            row = values[neighbours[i, n], :channels]
            _raise_largest(row, np.int32(neighbours[i, n]), best, winner)
            if with_moments:
                _add_moments(row, reference, sums, squares)
        if with_moments:
            mean = means[i]
            for c in range(channels):
                shift = sums[c] / k
                mean[c] = reference[c] + own[c] + shift
                exact = np.float64(mean[c])
                moments[0, c] += exact
                moments[1, c] += exact * exact
                moments[2, c] += squares[c] - shift * sums[c]
        for c in range(channels):
            best[c] += own[c]
    return moments


@kernel
def _add(row, total):
    for c in range(len(total)):
        total[c] += row[c]


@kernel
def spread_gradients(gradients, winners, values, neighbours, means, result, mean, to_mean, to_variance, start, stop):
    """Write the gradients with regard to the values, for the channels from `start` to `stop` of both their halves.

    Parameters
    ----------
    gradients
        With regard to the largest values.
    winners, means
        As written by :func:`reduce_edges`; where `means` is empty, the moments have no gradients.
    mean
        Of all edges, one a channel.
    to_mean, to_variance
        One a channel: the gradient of each edge through the mean, and through the variance for each unit of its
        difference from the mean.
    """
    points, channels, k = winners.shape[0], winners.shape[1], neighbours.shape[1]
    result[:, start:stop] = 0
    if len(means):
        mean, to_mean, to_variance = mean[start:stop], to_mean[start:stop], to_variance[start:stop]
        share, degrees = np.empty(stop - start, values.dtype), np.zeros(points, np.int64)
        for i in range(points):
            own = values[i, channels + start : channels + stop]
            for c in range(len(share)):
                share[c] = to_mean[c] + to_variance[c] * (own[c] - mean[c])
            for n in range(k):
                degrees[neighbours[i, n]] += 1
                _add(share, result[neighbours[i, n], start:stop])
        for j in range(points):
            row, total = values[j, start:stop], result[j, start:stop]
            for c in range(len(row)):
                total[c] += degrees[j] * (to_variance[c] * row[c])
    for i in range(points):
        gradient, winner = gradients[i, start:stop], winners[i, start:stop]
        own_result = result[i, channels + start : channels + stop]
        for c in range(len(gradient)):
            result[winner[c], start + c] += gradient[c]
            own_result[c] = gradient[c]
        if len(means):
            around = means[i, start:stop]
            for c in range(len(gradient)):
                own_result[c] += k * (to_mean[c] + to_variance[c] * (around[c] - mean[c]))
