"""Turn generated points into points of the cloud: nearest ones first, completed by the farthest ones.

Source: Dovrat et al., *Learning to Sample*, CVPR 2019, "matching"; the same step ends the inference of
SampleNet (Lang et al., CVPR 2020) and Meta-Sampler (Cheng et al., ECCV 2022).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray

Coordinates = npt.NDArray[np.floating[Any]]


class Matching(NamedTuple):
    """The points of one cloud that stand for its generated points.

    Parameters
    ----------
    indices
        ``(M,)`` int64, distinct. The first `matched` are nearest neighbours of generated points, the others were
        added by farthest-point sampling.
    matched
        Number of distinct nearest neighbours, 1 to M.
    """

    indices: IntArray
    matched: int


class CloudMatchings(NamedTuple):
    """A :class:`Matching` of each of S clouds.

    Parameters
    ----------
    indices
        ``(S, M)`` int64, distinct within a row.
    matched
        ``(S,)`` int64.
    """

    indices: IntArray
    matched: IntArray


def match(points: Coordinates, generated: Coordinates) -> IntArray:
    """Return the points that are nearest to the generated ones, each once.

    Parameters
    ----------
    points, generated
        ``(N, 3)`` and ``(M, 3)`` floats, finite, in the same units; N and M at least 1.

    Returns
    -------
    IntArray
        ``(1 to M,)`` distinct indices into `points`, in the order in which they first occur. Of equally near points
        the one with the smallest index is taken.

    Raises
    ------
    InputError
        If an array has the wrong shape or a coordinate is not finite.
    """
    axes = np.ascontiguousarray(_check(points, "points").T)
    # One row at a time stays in the cache, which the table of all pairs would not.
    nearest = np.array([_squared_distances(axes, query).argmin() for query in _check(generated, "generated")])
    _, first = np.unique(nearest, return_index=True)
    return nearest[np.sort(first)]


def complete(points: Coordinates, chosen: IntArray, count: int) -> IntArray:
    """Add points to a choice, each the farthest from all that were chosen before.

    Parameters
    ----------
    points
        ``(N, 3)`` floats, finite.
    chosen
        ``(C,)`` distinct indices to begin with. If there are none, point 0 is the first one.
    count
        Points wanted, C to N.

    Returns
    -------
    IntArray
        ``(count,)`` distinct indices, `chosen` first; distinct also where points coincide. Any first part that holds
        `chosen` is the answer for a smaller count. Of equally far points the one with the smallest index is taken.

    Raises
    ------
    InputError
        If `points` has the wrong shape, `chosen` is not a list of distinct indices, or `count` is out of range.
    """
    points = _check(points, "points")
    chosen = np.asarray(chosen)
    _check_choice(chosen, len(points), count)
    axes = np.ascontiguousarray(points.T)
    squared = np.full(len(points), np.inf)
    result = np.empty(count, dtype=np.int64)
    result[: len(chosen)] = chosen
    for place in range(count):
        if place >= len(chosen):
            result[place] = squared.argmax()  # point 0 as long as nothing is chosen: all are infinitely far
        index = result[place]
        np.minimum(squared, _squared_distances(axes, points[index]), out=squared)
        squared[index] = -1  # never again, also where another point coincides
    return result


def match_and_complete(points: Coordinates, generated: Coordinates) -> Matching:
    """Return as many distinct points of a cloud as were generated: :func:`match`, then :func:`complete`.

    Parameters
    ----------
    points, generated
        ``(N, 3)`` and ``(M, 3)`` floats, finite, in the same units; M at most N.

    Returns
    -------
    Matching
        The indices, and how many of them are matches.

    Raises
    ------
    InputError
        As :func:`match`, or if M exceeds N.
    """
    matched = match(points, generated)
    return Matching(complete(points, matched, len(generated)), len(matched))


def match_clouds(points: Coordinates, generated: Coordinates) -> CloudMatchings:
    """Do :func:`match_and_complete` for each of several clouds.

    Parameters
    ----------
    points, generated
        ``(S, N, 3)`` and ``(S, M, 3)`` floats, finite; M at most N, S at least 1.

    Returns
    -------
    CloudMatchings
        ``(S, M)`` indices and ``(S,)`` numbers of matches.

    Raises
    ------
    InputError
        If the numbers of clouds differ or are 0, and as :func:`match_and_complete`.
    """
    if len(points) != len(generated) or len(points) == 0:
        raise InputError(
            f"expected generated points for each of at least one cloud, got {len(points)} clouds and "
            f"{len(generated)} sets of generated points"
        )
    matchings = [match_and_complete(*pair) for pair in zip(points, generated, strict=True)]
    return CloudMatchings(
        np.stack([matching.indices for matching in matchings]), np.array([matching.matched for matching in matchings])
    )


def _squared_distances(axes: FloatArray, query: FloatArray) -> FloatArray:
    """Return ``(N,)`` from points given as ``(3, N)``, summed in one order: the same numbers on every machine."""
    x, y, z = axes
    dx, dy, dz = x - query[0], y - query[1], z - query[2]
    squared: FloatArray = dx * dx + dy * dy + dz * dz
    return squared


def _check(points: Coordinates, name: str) -> FloatArray:
    checked = np.asarray(points, dtype=np.float64)
    if checked.ndim != 2 or checked.shape[1] != 3 or len(checked) == 0:
        raise InputError(f"{name}: expected shape (N, 3) with N >= 1, got {checked.shape}")
    if not np.isfinite(checked).all():
        raise InputError(f"{name}: every coordinate must be finite")
    return checked


def _check_choice(chosen: IntArray, available: int, count: int) -> None:
    if chosen.ndim != 1 or chosen.dtype.kind != "i" or len(np.unique(chosen)) != len(chosen):
        raise InputError(f"chosen: expected distinct integers, got shape {chosen.shape} of {chosen.dtype}")
    if ((chosen < 0) | (chosen >= available)).any():
        raise InputError(f"chosen: expected indices from 0 to {available - 1}")
    least = max(len(chosen), 1)
    if not least <= count <= available:
        raise InputError(
            f"count: expected {least} to {available}, the numbers of chosen and of all points, got {count}"
        )
