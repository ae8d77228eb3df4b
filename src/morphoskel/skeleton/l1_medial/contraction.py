"""Contraction of samples to local centres of a point cloud (Huang et al., SIGGRAPH 2013)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.l1_medial.directionality import UNKNOWN, directionality
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, Samples
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings

FLAT = 1e-6
"""A bounding box whose shortest side is no larger than this share of the longest one has no volume."""


def first_radius(points: FloatArray, factor: float = 1.0) -> float:
    """Return the radius of the first neighbourhoods.

    As in the released program, the diagonal of the bounding box over the cube root of the number of points; for a
    cloud in a plane parallel to the axes, twice the diagonal over the square root. The paper's text has twice the
    first.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.
    factor
        Factor on it.

    Returns
    -------
    float
        In the unit of the coordinates.
    """
    sides = np.ptp(points, axis=0)
    diagonal = float(np.linalg.norm(sides))
    if sides.min() <= FLAT * sides.max():
        return float(2 * factor * diagonal / len(points) ** (1 / 2))
    return float(factor * diagonal / len(points) ** (1 / 3))


def density_weights(points: FloatArray, radius: float) -> FloatArray:
    r"""Return weights that undo an uneven density: :math:`1 / (1 + \sum_j \theta(|p - p_j|))`.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.
    radius
        Of the neighbourhoods, in the unit of the coordinates.

    Returns
    -------
    ndarray
        ``(N,)`` float64, at most 1.
    """
    from morphoskel.skeleton.l1_medial.contraction_kernels import densities

    weights: FloatArray = 1 / densities(np.ascontiguousarray(points.T), radius)
    return weights


def explained_by_branches(points: FloatArray, samples: Samples, radius: float) -> npt.NDArray[np.bool_]:
    """Return which points are close to a sample on a branch: within half the radius of the neighbourhoods.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.
    samples
        Some of them on branches.
    radius
        Of the neighbourhoods, in the unit of the coordinates.

    Returns
    -------
    ndarray
        ``(N,)`` bool.
    """
    from scipy.spatial import cKDTree

    fixed = samples.indices(FIXED)
    if len(fixed) == 0:
        return np.zeros(len(points), dtype=bool)
    distances = cKDTree(samples.points[fixed]).query(points)[0]
    return np.asarray(distances < radius / 2)


def contract(
    samples: Samples, points: FloatArray, weights: FloatArray, radius: float, settings: L1MedialSettings
) -> float:
    r"""Move the samples once, and update their directionality.

    .. math:: x_i \leftarrow \frac{\sum_j \alpha_{ij} q_j}{\sum_j \alpha_{ij}}
              + \mu_i \frac{\sum_{i'} \beta_{ii'} (x_i - x_{i'})}{\sum_{i'} \beta_{ii'}}

    with :math:`\theta(d) = e^{-4 d^2 / h^2}`, :math:`\alpha = \theta(d) d^{a - 2}` and
    :math:`\beta = \theta(d) d^{-b}`, where a and b are ``average_power`` and ``repulsion_power``. In the paper a = 1,
    b = 2 and :math:`\mu_i` is proportional to the directionality; the released program, whose values are the defaults,
    has a = 2, b = 1 and lets :math:`\mu_i` run linearly over the range that the directionalities have at the time.

    Parameters
    ----------
    samples
        Changed in place. Those on branches stay where they are, but push the others.
    points
        ``(N, 3)`` float64, the cloud.
    weights
        ``(N,)`` float64, of its points.
    radius
        Of the neighbourhoods, h, in the unit of the coordinates.
    settings
        Powers and strength of the repulsion.

    Returns
    -------
    float
        Mean displacement, in the unit of the coordinates; 0 if no sample moves.
    """
    from morphoskel.skeleton.l1_medial.contraction_kernels import averages, repulsions

    live = samples.indices(MOVING, FIXED)
    pushes, scatters, counts = repulsions(
        np.ascontiguousarray(samples.points[live].T), radius, settings.repulsion_power
    )
    values = np.where(counts <= 3, UNKNOWN, directionality(scatters))
    samples.directionality[live] = values
    moving = samples.states[live] == MOVING
    before = samples.points[live[moving]]
    if len(before) == 0:
        return 0.0
    span = float(np.ptp(values))
    share = (values - values.min()) / span if span > 0 else np.zeros(len(values))
    strength = settings.least_repulsion + (settings.largest_repulsion - settings.least_repulsion) * share
    after = averages(before, np.ascontiguousarray(points.T), weights, radius, settings.average_power)
    after += strength[moving, None] * pushes[moving]
    samples.points[live[moving]] = after
    return float(np.linalg.norm(after - before, axis=1).mean())
