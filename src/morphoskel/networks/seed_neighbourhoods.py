"""Points around seeds on a surface, found in the Delaunay graph of its points.

Source: Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023, and the program released with it.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array
from scipy.spatial import Delaunay, QhullError, cKDTree

from morphoskel.errors import InputError
from morphoskel.networks.skeleton_aware_settings import Neighbourhood
from morphoskel.shapes import FloatArray, IntArray


def seed_neighbourhoods(
    points: FloatArray, seeds: IntArray, neighbours: int, kind: Neighbourhood, hops: int
) -> IntArray:
    """Find points around each seed.

    Parameters
    ----------
    points
        ``(N, 3)`` float.
    seeds
        ``(K,)`` int64, indices of points.
    neighbours
        Points wanted for each seed, itself included.
    kind
        ``"nearest"``: of all points. ``"delaunay"``: of the points within some edges of the seed in the graph of the
        Delaunay tetrahedra, which does not leap over the gap between two parts as soon as it is narrow.
    hops
        These edges; for a seed from where they lead to too few points, as many more as are needed.

    Returns
    -------
    IntArray
        ``(K, neighbours)`` int64, the seed first, then the others from near to far; of equally far ones the one of
        smallest index comes first.

    Raises
    ------
    InputError
        If there are fewer points than `neighbours`, or they have no Delaunay tetrahedra.
    """
    points = np.asarray(points, dtype=np.float64)
    if len(points) < neighbours:
        raise InputError(f"points: a neighbourhood of {neighbours} points needs as many, got {len(points)}")
    squared = ((points[seeds, None] - points) ** 2).sum(axis=-1)
    if kind == "delaunay":
        squared[~points_within_hops(delaunay_graph(points), seeds, neighbours, hops)] = np.inf
    squared[np.arange(len(seeds)), seeds] = -1  # first, also where points coincide
    return np.argsort(squared, axis=1, kind="stable")[:, :neighbours]


def delaunay_graph(points: FloatArray) -> csr_array:
    """Return which points are joined by an edge of the Delaunay tetrahedra.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.

    Returns
    -------
    csr_array
        ``(N, N)`` float32, symmetric, 1 at edges; connected. A point that is no corner of a tetrahedron, mostly since
        another one lies in the same place, is joined to the nearest corner. If all points lie in a plane, there are no
        tetrahedra; then those of slightly displaced points are taken (Qhull's option QJ, which always displaces alike).

    Raises
    ------
    InputError
        If not even displaced points have tetrahedra.
    """
    try:
        cells = Delaunay(points)
    except QhullError:
        try:
            cells = Delaunay(points, qhull_options="QJ Qbb")
        except QhullError as error:
            raise InputError(
                f"points: {len(points)} points without Delaunay tetrahedra, even when displaced; "
                "repair the cloud, or set neighbourhood to nearest"
            ) from error
    starts, ends = cells.vertex_neighbor_vertices
    degrees = np.diff(starts)
    corners, others = np.flatnonzero(degrees), np.flatnonzero(degrees == 0)
    joined = corners[cKDTree(points[corners]).query(points[others])[1]]
    rows = np.concatenate([np.repeat(np.arange(len(points)), degrees), others, joined])
    columns = np.concatenate([ends, joined, others])
    return csr_array((np.ones(len(rows), dtype=np.float32), (rows, columns)), shape=(len(points), len(points)))


def points_within_hops(graph: csr_array, seeds: IntArray, wanted: int, hops: int) -> npt.NDArray[np.bool_]:
    """Return which points few edges lead to.

    Parameters
    ----------
    graph
        ``(N, N)``, symmetric, connected, more than 0 at edges.
    seeds
        ``(K,)`` int64, where the walks start.
    wanted
        Points that each seed needs, itself included, at most N.
    hops
        Edges of a walk; more for a seed from where they lead to fewer points than `wanted`.

    Returns
    -------
    ndarray
        ``(K, N)`` bool.
    """
    reached = np.zeros((len(seeds), len(graph.indptr) - 1), dtype=bool)
    reached[np.arange(len(seeds)), seeds] = True
    walking = np.arange(len(seeds))
    step = 0
    while len(walking):
        reached[walking] |= (graph @ reached[walking].T.astype(np.float32)).T > 0
        step += 1
        if step >= hops:
            walking = np.flatnonzero(reached.sum(axis=1) < wanted)
    return reached
