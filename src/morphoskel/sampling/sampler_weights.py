"""The weights that each skeleton prior gives to the points of a split's clouds."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.datasets.cloud_set import CloudSet
from morphoskel.errors import InputError
from morphoskel.sampling.prior import PriorSettings, prior_weights, shuffled_weights, uniform_weights
from morphoskel.sampling.prior_set import PriorSet
from morphoskel.seeds import derive_generator

UNIFORM = "uniform"
SHUFFLED = "shuffled"


def sampler_weights(
    sampler: str, clouds: CloudSet, priors: PriorSet | None, settings: PriorSettings, seed: int
) -> npt.NDArray[np.float32]:
    """Return the weight of every point.

    Parameters
    ----------
    sampler
        One of :data:`morphoskel.sampling.samplers.PRIORS`.
    clouds
        Of a split.
    priors
        Their local feature sizes; not needed for ``uniform``.
    settings
        How distances become weights.
    seed
        The global seed; decides how the weights of ``shuffled`` are dealt out, once for each shape.

    Returns
    -------
    ndarray
        ``(S, N)`` float32, NaN for shapes that have no skeleton.

    Raises
    ------
    InputError
        If local feature sizes are missing.
    """
    if sampler == UNIFORM:
        return np.tile(uniform_weights(clouds.points.shape[1], settings), (len(clouds), 1)).astype(np.float32)
    if priors is None:
        raise InputError(f"{sampler}: local feature sizes are needed for its prior")
    weights = np.full(priors.distances.shape, np.nan, dtype=np.float32)
    for number, (shape, distances) in enumerate(zip(clouds.ids, priors.distances, strict=True)):
        if priors.reasons[number]:
            continue
        weights[number] = prior_weights(distances, settings)
        if sampler == SHUFFLED:
            weights[number] = shuffled_weights(weights[number], derive_generator(seed, str(shape), "shuffled prior"))
    return weights
