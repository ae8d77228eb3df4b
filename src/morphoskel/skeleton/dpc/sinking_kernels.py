"""Compiled search for inner points that meet a front from another direction.

Strategy. The inner points are sorted along one axis. Around each point only those are looked at that differ by less
than the radius along this axis, and the search ends with the first that meets. There is no grid to rebuild in every
step, and points that crowd together, as inner points do, cost no memory.
"""

import numpy as np

from morphoskel.compiled import kernel


@kernel
def _is_opposite(inner, directions, samples, i, j, radius, cosine, separation):
    """Tell whether `j` is near `i`, came from another direction, and did not start near it on the surface."""
    if (
        directions[i, 0] * directions[j, 0] + directions[i, 1] * directions[j, 1] + directions[i, 2] * directions[j, 2]
        >= cosine
    ):
        return False
    near, apart = 0.0, 0.0
    for axis in range(3):
        near += (inner[i, axis] - inner[j, axis]) ** 2
        apart += (samples[i, axis] - samples[j, axis]) ** 2
    return near <= radius * radius and apart >= separation * separation


@kernel
def opposite_fronts(inner, directions, samples, moving, axis, radius, cosine, separation):
    """Mark the moving points that meet another front; the arrays are sorted along `axis` of `inner`."""
    count = len(inner)
    met = np.zeros(count, np.bool_)
    for i in range(count):
        if not moving[i]:
            continue
        j = i + 1
        while j < count and inner[j, axis] - inner[i, axis] <= radius and not met[i]:
            met[i] = _is_opposite(inner, directions, samples, i, j, radius, cosine, separation)
            j += 1
        j = i - 1
        while j >= 0 and inner[i, axis] - inner[j, axis] <= radius and not met[i]:
            met[i] = _is_opposite(inner, directions, samples, i, j, radius, cosine, separation)
            j -= 1
    return met
