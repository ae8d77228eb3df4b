"""Erosion by a k-nearest-neighbour structuring element."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def erosion(
    points: npt.NDArray[np.float32], values: npt.NDArray[np.float32], k: int = 20, *, threads: int = 1
) -> npt.NDArray[np.float32]:
    r"""Return the smallest value in the structuring element of each point.

    .. math:: \varepsilon(f)(x) = \min_{y \in SE(x)} f(y) = -\delta(-f)(x)

    Parameters
    ----------
    points
        ``(N, 3)`` float32, in any order.
    values
        ``(N,)`` float32.
    k
        Size of the structuring element, the point itself included.
    threads
        Threads of the neighbour search. Does not change the result.

    Returns
    -------
    ndarray
        ``(N,)`` float32.

    Raises
    ------
    InputError
        If the arrays do not match or are not finite, or `k` is not positive.
    """
    from morphoskel.morphology.structuring_element import StructuringElement

    return StructuringElement(points, k, threads=threads).erode(values)
