"""Let inner points sink from the surface until opposite fronts meet."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray
from morphoskel.skeleton.dpc.neighbourhood import neighbour_pairs, proximity
from morphoskel.skeleton.dpc.settings import DeepPointsSettings

if TYPE_CHECKING:
    from scipy.sparse import csr_array

BoolArray = npt.NDArray[np.bool_]

SURFACE_SEPARATION = 2.0
"""After a move, inner points meet only if their samples are at least so many stop radii apart (released program)."""


@dataclass(frozen=True)
class Sinking:
    """Where the inner points came to.

    Parameters
    ----------
    depths
        ``(N,)`` float64, how far each inner point is below its sample, in the shape's units.
    stopped
        ``(N,)`` bool, whether it met another front or cooled down; the others still moved after the last step.
    """

    depths: FloatArray
    stopped: BoolArray


def sink(samples: FloatArray, directions: FloatArray, spacing: float, settings: DeepPointsSettings) -> Sinking:
    """Move an inner point from each sample against its direction, step by step, until it meets another front.

    A step has three parts (Wu et al., "Deep Points Consolidation", SIGGRAPH Asia 2015, as the released program does
    it). First, a point stops if an inner point in the stop radius has another direction, and its speed becomes 0.
    Second, all speeds are replaced by the weighted mean of the neighbours' speeds on the surface, so that motion
    slows down beside points that stopped, and the others sink. Third, a point stops that became slow, or that met
    another front whose samples are far away on the surface.

    Parameters
    ----------
    samples
        ``(N, 3)`` float64.
    directions
        ``(N, 3)`` float64, outward, unit length.
    spacing
        The unit of the lengths in `settings`, in the shape's units.
    settings
        Step, radii, angle, cooling and numbers of steps.

    Returns
    -------
    Sinking
        One depth a sample.
    """
    smoothing = _speed_smoothing(samples, settings.surface_radius * spacing)
    depths: FloatArray = np.zeros(len(samples))
    speeds: FloatArray = np.ones(len(samples))
    stopped = np.zeros(len(samples), dtype=np.bool_)
    separation = SURFACE_SEPARATION * settings.stop_radius * spacing
    for number in range(settings.untested_steps + settings.max_steps):
        tested = number >= settings.untested_steps
        if tested:
            met = meet_fronts(samples, directions, depths, ~stopped, 0.0, spacing, settings)
            stopped |= met
            speeds[met] = 0.0
        speeds = smoothing @ speeds
        depths = np.where(stopped, depths, depths + settings.step * spacing * speeds)
        if tested:
            stopped |= speeds < settings.cooling
            stopped |= meet_fronts(samples, directions, depths, ~stopped, separation, spacing, settings)
        if stopped.all():
            break
    return Sinking(depths, stopped)


def meet_fronts(
    samples: FloatArray,
    directions: FloatArray,
    depths: FloatArray,
    moving: BoolArray,
    separation: float,
    spacing: float,
    settings: DeepPointsSettings,
) -> BoolArray:
    """Return which moving points have an inner point of another direction within the stop radius.

    Pairs whose samples are less than `separation` apart, in the shape's units, are ignored: they are neighbours
    across an edge rather than opposite sides.
    """
    from morphoskel.skeleton.dpc.sinking_kernels import opposite_fronts

    inner = samples - depths[:, None] * directions
    axis = int(np.argmax(np.ptp(inner, axis=0)))
    order = np.argsort(inner[:, axis], kind="stable")
    met = np.empty(len(samples), dtype=np.bool_)
    met[order] = opposite_fronts(
        inner[order],
        directions[order],
        samples[order],
        moving[order],
        axis,
        settings.stop_radius * spacing,
        math.cos(math.radians(settings.stop_angle)),
        separation,
    )
    return met


def _speed_smoothing(samples: FloatArray, radius: float) -> csr_array:
    """Return the matrix that replaces each speed by the neighbours' weighted mean; the lonely keep their own."""
    from scipy.sparse import csr_array

    count = len(samples)
    first, second = neighbour_pairs(samples, radius)
    weights = proximity(np.linalg.norm(samples[first] - samples[second], axis=1), radius)
    totals = np.bincount(first, weights, minlength=count)
    lonely = np.flatnonzero(totals == 0)
    rows, columns = np.concatenate([first, lonely]), np.concatenate([second, lonely])
    values = np.concatenate([weights / totals[first], np.ones(len(lonely))])
    return csr_array((values, (rows, columns)), shape=(count, count))
