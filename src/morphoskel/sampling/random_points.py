"""Choose points at random."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import IntArray


def random_points(available: int, count: int, generator: np.random.Generator) -> IntArray:
    """Choose points without replacement, every set of them equally likely.

    Parameters
    ----------
    available
        Number of points to choose from.
    count
        Number of points wanted, 1 to `available`.
    generator
        Source of randomness.

    Returns
    -------
    IntArray
        ``(count,)`` distinct indices in random order. Generators in the same state give nested choices: that of a
        smaller count is the first part of that of a larger one.

    Raises
    ------
    InputError
        If `count` is out of range.
    """
    if not 1 <= count <= available:
        raise InputError(f"count: expected 1 to {available}, the number of points, got {count}")
    return generator.permutation(available)[:count].astype(np.int64, copy=False)
