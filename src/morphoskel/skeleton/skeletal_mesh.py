"""The mesh of curves and sheets between the skeletal points of Point2Skeleton.

Source: Lin et al., *Point2Skeleton: Learning Skeletal Representations from Point Clouds*, CVPR 2021, Sec. 3.2, and the
program released with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray, IntArray
from morphoskel.skeleton.mesh_distance import nearest_pieces

BoolArray = npt.NDArray[np.bool_]

LONGEST_LOOP = 8
"""Longest loop of links that may be the boundary of a hole."""
LEAST_OPEN_LINKS = 3
"""Links of a loop with fewer than two triangles, so that it may be the boundary of a hole."""
LEAST_PROJECTED_POINTS = 3
"""Surface points nearest to the filling of a hole that prove it to be one."""


def skeletal_mesh(
    centres: FloatArray, surface_points: FloatArray, links: BoolArray, predicted: BoolArray
) -> tuple[IntArray, IntArray]:
    """Turn a graph of skeletal points into curves and sheets.

    Three points that are all linked span a triangle. Holes of the sheets are filled where enough surface points lie
    nearest to the filling, or where links across them are predicted. Predicted links are also taken between points on
    the boundaries of sheets and between points of just one piece, the ends of curves. The remaining links are curves.

    Parameters
    ----------
    centres
        ``(K, 3)`` float64.
    surface_points
        ``(N, 3)`` float64, in the same units.
    links, predicted
        ``(K, K)`` bool, symmetric, diagonal False: the initial links, which are certain, and the predicted ones.

    Returns
    -------
    tuple of ndarray
        Edges that belong to no triangle, ``(E, 2)`` int64, and triangles, ``(T, 3)`` int64, in ascending order.

    Notes
    -----
    The released program finds the triangle nearest to a surface point among 4000 random points of the mesh; here it is
    found exactly, so nothing is random.
    """
    triangles = graph_triangles(links)
    fillings = _fillings(centres, surface_points, links, predicted, triangles)
    completed = links.copy()
    for filling in fillings:
        _link_sides(completed, filling)
    completed |= _boundary_links(completed, np.concatenate([triangles, *fillings]), predicted)
    triangles = graph_triangles(completed)
    return curve_edges(completed, triangles), triangles


def graph_triangles(links: BoolArray) -> IntArray:
    """Return the 3-cycles of a graph, ``(T, 3)`` int64, each ascending, in ascending order."""
    first, second = np.nonzero(np.triu(links))
    pair, third = np.nonzero(links[first] & links[second])
    triples = np.stack([first[pair], second[pair], third], axis=1)
    triangles: IntArray = triples[triples[:, 2] > triples[:, 1]].astype(np.int64)
    return triangles


def curve_edges(links: BoolArray, triangles: IntArray) -> IntArray:
    """Return the links that are in no triangle, ``(E, 2)`` int64, each ascending, in ascending order."""
    edges: IntArray = np.argwhere(np.triu(links & (triangle_counts(len(links), triangles) == 0))).astype(np.int64)
    return edges


def triangle_counts(count: int, triangles: IntArray) -> IntArray:
    """Return in how many triangles each pair of `count` points is, ``(count, count)`` int64, symmetric."""
    counts = np.zeros((count, count), dtype=np.int64)
    for first, second in ((0, 1), (1, 2), (2, 0)):
        np.add.at(counts, (triangles[:, first], triangles[:, second]), 1)
    return counts + counts.T


def induced_loops(links: BoolArray, length: int, open_links: BoolArray, least_open: int) -> Iterator[tuple[int, ...]]:
    """Yield the loops of a graph that no link crosses.

    Parameters
    ----------
    links
        ``(K, K)`` bool, symmetric, diagonal False.
    length
        Number of points of a loop, at least 4.
    open_links
        ``(K, K)`` bool, symmetric, part of the links.
    least_open
        Only loops with at least this many open links are wanted.

    Yields
    ------
    tuple of int
        The points in the order of the loop, each loop once: its smallest point first, and the smaller of that point's
        two neighbours second.
    """
    neighbours = [np.flatnonzero(row).tolist() for row in links]
    allowed_closed = length - least_open
    for start in range(len(links)):
        hops = _hops(neighbours, start, length // 2)
        stack: list[tuple[tuple[int, ...], int]] = [((start,), 0)]
        while stack:
            path, closed = stack.pop()
            last = path[-1]
            if len(path) == length:
                if closed + (not open_links[last, start]) <= allowed_closed and path[1] < last:
                    yield path
                continue
            for point in neighbours[last]:
                now_closed = closed + (not open_links[last, point])
                remaining = length - len(path)
                # Only the last point may be linked to the first, and a path longer than the way back cannot close.
                closes = remaining == 1
                if (
                    point <= start
                    or point in path
                    or now_closed > allowed_closed
                    or hops.get(point, length) > remaining
                ):
                    continue
                if bool(links[point, start]) != closes and len(path) > 1:
                    continue
                if not links[point, list(path[1:-1])].any():
                    stack.append(((*path, point), now_closed))


def _hops(neighbours: list[list[int]], start: int, most: int) -> dict[int, int]:
    """Return the number of links from `start` to the points of larger index within `most` links."""
    hops, front = {start: 0}, [start]
    for distance in range(1, most + 1):
        front = sorted({point for last in front for point in neighbours[last] if point > start and point not in hops})
        hops.update(dict.fromkeys(front, distance))
    return hops


def _fan(loop: tuple[int, ...]) -> IntArray:
    """Return the triangles between the first point of a loop and each link opposite to it."""
    return np.array([(loop[0], second, third) for second, third in pairwise(loop[1:])], np.int64)


def _fillings(
    centres: FloatArray, surface_points: FloatArray, links: BoolArray, predicted: BoolArray, triangles: IntArray
) -> list[IntArray]:
    """Return the triangles of each hole that is to be filled."""
    loops: list[tuple[int, ...]] = []
    with_candidates = triangles
    for length in range(4, LONGEST_LOOP + 1):
        # A link that already has two triangles, candidates included, is inside a sheet.
        open_links = links & (triangle_counts(len(links), with_candidates) < 2)
        found = list(induced_loops(links, length, open_links, LEAST_OPEN_LINKS))
        with_candidates = np.concatenate([with_candidates, *map(_fan, found)])
        loops += found
    if not loops:
        return []
    _, nearest = nearest_pieces(surface_points, centres, np.empty((0, 2), dtype=np.int64), with_candidates)
    fans = [_fan(loop) for loop in loops]
    loop_of = np.repeat(np.arange(len(loops)), [len(fan) for fan in fans])
    projected = np.bincount(loop_of[nearest[nearest >= len(triangles)] - len(triangles)], minlength=len(loops))
    # Twice the links between the points of the loop: more than the loop itself has means that one crosses it.
    crossed = [predicted[np.ix_(loop, loop)].sum() > 2 * len(loop) for loop in loops]
    return [
        fan
        for fan, count, cross in zip(fans, projected, crossed, strict=True)
        if cross or count >= LEAST_PROJECTED_POINTS
    ]


def _link_sides(links: BoolArray, triangles: IntArray) -> None:
    """Link the corners of triangles, in place."""
    links |= triangle_counts(len(links), triangles) > 0


def _boundary_links(links: BoolArray, triangles: IntArray, predicted: BoolArray) -> BoolArray:
    """Return the predicted links between boundary points of sheets and those between ends.

    An end is a point in just one piece, be it a link of a curve or a triangle.
    """
    sides = triangle_counts(len(links), triangles)
    on_boundary = (sides == 1).any(axis=1)
    pieces = np.bincount(triangles.ravel(), minlength=len(links)) + (links & (sides == 0)).sum(axis=1)
    ends = pieces == 1
    chosen: BoolArray = predicted & (np.logical_and.outer(on_boundary, on_boundary) | np.logical_and.outer(ends, ends))
    return chosen
