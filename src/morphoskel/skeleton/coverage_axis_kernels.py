"""Compiled greedy choice of the balls that cover a surface.

Strategy. Which ball reaches which sample is never stored. A sample is covered once, and then all candidates are asked
once whether they reach it; so the whole choice costs each pair of candidate and sample two distances, one to count and
one to take away, and no memory.
"""

import numpy as np

from morphoskel.compiled import kernel


@kernel
def _squared_distance(first, second):
    """Return the squared distance between two points, the same number whichever comes first."""
    dx, dy, dz = first[0] - second[0], first[1] - second[1], first[2] - second[2]
    return dx * dx + dy * dy + dz * dz


@kernel
def _mean_and_deviation(values):
    """Return the mean and the sample standard deviation; the latter is infinite where the values are all equal."""
    mean = 0.0
    for value in values:
        mean += value
    mean /= len(values)
    total = 0.0
    constant = True
    for value in values:
        total += (value - mean) ** 2
        constant &= value == values[0]
    return mean, np.inf if constant else np.sqrt(total / (len(values) - 1))


@kernel
def standardise(values):
    """Return the values minus their mean, over their sample standard deviation; 0 where they are all equal."""
    mean, deviation = _mean_and_deviation(values)
    return (values - mean) / deviation


@kernel
def choose(samples, candidates, reaches, penalties, stop_when_covered, chosen):
    """Fill `chosen` with the indices of candidates, best score first; return how many were needed."""
    gains = np.zeros(len(candidates), np.int64)  # uncovered samples within reach
    for c in range(len(candidates)):
        for s in range(len(samples)):
            gains[c] += _squared_distance(candidates[c], samples[s]) < reaches[c] * reaches[c]
    uncovered = np.ones(len(samples), np.bool_)
    free = np.ones(len(candidates), np.bool_)
    gaps = np.full(len(candidates), np.inf)  # to the nearest chosen candidate
    for count in range(len(chosen)):
        if stop_when_covered and gains.max() == 0:
            return count
        gain_mean, gain_deviation = _mean_and_deviation(gains)
        gap_mean, gap_deviation = _mean_and_deviation(gaps) if count else (0.0, 1.0)
        best, best_score = -1, -np.inf
        for c in range(len(candidates)):
            if not free[c]:
                continue
            score = (gains[c] - gain_mean) / gain_deviation - penalties[c]
            if count:
                score += (gaps[c] - gap_mean) / gap_deviation
            if best < 0 or score > best_score:
                best, best_score = c, score
        chosen[count] = best
        free[best] = False
        for c in range(len(candidates)):
            gaps[c] = min(gaps[c], np.sqrt(_squared_distance(candidates[c], candidates[best])))
        for s in range(len(samples)):
            if uncovered[s] and _squared_distance(candidates[best], samples[s]) < reaches[best] * reaches[best]:
                uncovered[s] = False
                for c in range(len(candidates)):
                    gains[c] -= _squared_distance(candidates[c], samples[s]) < reaches[c] * reaches[c]
    return len(chosen)
