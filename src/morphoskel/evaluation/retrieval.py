"""How well shapes of a class are found by their descriptors."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray

BLOCK = 256
"""Queries ranked at a time, which bounds the memory by a few times this many rows."""


def average_precisions(
    descriptors: npt.NDArray[np.floating], labels: npt.NDArray[np.int64], include_query: bool
) -> FloatArray:
    """Rank all shapes by their distance to each, and return the average precision of each ranking.

    Parameters
    ----------
    descriptors
        ``(S, D)`` float.
    labels
        ``(S,)`` int64. Shapes with the query's label are relevant.
    include_query
        Whether the query itself is ranked: first, always relevant, and also before others of the same descriptor. This
        is the usage of published tables of samplers, and it raises every number.

    Returns
    -------
    ndarray
        ``(S,)`` float64 in (0, 1]: the mean, over the relevant shapes, of the share of relevant shapes up to and with
        their rank. NaN where nothing is relevant: the query is left out and the only one of its class.

    Raises
    ------
    ValueError
        If there are not as many labels as descriptors, or one is not finite.

    Notes
    -----
    The order is that of the squared Euclidean distance, computed in float64; of equal distances the smaller index comes
    first. The published "macro mAP" is the plain mean over all queries.
    """
    vectors = np.asarray(descriptors, dtype=np.float64)
    if vectors.ndim != 2 or labels.shape != vectors.shape[:1]:
        raise ValueError(f"expected (S, D) descriptors and (S,) labels, got {vectors.shape} and {labels.shape}")
    if not np.isfinite(vectors).all():
        raise ValueError("descriptors: expected finite values")
    result = np.empty(len(vectors))
    for start in range(0, len(vectors), BLOCK):
        queries = np.arange(start, min(start + BLOCK, len(vectors)))
        order = _ranking(vectors, queries)
        relevant = labels[order] == labels[queries, None]
        if not include_query:
            relevant = relevant[:, 1:]
        result[queries] = _average_precision(relevant)
    return result


def _ranking(vectors: FloatArray, queries: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Return for each query the indices of all shapes, nearest first, the query itself at the head."""
    squares = (vectors**2).sum(axis=1)
    distances = squares - 2 * vectors[queries] @ vectors.T + squares[queries, None]
    distances[np.arange(len(queries)), queries] = -np.inf
    return np.argsort(distances, axis=1, kind="stable")


def _average_precision(relevant: npt.NDArray[np.bool_]) -> FloatArray:
    """Return the average precision of rankings ``(Q, S)``, NaN where nothing is relevant."""
    precision = np.cumsum(relevant, axis=1) / np.arange(1, relevant.shape[1] + 1)
    counts = relevant.sum(axis=1)
    totals = (precision * relevant).sum(axis=1)
    mean: FloatArray = np.divide(totals, counts, out=np.full(len(counts), np.nan), where=counts > 0)
    return mean
