"""Spread sites over a cloud: Adam on the squared Chamfer distance (Maruani et al., CVPR 2024)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray
from morphoskel.surface.ponq.cells import assign_to_cells, sum_in_cells

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

MEAN_DECAY, SQUARE_DECAY, GUARD = 0.9, 0.999, 1e-8
"""Adam's usual decay rates of the running mean of the gradient and of its square, and its guard against zero."""


def draw_sites(
    candidates: FloatArray, count: int, *, with_replacement: bool, generator: np.random.Generator
) -> FloatArray:
    """Draw the initial sites among the points.

    Parameters
    ----------
    candidates
        ``(P, 3)``, the points to draw from; distinct, if the sites are to be.
    count
        Number of sites.
    with_replacement
        Whether a candidate may become several, coincident, sites.
    generator
        Draws the sites.

    Returns
    -------
    ndarray
        ``(count, 3)`` float64.

    Raises
    ------
    ShapeError
        If there are fewer than `count` candidates to draw from without replacement.
    """
    if count > len(candidates) and not with_replacement:
        raise ShapeError(
            f"ponq: cannot draw {count} sites from {len(candidates)} distinct points; ask for fewer sites or set "
            "with_replacement"
        )
    drawn: FloatArray = candidates[generator.choice(len(candidates), size=count, replace=with_replacement)]
    return drawn


def chamfer_gradient(sites: FloatArray, samples: FloatArray, sample_tree: cKDTree) -> FloatArray:
    """Return the gradient of the symmetric squared Chamfer distance by the positions of the sites.

    The distance is the mean over the samples of the squared distance to the nearest site, plus the mean over the
    sites of the squared distance to the nearest sample. Who is nearest to whom does not change in a small step, so
    each squared distance ``|p - s|^2`` contributes ``2 (p - s)``.

    Parameters
    ----------
    sites
        ``(N, 3)``.
    samples
        ``(S, 3)``.
    sample_tree
        A k-d tree of `samples`.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64.
    """
    cells = assign_to_cells(samples, sites)
    towards_cell = sum_in_cells(sites[cells] - samples, cells, len(sites)) / len(samples)
    _, nearest = sample_tree.query(sites)
    towards_sample = (sites - samples[nearest]) / len(sites)
    gradient: FloatArray = 2 * (towards_cell + towards_sample)
    return gradient


def optimise_sites(
    sites: FloatArray,
    points: FloatArray,
    *,
    steps: int,
    learning_rate: float,
    batch: int,
    generator: np.random.Generator,
) -> FloatArray:
    """Move the sites by Adam (Kingma and Ba, ICLR 2015) so that they cover the points evenly.

    Parameters
    ----------
    sites
        ``(N, 3)``, where they start; not changed.
    points
        ``(P, 3)``, the samples.
    steps
        Number of steps.
    learning_rate
        Largest movement of a coordinate in a step, roughly.
    batch
        Samples a step, drawn anew each time; all points if `batch` equals P, and then nothing is drawn.
    generator
        Draws the batches.

    Returns
    -------
    ndarray
        ``(N, 3)`` float64.
    """
    from scipy.spatial import cKDTree

    sites = sites.copy()
    mean, square = np.zeros_like(sites), np.zeros_like(sites)
    samples, tree = points, cKDTree(points)
    for step in range(1, steps + 1):
        if batch < len(points):
            samples = points[generator.choice(len(points), size=batch, replace=False)]
            tree = cKDTree(samples)
        gradient = chamfer_gradient(sites, samples, tree)
        mean += (1 - MEAN_DECAY) * (gradient - mean)
        square += (1 - SQUARE_DECAY) * (gradient**2 - square)
        unbiased_mean, unbiased_square = mean / (1 - MEAN_DECAY**step), square / (1 - SQUARE_DECAY**step)
        sites -= learning_rate * unbiased_mean / (np.sqrt(unbiased_square) + GUARD)
    return sites
