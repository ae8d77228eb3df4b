"""Points chosen of the clouds of a split, and the file that holds them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from morphoskel.atomic import atomic_file
from morphoskel.formats.stored_arrays import Layout, read_arrays

_LAYOUT: Layout = {"indices": ("i", "DSM"), "distinct": ("i", "DS")}

FIXED = "fixed"
"""Of a sampler that always chooses the same points."""

DRAWN = "drawn"
"""Of a sampler with noise: one choice a draw, in which points may repeat."""

ARGMAX = "argmax"
"""Of a sampler with noise, without it."""

COMPLETED = "completed"
"""Drawn, then without repetitions and with farthest points in their place."""


@dataclass(frozen=True, eq=False)
class Choice:
    """Points chosen of every cloud of a split.

    Parameters
    ----------
    indices
        ``(D, S, M)`` int32, of D draws; -1 for a shape of which nothing could be chosen.
    distinct
        ``(D, S)`` int32, different points among them; of generated points, those before completion.
    """

    indices: npt.NDArray[np.int32]
    distinct: npt.NDArray[np.int32]


def write_choice(choice: Choice, path: Path) -> None:
    """Write a choice to an NPZ file, whole or not at all."""
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez_compressed(stream, indices=choice.indices, distinct=choice.distinct)


def read_choice(path: Path) -> Choice:
    """Read the file of :func:`write_choice`.

    Raises
    ------
    InputError
        If it is absent or is not such a file.
    """
    arrays = read_arrays(path, _LAYOUT, "a file of chosen points")
    return Choice(arrays["indices"], arrays["distinct"])
