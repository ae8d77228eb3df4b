"""Voronoi cells: the samples that have a site as their nearest."""

from __future__ import annotations

import numpy as np

from morphoskel.shapes import FloatArray, IntArray


def assign_to_cells(samples: FloatArray, sites: FloatArray) -> IntArray:
    """Return the nearest site of every sample.

    Parameters
    ----------
    samples
        ``(S, 3)``.
    sites
        ``(N, 3)``; of coincident sites one takes all samples.

    Returns
    -------
    ndarray
        ``(S,)`` int64 indices into `sites`.
    """
    from scipy.spatial import cKDTree

    # A tree split at mid-points instead of medians is built faster, and it is built anew in every step.
    _, nearest = cKDTree(sites, balanced_tree=False, compact_nodes=False).query(samples)
    return np.asarray(nearest, dtype=np.int64)


def sum_in_cells(values: FloatArray, cells: IntArray, count: int) -> FloatArray:
    """Add up the rows of `values` cell by cell, in their order.

    Parameters
    ----------
    values
        ``(S, C)``, one row a sample.
    cells
        ``(S,)``, the cell of each sample.
    count
        Number of cells, N.

    Returns
    -------
    ndarray
        ``(N, C)`` float64; zero for an empty cell.
    """
    columns = [np.bincount(cells, weights=column, minlength=count) for column in values.T]
    return np.stack(columns, axis=1)
