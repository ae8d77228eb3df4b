"""The points that are contracted to a skeleton."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray

MOVING, FIXED, REMOVED = range(3)
"""What a sample can be: contracted further (also as the bridge at the end of a branch), on a branch, or gone."""


@dataclass
class Samples:
    """Positions of the samples, what became of them, and how directional their neighbourhoods are.

    Parameters
    ----------
    points
        ``(S, 3)`` float64, changed in place.
    states
        ``(S,)`` int8, one of ``MOVING``, ``FIXED`` and ``REMOVED``.
    directionality
        ``(S,)`` float64, the latest value of σ: 1 on a line, 1/3 in a ball.
    """

    points: FloatArray
    states: npt.NDArray[np.int8] = field(init=False)
    directionality: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        self.states = np.full(len(self.points), MOVING, dtype=np.int8)
        self.directionality = np.full(len(self.points), 0.5)

    def indices(self, *states: int) -> npt.NDArray[np.int64]:
        """Return the samples in one of some states."""
        return np.flatnonzero(np.logical_or.reduce([self.states == state for state in states]))
