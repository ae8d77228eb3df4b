"""Pick maximal balls that together explain the surface: our own rule beside the paper's smallest residues (Eq. 7).

The smallest residues alone say where maximal balls are, but not how to share them out. On flat parts thousands of
candidates have residue exactly 0; they fill the places, and thin parts stay bare. The coverage selection takes the
residue as what it is, a test of maximality, and lets the surface decide where balls are needed:

1. *Touch.* The ball of a true shape touches its surface. A candidate counts only if its nearest surface point is as
   far away as the rebuilt surface, up to the spacing of the points; balls of a part that the reconstruction invented
   fall out here.
2. *Nominate.* Every surface point nominates the candidates nearest to it, those of smallest residue first. So each
   part of the surface has its say, thick or thin.
3. *Cover.* Balls are taken from the nominees one by one. Each is for the surface point that is explained worst, and
   of those that would explain it, the one that lowers the squared errors of all points most; big balls explain many
   points and come first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError, ShapeError
from morphoskel.shapes import FloatArray, IntArray, Skeleton
from morphoskel.surface.repair import mean_spacing
from morphoskel.volume import Candidates

MOST_SURFACE_POINTS = 4096
"""Surface points that take part; of more, every so-manieth. The more points, the fewer candidates each has to nominate
from: with a million candidates, 8192 points leave twice the error on the dragon that 2000 do."""

CONTENDERS = 16
"""Balls that explain the worst point best, of which the one that helps all points most is chosen."""

NOMINEES_OF_A_THIN_PART = 2
"""Nominees of a surface point that has no candidate of small residue. In a part no thicker than the structuring element
the UDF itself hardly varies, and the residue says little."""

THIN = 2.0
"""Largest UDF in such a part, in radii of the structuring element."""

TOLERATED = 2.0
"""Error of a surface point, in spacings, up to which a ball has to be a gain for all points together. A ball that mends
a larger one may spoil others at first; balls that follow mend those."""

LARGEST_RESIDUE = 0.5
"""Residue up to which it is small, in radii of the structuring element. Between surface and skeleton the UDF grows as
fast as the distance, so that the residue is about 1; at a maximal ball it is 0."""


def coverage_skeleton(
    inner: npt.NDArray[np.float32],
    udf: npt.NDArray[np.float32],
    residues: npt.NDArray[np.float32],
    surface_points: FloatArray,
    *,
    points: int,
    element_radius: float,
    nominees: int = 8,
    touch: float = 1.0,
    threads: int = 1,
) -> Skeleton:
    """Choose maximal balls that explain the surface points.

    A surface point ``p`` is explained by the ball with the nearest centre ``c``, up to the error ``| |p - c| - r |``.

    Parameters
    ----------
    inner
        ``(M, 3)`` float32, candidates inside the surface.
    udf, residues
        ``(M,)`` float32, distance to the rebuilt surface, and dilation minus UDF.
    surface_points
        ``(P, 3)`` float64, points of the true surface: the cloud that the surface was rebuilt from.
    points
        Balls wanted; fewer if fewer are nominated.
    element_radius
        Radius of the structuring element, see :func:`typical_radius`.
    nominees
        Candidates that each surface point nominates.
    touch
        Largest difference between a candidate's distances to the rebuilt surface and to the points, in mean
        distances between a surface point and its nearest neighbour.
    threads
        Threads of the nearest-point search. Does not change the result.

    Returns
    -------
    Skeleton
        In the order of choice, so that the first n balls are a skeleton of n balls. Radii are distances to the
        nearest surface point: the points lie on the true surface, the rebuilt one only near it.

    Raises
    ------
    InputError
        If there are too few surface points.
    ShapeError
        If no ball touches the surface points.
    """
    surface_points = surface_points[:: max(-(-len(surface_points) // MOST_SURFACE_POINTS), 1)]
    if len(np.unique(surface_points, axis=0)) < 2:
        raise InputError("coverage selection: expected at least 2 distinct surface points")
    spacing = mean_spacing(surface_points)
    largest_residue = LARGEST_RESIDUE * element_radius
    contacts = _find_contacts(
        inner, udf, residues, surface_points, touch * spacing, largest_residue, element_radius, threads
    )
    if len(contacts.candidates) == 0:
        raise ShapeError(
            f"coverage selection: none of {len(inner)} inner points is as far from the cloud as from the rebuilt "
            "surface; the surface does not follow the cloud, try another reconstruction or a larger "
            "skeleton.coverage.touch"
        )
    found = contacts.candidates
    best = nominate(contacts.nearest, residues[found], udf[found], nominees, largest_residue)
    kept, radii = found[best], contacts.distances[best]
    centres = inner[kept].astype(np.float64)
    chosen = choose_covering(surface_points, centres, radii, points, tolerance=TOLERATED * spacing)
    return Skeleton(centres[chosen], radii[chosen], residues[kept[chosen]].astype(np.float64))


@dataclass(frozen=True, eq=False)
class _Contacts:
    """Candidates whose balls touch the surface points, their distances to these, and the nearest of these."""

    candidates: IntArray
    distances: FloatArray
    nearest: IntArray


def _find_contacts(
    inner: npt.NDArray[np.float32],
    udf: npt.NDArray[np.float32],
    residues: npt.NDArray[np.float32],
    surface_points: FloatArray,
    tolerance: float,
    largest_residue: float,
    element_radius: float,
    threads: int,
) -> _Contacts:
    """Return the candidates of small residue that touch, and where a surface point has none, those in thin parts.

    Most candidates are neither, and the search for their nearest surface point would cost more than the dilation.
    """
    from scipy.spatial import KDTree

    tree = KDTree(surface_points)

    def touching(which: IntArray) -> tuple[IntArray, FloatArray, IntArray]:
        found = tree.query(inner[which], workers=threads)
        distances, nearest = np.asarray(found[0]), np.asarray(found[1])
        kept = np.abs(distances - udf[which]) <= tolerance
        return which[kept], distances[kept], nearest[kept]

    small = touching(np.flatnonzero(residues <= largest_residue))
    bare = np.ones(len(surface_points), dtype=np.bool_)
    bare[small[2]] = False
    if not bare.any():
        return _Contacts(*small)
    thin = np.flatnonzero((residues > largest_residue) & (udf <= THIN * element_radius))
    reach = THIN * element_radius + tolerance
    near = KDTree(surface_points[bare]).query(inner[thin], distance_upper_bound=reach, workers=threads)
    of_thin = touching(thin[np.isfinite(np.asarray(near[0]))])
    own = bare[of_thin[2]]
    return _Contacts(*(np.concatenate([first, second[own]]) for first, second in zip(small, of_thin, strict=True)))


def typical_radius(candidates: Candidates, k: int) -> float:
    """Return the radius of a ball that holds `k` candidates on average."""
    density = len(candidates) / float(np.prod(candidates.upper - candidates.lower))
    return float((3 * k / (4 * np.pi * density)) ** (1 / 3))


def nominate(
    nearest: IntArray,
    residues: npt.NDArray[np.float32],
    udf: npt.NDArray[np.float32],
    nominees: int,
    largest_residue: float,
) -> IntArray:
    """Return the candidates of smallest residue among those that share their nearest surface point.

    Parameters
    ----------
    nearest
        ``(M,)`` int64, the surface point nearest to each candidate.
    residues, udf
        ``(M,)`` float32; ties of the residue go to the larger ball, then to the smaller index.
    nominees
        Candidates of each surface point.
    largest_residue
        Of the nominees of a surface point. Where no candidate has so small a residue, the first
        :data:`NOMINEES_OF_A_THIN_PART` are nominated.

    Returns
    -------
    ndarray
        ``(C,)`` int64 indices of candidates, by surface point, then by rank.
    """
    order = np.lexsort((-udf, residues, nearest))
    groups = nearest[order]
    first = np.searchsorted(groups, groups)
    rank = np.arange(len(order)) - first
    small = residues[order] <= largest_residue
    kept = np.where(small[first], small & (rank < nominees), rank < NOMINEES_OF_A_THIN_PART)
    nominated: IntArray = order[kept]
    return nominated


def choose_covering(
    surface_points: FloatArray, centres: FloatArray, radii: FloatArray, count: int, *, tolerance: float
) -> IntArray:
    """Choose balls that explain all surface points, the worst explained point first.

    The first ball is the largest. Once no surface point can be explained better, balls far from those chosen follow.

    Parameters
    ----------
    surface_points
        ``(P, 3)`` float64.
    centres, radii
        ``(C, 3)`` and ``(C,)`` float64, the balls to choose from.
    count
        Balls wanted.
    tolerance
        Error of a surface point up to which a ball for it must lower the sum of the squared errors of all points.

    Returns
    -------
    ndarray
        ``(min(count, C),)`` int64, indices of balls in the order of choice.
    """
    from morphoskel.skeleton.coverage_kernels import cover

    chosen = np.empty(min(count, len(centres)), dtype=np.int64)
    cover(
        np.ascontiguousarray(surface_points, dtype=np.float64),
        centres,
        radii,
        int(np.argmax(radii)),
        CONTENDERS,
        tolerance,
        chosen,
    )
    return chosen
