"""How much the neighbourhood of a sample resembles a line (Huang et al., SIGGRAPH 2013, directionality degree σ)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, Samples

UNKNOWN = 0.5
"""Directionality where there are too few neighbours to tell."""

SURROUNDED = 0.95
"""Directionality of a sample whose neighbours are all on branches; so in the released program."""


def directionality(scatters: FloatArray) -> FloatArray:
    r"""Return the directionality of scatter matrices.

    .. math:: \sigma = \lambda_{max} / (\lambda_1 + \lambda_2 + \lambda_3)

    Parameters
    ----------
    scatters
        ``(N, 3, 3)`` float64, of the neighbours around each sample.

    Returns
    -------
    ndarray
        ``(N,)`` float64, from 1/3 to 1; 0.5 where all neighbours coincide with the sample.
    """
    eigenvalues = np.linalg.eigvalsh(scatters)
    sums = eigenvalues.sum(axis=1)
    known = sums > 0
    return np.where(known, eigenvalues[:, -1] / np.where(known, sums, 1), UNKNOWN)


def update_smoothed_directionality(samples: Samples, neighbours: int) -> None:
    """Set the directionality of all samples from their nearest ones, averaged once over these.

    Neighbours on branches do not contribute to the scatter, so that what is left next to a branch does not seem to
    continue it.

    Parameters
    ----------
    samples
        Changed in place.
    neighbours
        Nearest samples, without the sample itself.
    """
    live = samples.indices(MOVING, FIXED)
    nearest = nearest_samples(samples.points[live], neighbours)
    if nearest.shape[1] <= 3:
        samples.directionality[live] = UNKNOWN
        return
    counted = samples.states[live][nearest] == MOVING
    offsets = (samples.points[live][nearest] - samples.points[live][:, None]) * counted[..., None]
    scatters: FloatArray = np.einsum("nki,nkj->nij", offsets, offsets)
    raw = np.where(counted.sum(axis=1) < 3, SURROUNDED, directionality(scatters))
    samples.directionality[live] = (raw + raw[nearest].sum(axis=1)) / (nearest.shape[1] + 1)


def nearest_samples(points: FloatArray, count: int) -> npt.NDArray[np.int64]:
    """Return the indices of the nearest other points, nearest first.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.
    count
        Neighbours of each, without the point itself; fewer if there are no more.

    Returns
    -------
    ndarray
        ``(N, min(count, N - 1))`` int64.
    """
    from scipy.spatial import cKDTree

    count = min(count, len(points) - 1)
    if count < 1:
        return np.empty((len(points), 0), dtype=np.int64)
    found = np.asarray(cKDTree(points).query(points, k=count + 1)[1], dtype=np.int64)
    # Among coinciding points the search need not return the point itself first, or at all.
    is_self = found == np.arange(len(points))[:, None]
    is_self[~is_self.any(axis=1), -1] = True
    others: npt.NDArray[np.int64] = found[~is_self].reshape(len(points), count)
    return others
