"""Distances from points to segments and triangles, exact, for the few hundred pieces of a skeletal mesh."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray, IntArray

BLOCK = 256
"""Points a block, so that the intermediate arrays stay small."""


def segment_distances(points: FloatArray, vertices: FloatArray, segments: IntArray) -> FloatArray:
    """Return the distance of each point to each segment.

    Parameters
    ----------
    points, vertices
        ``(N, 3)`` and ``(V, 3)`` float64, in the same units.
    segments
        ``(S, 2)`` int64 indices into the vertices; the two ends may coincide.

    Returns
    -------
    ndarray
        ``(N, S)`` float64.
    """
    start = vertices[segments[:, 0]]
    along = vertices[segments[:, 1]] - start
    length = (along**2).sum(axis=1)
    length[length == 0] = 1  # both ends coincide: any position along the segment is the same point
    offset = points[:, None] - start
    position = np.clip((offset * along).sum(axis=2) / length, 0, 1)
    distances: FloatArray = np.linalg.norm(offset - position[..., None] * along, axis=2)
    return distances


def nearest_pieces(
    points: FloatArray, vertices: FloatArray, edges: IntArray, triangles: IntArray
) -> tuple[FloatArray, IntArray]:
    """Find the nearest of all edges and triangles to each point.

    Parameters
    ----------
    points, vertices
        ``(N, 3)`` and ``(V, 3)`` float64, in the same units.
    edges, triangles
        ``(E, 2)`` and ``(T, 3)`` int64 indices into the vertices, at least one edge or triangle. Pieces without extent
        are allowed.

    Returns
    -------
    tuple of ndarray
        The distance, ``(N,)`` float64, and the index of the piece, ``(N,)`` int64, counting the edges first, then the
        triangles. Of equally near pieces the first one is returned.
    """
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    segments, side_of = np.unique(sides, axis=0, return_inverse=True)
    segments = np.concatenate([edges, segments])
    side_of = side_of.reshape(-1, 3) + len(edges)
    distances, pieces = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
    for first in range(0, len(points), BLOCK):
        block = slice(first, first + BLOCK)
        to_segments = segment_distances(points[block], vertices, segments)
        to_triangles = np.minimum(
            to_segments[:, side_of].min(axis=2), _interior_distances(points[block], vertices[triangles])
        )
        to_pieces = np.concatenate([to_segments[:, : len(edges)], to_triangles], axis=1)
        pieces[block] = to_pieces.argmin(axis=1)
        distances[block] = to_pieces.min(axis=1)
    return distances, pieces


def _interior_distances(points: FloatArray, corners: FloatArray) -> npt.NDArray[np.float64]:
    """Return the distance of each point to each triangle's plane, infinite where it does not project into it."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(first, second)
    square = (normal**2).sum(axis=1)
    flat = square == 0
    square[flat] = 1
    offset = points[:, None] - corners[:, 0]
    # Barycentric coordinates of the projection, each the share of the area that the opposite corner spans.
    along_first = (np.cross(offset, second) * normal).sum(axis=2) / square
    along_second = (np.cross(first, offset) * normal).sum(axis=2) / square
    outside = (along_first < 0) | (along_second < 0) | (along_first + along_second > 1) | flat
    heights = np.abs((offset * normal).sum(axis=2)) / np.sqrt(square)
    return np.where(outside, np.inf, heights)
