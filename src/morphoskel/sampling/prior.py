"""The skeleton prior: how much a point counts to a sampler, by its distance to the skeleton.

Source: Wen et al., *Learnable Skeleton-Aware 3D Point Cloud Sampling*, CVPR 2023, and the program released with it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from morphoskel.errors import ConfigError, InputError
from morphoskel.shapes import FloatArray


@dataclass(frozen=True)
class PriorSettings:
    """How distances to the skeleton become weights.

    Parameters
    ----------
    bins
        Bins of equal width between a shape's smallest and largest distance. Published: 6.
    sharpness
        Factor on the distances before the softmax. At the published 1 the weights of thin and thick regions of a shape
        of radius 1 differ by a factor of about 1.5; larger values prefer thin regions more strongly.

    Raises
    ------
    ConfigError
        If there is no bin, or the sharpness is negative or not finite.
    """

    bins: int
    sharpness: float

    def __post_init__(self) -> None:
        if self.bins < 1:
            raise ConfigError(f"bins: expected at least 1, got {self.bins}")
        if not 0 <= self.sharpness < np.inf:
            raise ConfigError(f"sharpness: expected a finite number of at least 0, got {self.sharpness}")


def local_feature_size(points: FloatArray, skeleton: FloatArray) -> FloatArray:
    """Return the distance of each point to the nearest skeletal point.

    Parameters
    ----------
    points
        ``(N, 3)`` float, on the surface.
    skeleton
        ``(K, 3)`` float, at least one centre, in the same frame and units. Radii play no part.

    Returns
    -------
    FloatArray
        ``(N,)`` float64, at least 0.

    Raises
    ------
    InputError
        If a shape is wrong, the skeleton is empty or a coordinate is not finite.
    """
    from scipy.spatial import cKDTree  # not above: the configuration reads the settings and must stay light

    points, skeleton = _rows(points, "points"), _rows(skeleton, "skeleton")
    if len(skeleton) == 0:
        raise InputError("skeleton: it has no point, so no distance to it exists; skeletonize the shape again")
    distances, _ = cKDTree(skeleton).query(points)
    return np.asarray(distances, dtype=np.float64)


def prior_weights(distances: FloatArray, settings: PriorSettings) -> FloatArray:
    """Turn the distances to the skeleton of one shape's points into weights: the nearer, the heavier.

    The range of the distances is cut into bins of equal width. The weights of the bins are a softmax of minus their
    middles, and each point has the weight of its bin; how many points a bin holds does not matter.

    Parameters
    ----------
    distances
        ``(N,)`` float, finite, at least one, see :func:`local_feature_size`.
    settings
        Bins and sharpness.

    Returns
    -------
    FloatArray
        ``(N,)`` float64, more than 0. Equal distances give the same weight to all points, 1 / bins.

    Raises
    ------
    InputError
        If there is no distance, or one is NaN or infinite.

    Notes
    -----
    A bin reaches from above its lower edge up to its upper edge, as in the released program. That program lowers the
    first edge by 0.1 after the middles are computed, so that the smallest distance falls into the first bin; here the
    index is clamped, which does the same. The last edge is the largest distance itself, so that no rounding can put
    that one beyond the last bin, as it can there.
    """
    distances = np.asarray(distances, dtype=np.float64)
    if distances.ndim != 1 or len(distances) == 0:
        raise InputError(f"distances: expected shape (N,) with N >= 1, got {distances.shape}")
    bad = np.flatnonzero(~np.isfinite(distances))
    if len(bad):
        raise InputError(
            f"distances: {len(bad)} of {len(distances)} are NaN or infinite, the first is that of point {bad[0]}; "
            "check the points and the skeleton"
        )
    edges = np.linspace(distances.min(), distances.max(), settings.bins + 1)
    middles = (edges[:-1] + edges[1:]) / 2
    bin_weights = np.exp(-settings.sharpness * (middles - middles[0]))
    bin_weights /= bin_weights.sum()
    bins = np.maximum(np.searchsorted(edges, distances, side="left") - 1, 0)
    weights: FloatArray = bin_weights[bins]
    return weights


def shuffled_weights(weights: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Return the weights of one shape, ``(N,)``, dealt out to its points at random: a control without a skeleton."""
    return generator.permutation(weights)


def uniform_weights(count: int, settings: PriorSettings) -> FloatArray:
    """Return ``(count,)`` float64 equal weights, as equal distances give them: a control without a skeleton."""
    return np.full(count, 1 / settings.bins)


def _rows(array: FloatArray, name: str) -> FloatArray:
    rows = np.asarray(array, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise InputError(f"{name}: expected shape (N, 3), got {rows.shape}")
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise InputError(f"{name}: {len(bad)} rows hold NaN or infinite values, the first is row {bad[0]}; repair them")
    return rows
