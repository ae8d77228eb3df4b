"""Which points of clouds are labelled: those that a sampler chose."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.sampling.choice import COMPLETED, DRAWN, FIXED
from morphoskel.sampling.choose_for_split import read_choices


@dataclass(frozen=True)
class LabelRequest:
    """Which choices of a sampler to label.

    Parameters
    ----------
    ratio
        Points of a cloud for each point chosen.
    number
        Of the training that learns from the labels, from 0. Each has draws of its own, and one of the sampler's
        trainings in turn.
    sets
        Sets of labelled points of each cloud, at least 1. A sampler that always chooses the same points has one.
    completed
        Take the choices in which farthest points stand in for repeated ones, of samplers that may repeat points.
    """

    ratio: int
    number: int
    sets: int
    completed: bool


def read_label_sets(folder: Path, request: LabelRequest) -> npt.NDArray[np.int32]:
    """Return the points to label.

    Parameters
    ----------
    folder
        Of :func:`~morphoskel.sampling.choose_for_split.choose_for_split`.
    request
        Which of its choices.

    Returns
    -------
    ndarray
        ``(D, S, M)`` int32 of D sets, -1 for a shape of which nothing was chosen.

    Raises
    ------
    InputError
        If the folder lacks the ratio, the kind of choice, or draws.
    """
    choices = read_choices(folder)
    ratio, number = request.ratio, request.number
    trainings = sorted({training for of_ratio, training, _ in choices if of_ratio == ratio})
    if not trainings:
        found = ", ".join(str(of_ratio) for of_ratio in sorted({of_ratio for of_ratio, _, _ in choices}))
        raise InputError(f"{folder}: holds no points chosen at ratio {ratio}, only at {found}; choose them first")
    training = trainings[number % len(trainings)]
    # Random points are drawn without repetitions and hence have no completed choices.
    kinds = (FIXED, COMPLETED, DRAWN) if request.completed else (FIXED, DRAWN)
    kind = next((kind for kind in kinds if (ratio, training, kind) in choices), None)
    if kind is None:
        raise InputError(
            f"{folder}: holds no {' or '.join(kinds)} choice at ratio {ratio} of training {training}; choose them first"
        )
    draws = choices[ratio, training, kind].indices
    if kind == FIXED:
        return draws[:1]
    start, stop = number * request.sets, (number + 1) * request.sets
    if len(draws) < stop:
        raise InputError(
            f"{folder}: expected at least {stop} draws at ratio {ratio} for {request.sets} sets of labels of training "
            f"{number}, got {len(draws)}; draw more often"
        )
    return draws[start:stop]


def labelled_mask(
    indices: npt.NDArray[np.integer[Any]], lengths: npt.NDArray[np.int64], points: int
) -> npt.NDArray[np.bool_]:
    """Mark the chosen points.

    Parameters
    ----------
    indices
        ``(S, M)`` int, points of each cloud; all -1 for a shape of which nothing was chosen.
    lengths
        ``(S,)`` int64, the number of different points of each cloud; point i from there on repeats point i modulo
        this number, which is marked in its place, see :class:`~morphoskel.datasets.cloud_set.CloudSet`.
    points
        Points of the clouds, N.

    Returns
    -------
    ndarray
        ``(S, N)`` bool.

    Raises
    ------
    InputError
        If there are not as many shapes as lengths, or an index is no point of a cloud.
    """
    if len(indices) != len(lengths):
        raise InputError(f"points are chosen of {len(indices)} shapes, but there are {len(lengths)}; choose them again")
    known = ~np.all(indices == -1, axis=1)
    if np.any(indices[known] < 0) or np.any(indices[known] >= points):
        raise InputError(
            f"chosen points: expected 0 to {points - 1} for clouds of {points} points, got {indices[known].min()} to "
            f"{indices[known].max()}; choose them again"
        )
    mask = np.zeros((len(indices), points), dtype=np.bool_)
    mask[np.flatnonzero(known)[:, None], indices[known] % lengths[known, None]] = True
    return mask
