"""Pick the centres of maximal balls among the inner points (paper, Eq. 7)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.morphology.residue import residue
from morphoskel.shapes import Skeleton


def select_smallest_residues(
    residues: npt.NDArray[np.float32], udf: npt.NDArray[np.float32], count: int
) -> npt.NDArray[np.int64]:
    """Return the indices of the `count` smallest residues.

    Ties, frequent on a grid and on flat parts where many residues are exactly 0, go to the larger ball, then to the
    smaller index, so that the choice does not depend on a library's sorting.

    Parameters
    ----------
    residues
        ``(N,)`` float32, dilation minus UDF.
    udf
        ``(N,)`` float32, ball radii.
    count
        Number of points wanted; with fewer inner points, all of them are returned.

    Returns
    -------
    ndarray
        ``(min(count, N),)`` int64, smallest residue first.
    """
    count = min(count, len(residues))
    if count == 0:
        return np.empty(0, dtype=np.int64)
    threshold = np.partition(residues, count - 1)[count - 1]
    contenders = np.flatnonzero(residues <= threshold)
    order = np.lexsort((contenders, -udf[contenders], residues[contenders]))
    selected: npt.NDArray[np.int64] = contenders[order[:count]]
    return selected


def skeleton_of(
    inner: npt.NDArray[np.float32],
    udf: npt.NDArray[np.float32],
    dilated: npt.NDArray[np.float32],
    points: int,
) -> Skeleton:
    """Keep the inner points of smallest residue.

    Parameters
    ----------
    inner
        ``(M, 3)`` float32.
    udf, dilated
        ``(M,)`` float32, the distance function and its dilation.
    points
        Number kept.

    Returns
    -------
    Skeleton
        Smallest residue first.
    """
    residues = residue(udf, dilated)
    chosen = select_smallest_residues(residues, udf, points)
    centres, radii, kept = (array[chosen].astype(np.float64) for array in (inner, udf, residues))
    return Skeleton(centres, radii, kept)
