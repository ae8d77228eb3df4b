"""Dilation by a k-nearest-neighbour structuring element (paper, Eq. 5 and 6)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def dilation(
    points: npt.NDArray[np.float32], values: npt.NDArray[np.float32], k: int = 20, *, threads: int = 1
) -> npt.NDArray[np.float32]:
    r"""Return the largest value in the structuring element of each point.

    .. math:: \delta(f)(x) = \max_{y \in SE(x)} f(y), \qquad SE(x) = k\text{-NN}(x)

    The structuring element contains the point itself, so dilation never falls below the identity. Points exactly as
    far as the `k`-th all belong to it.

    Parameters
    ----------
    points
        ``(N, 3)`` float32, in any order.
    values
        ``(N,)`` float32.
    k
        Size of the structuring element, the point itself included; 20 in the paper. With fewer points than
        that, all of them.
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

    return StructuringElement(points, k, threads=threads).dilate(values)
