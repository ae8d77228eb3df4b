"""Dilation by a k-nearest-neighbour structuring element (paper, Eq. 5 and 6)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError

CHUNK_POINTS = 1 << 16
"""Points whose neighbours are held at once: 10 MB of indices at k = 20, whatever the number of points."""


def dilation(
    points: npt.NDArray[np.float32], values: npt.NDArray[np.float32], k: int = 20, *, threads: int = 1
) -> npt.NDArray[np.float32]:
    r"""Return the largest value among the `k` nearest points of each point.

    .. math:: \delta(f)(x) = \max_{y \in SE(x)} f(y), \qquad SE(x) = k\text{-NN}(x)

    The structuring element contains the point itself, so dilation never falls below the identity. Points that are
    equally far as the k-th may or may not belong to it.

    Parameters
    ----------
    points
        ``(N, 3)`` float32; spatial order makes this two to three times faster.
    values
        ``(N,)`` float32.
    k
        Size of the structuring element, the point itself included; 20 in the paper. With fewer points than
        that, all of them.
    threads
        Threads of the neighbour search.

    Returns
    -------
    ndarray
        ``(N,)`` float32.

    Raises
    ------
    InputError
        If the arrays do not match, or `k` is not positive.
    """
    from scipy.spatial import cKDTree

    if points.ndim != 2 or values.shape != (len(points),):
        raise InputError(f"dilation: expected points (N, 3) and values (N,), got {points.shape} and {values.shape}")
    if k < 1:
        raise InputError(f"dilation: the structuring element needs k >= 1 points, got k = {k}")
    dilated = values.copy()
    if len(points) == 0:
        return dilated
    tree = cKDTree(points)
    for start in range(0, len(points), CHUNK_POINTS):
        chunk = slice(start, start + CHUNK_POINTS)
        _, neighbours = tree.query(points[chunk], k=min(k, len(points)), workers=threads)
        element = values[neighbours.reshape(len(points[chunk]), -1)]
        # The point itself belongs to its structuring element even where more than k points coincide with it.
        np.maximum(values[chunk], element.max(axis=1), out=dilated[chunk])
    return dilated
