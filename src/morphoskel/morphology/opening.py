"""Opening by a k-nearest-neighbour structuring element."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def opening(
    points: npt.NDArray[np.float32], values: npt.NDArray[np.float32], k: int = 20, *, threads: int = 1
) -> npt.NDArray[np.float32]:
    r"""Return the largest function below `values` that is a union of structuring elements: peaks are cut off.

    .. math:: \gamma(f) = \delta^{*}(\varepsilon(f)), \qquad
        \delta^{*}(g)(y) = \max_{x \,:\, y \in SE(x)} g(x)

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
        ``(N,)`` float32, at most `values`; opening it again changes nothing.

    Raises
    ------
    InputError
        If the arrays do not match or are not finite, or `k` is not positive.

    Notes
    -----
    Nearness is not mutual: `y` may be among the nearest of `x`, yet `x` not among the nearest of `y`. An erosion
    followed by the dilation over the *same* neighbourhoods, as in the published program, is therefore no opening: it
    exceeds the function in places and is not idempotent. The dilation must be the erosion's adjoint.
    """
    from morphoskel.morphology.structuring_element import StructuringElement

    element = StructuringElement(points, k, threads=threads)
    return element.spread(element.erode(values))
