"""One vertex a cell: the point nearest to the tangent planes of its samples (quadric error, Garland and Heckbert 1997).

A quadric is a symmetric matrix Q whose value at a point v, ``(v, 1) Q (v, 1)``, is the mean squared distance of v from
the tangent planes of the samples.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray
from morphoskel.surface.ponq.cells import assign_to_cells, sum_in_cells

SMALLEST_SINGULAR_VALUE = 0.05
"""Relative to the largest: directions in which the planes say less than this about the vertex are left alone."""

COINCIDENT = 1e-7
"""Side of the little cubes within which vertices count as one, in half sides of the shape's cube."""


@dataclass(frozen=True, eq=False)
class QuadricVertices:
    """Points, normals and quadrics.

    Parameters
    ----------
    positions
        ``(V, 3)`` float64.
    normals
        ``(V, 3)`` float64, the mean of the samples' unit normals: shorter where they disagree.
    quadrics
        ``(V, 4, 4)`` float64, scaled so that the largest singular value of the upper left 3x3 block is 1.
    """

    positions: FloatArray
    normals: FloatArray
    quadrics: FloatArray

    def __len__(self) -> int:
        return len(self.positions)


def fit_quadric_vertices(points: FloatArray, normals: FloatArray, sites: FloatArray) -> QuadricVertices:
    """Fit a vertex to the samples of every cell that has some (Maruani et al., CVPR 2024).

    Parameters
    ----------
    points, normals
        ``(P, 3)``, the samples, with unit normals.
    sites
        ``(N, 3)`` inside the cube ``[-1, 1]^3``.

    Returns
    -------
    QuadricVertices
        At most N vertices, all inside the cube, no two of them in the same place.
    """
    cells = assign_to_cells(points, sites)
    planes = np.column_stack([normals, -np.einsum("ij,ij->i", normals, points)])
    products = np.einsum("ij,ik->ijk", planes, planes).reshape(len(points), 16)
    counts = np.bincount(cells, minlength=len(sites)).astype(np.float64)
    filled = counts > 0
    sums = sum_in_cells(np.column_stack([normals, products]), cells, len(sites))[filled]
    means = sums / counts[filled, None]
    positions = optimal_positions(means[:, 3:].reshape(-1, 4, 4), sites[filled])

    first, merged = _coincident(positions)
    weights = sum_in_cells(counts[filled, None], merged, len(first))
    means = sum_in_cells(sums, merged, len(first)) / weights
    quadrics = means[:, 3:].reshape(-1, 4, 4)
    largest = np.linalg.eigvalsh(quadrics[:, :3, :3])[:, -1]
    return QuadricVertices(positions[first], means[:, :3], quadrics / largest[:, None, None])


def optimal_positions(quadrics: FloatArray, sites: FloatArray) -> FloatArray:
    """Return the minimiser of each quadric that is nearest to its site.

    With A the upper left block and b the negative upper right column, the minimum solves ``A v = b``; the solution
    ``v = p + A+ (b - A p)`` moves the site p only in the directions that the planes determine.

    Parameters
    ----------
    quadrics
        ``(N, 4, 4)``.
    sites
        ``(N, 3)`` inside the cube ``[-1, 1]^3``.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64. A minimiser outside the cube, which contradictory normals can cause, is replaced by its
        site.
    """
    block, column = quadrics[:, :3, :3], -quadrics[:, :3, 3]
    values, axes = np.linalg.eigh(block)
    kept = values > SMALLEST_SINGULAR_VALUE * values[:, -1:]
    inverse_values = np.where(kept, 1 / np.where(kept, values, 1.0), 0.0)
    residual = column - np.einsum("nij,nj->ni", block, sites)
    along_axes = inverse_values * np.einsum("nji,nj->ni", axes, residual)
    positions = sites + np.einsum("nij,nj->ni", axes, along_axes)
    inside = (np.abs(positions) < 1).all(axis=1)
    return np.where(inside[:, None], positions, sites)


def _coincident(positions: FloatArray) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.int64]]:
    """Group the positions that coincide: the first row of each group, and the group of each row."""
    rounded = np.round(positions / COINCIDENT).astype(np.int64)
    _, first, groups = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
    return first, groups.reshape(-1).astype(np.int64)
