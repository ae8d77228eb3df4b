"""Hold shapes out of the training split, to choose an epoch by them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from morphoskel.errors import InputError
from morphoskel.seeds import derive_generator
from morphoskel.shapes import IntArray


def hold_out(categories: Sequence[str], share: float, seed: int) -> tuple[IntArray, IntArray]:
    """Split shapes into those to train on and those held out, `share` of each category but not all of it.

    Parameters
    ----------
    categories
        The category of each training shape.
    share
        Share to hold out, between 0 and 1.
    seed
        The global seed: the same shapes are held out for all networks.

    Returns
    -------
    tuple
        Positions to train on and held out, each sorted by category, then position; neither is empty.

    Raises
    ------
    InputError
        If there are fewer than two shapes.
    """
    training: list[int] = []
    validation: list[int] = []
    names = np.asarray(categories, dtype=object)
    for category in sorted(set(categories)):
        of_category = np.flatnonzero(names == category)
        order = derive_generator(seed, category, "validation").permutation(len(of_category))
        count = min(round(share * len(of_category)), len(of_category) - 1)
        validation += of_category[np.sort(order[:count])].tolist()
        training += of_category[np.sort(order[count:])].tolist()
    if not validation and len(training) > 1:
        validation.append(training.pop())
    if not validation:
        raise InputError(
            f"the training split has {len(names)} shapes; at least 2 are needed, one to train on and one held out"
        )
    return np.array(training, dtype=np.int64), np.array(validation, dtype=np.int64)
