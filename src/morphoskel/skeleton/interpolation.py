"""Fill the curves and sheets of a skeleton with balls, so that skeletons of any number of balls can be compared."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray, Skeleton


def interpolate_balls(skeleton: Skeleton, count: int, generator: np.random.Generator) -> Skeleton:
    """Draw balls uniformly from the curves and sheets of a skeleton.

    Centre and radius are interpolated linearly along an edge and across a triangle. Edges that are sides of a triangle
    belong to its sheet. Balls in no edge and no triangle are kept as they are. The others share the rest of `count`:
    the sheets by the area of the triangles, the curves by half the squared length of the edges, as if each edge were a
    sheet of that area [1]_. Within the sheets balls are uniform by area, within the curves by length.

    Parameters
    ----------
    skeleton
        Balls with edges or triangles. Without any, at least `count` balls.
    count
        Balls wanted, at least 1.
    generator
        Source of the random positions.

    Returns
    -------
    Skeleton
        Just `count` balls, in the order isolated, of sheets, of curves, without edges, triangles and residues. From a
        skeleton without edges and triangles, `count` of its balls, drawn without replacement, in their order.

    Raises
    ------
    InputError
        If `count` is too small for the isolated balls and at least one other, or if the skeleton has fewer balls than
        `count` and nothing between them to be filled.

    Notes
    -----
    Positions are stratified: the k-th of n balls falls into the k-th of n equal parts of the total area or length. So a
    piece gets the number of balls that is its due, up to rounding, and not a random one. Pieces without any extent
    count as equal if there are no others.

    References
    ----------
    .. [1] The program released with C. Lin et al., "Point2Skeleton: Learning Skeletal Representations from Point
       Clouds", CVPR 2021.
    """
    if count < 1:
        raise InputError(f"count: expected at least 1 ball, got {count}")
    balls = np.column_stack([skeleton.points, skeleton.radii])
    edges = edges_outside_triangles(skeleton)
    if not len(edges) and not len(skeleton.triangles):
        if len(balls) < count:
            raise InputError(
                f"{count} balls cannot be drawn from {len(balls)}: the skeleton has no edges or triangles between them"
            )
        chosen = np.sort(generator.choice(len(balls), count, replace=False))
        return Skeleton(skeleton.points[chosen], skeleton.radii[chosen])
    isolated = np.setdiff1d(np.arange(len(balls)), np.concatenate([edges.ravel(), skeleton.triangles.ravel()]))
    wanted = count - len(isolated)
    if wanted < 1:
        raise InputError(
            f"count: {count} balls are too few for {len(isolated)} isolated ones and the pieces between others"
        )
    areas = triangle_areas(skeleton.points, skeleton.triangles)
    lengths = np.linalg.norm(np.diff(skeleton.points[edges], axis=1)[:, 0], axis=1)
    on_sheets = _sheet_share(areas, lengths, wanted)
    drawn = np.concatenate([
        balls[isolated],
        _on_triangles(balls[skeleton.triangles], areas, on_sheets, generator),
        _on_edges(balls[edges], lengths, wanted - on_sheets, generator),
    ])  # fmt: skip
    return Skeleton(drawn[:, :3], drawn[:, 3])


def edges_outside_triangles(skeleton: Skeleton) -> IntArray:
    """Return the edges of a skeleton that are no side of a triangle, ``(E, 2)`` int64, ascending, each once."""
    sides = np.sort(skeleton.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges = np.unique(np.sort(skeleton.edges, axis=1), axis=0)
    size = len(skeleton)
    kept: IntArray = edges[~np.isin(edges @ [size, 1], sides @ [size, 1])]
    return kept


def triangle_areas(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Return the area of each triangle, ``(T,)`` float64, in squared units."""
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas: FloatArray = np.linalg.norm(normals, axis=1) / 2
    return areas


def _sheet_share(areas: FloatArray, lengths: FloatArray, count: int) -> int:
    """Return how many of `count` balls the sheets get."""
    if not len(areas) or not len(lengths):
        return count if len(areas) else 0
    sheets, curves = areas.sum(), (lengths**2).sum() / 2
    if sheets + curves == 0:
        sheets, curves = len(areas), len(lengths)
    return round(count * float(sheets / (sheets + curves)))


def _pieces(extents: FloatArray, count: int, generator: np.random.Generator) -> IntArray:
    """Return `count` indices of pieces, ascending, in proportion to their extents."""
    total = extents.cumsum()
    if total[-1] == 0:
        total = np.arange(1.0, len(extents) + 1)
    positions = (np.arange(count) + generator.random(count)) / count * total[-1]
    # Rounding can put a position at the total, beyond the last piece that has any extent.
    last = np.searchsorted(total, total[-1], side="left")
    chosen: IntArray = np.minimum(np.searchsorted(total, positions, side="right"), last)
    return chosen


def _on_triangles(corners: FloatArray, areas: FloatArray, count: int, generator: np.random.Generator) -> FloatArray:
    """Draw from triangles whose corners are balls, ``(T, 3, 4)``."""
    if count == 0:
        return np.empty((0, 4))
    chosen = corners[_pieces(areas, count, generator)]
    # The square root makes the density constant: the lines parallel to a side are as long as far from the corner.
    from_corner, along = np.sqrt(generator.random(count)), generator.random(count)
    weights = np.stack([1 - from_corner, from_corner * (1 - along), from_corner * along], axis=1)
    drawn: FloatArray = (chosen * weights[:, :, None]).sum(axis=1)
    return drawn


def _on_edges(ends: FloatArray, lengths: FloatArray, count: int, generator: np.random.Generator) -> FloatArray:
    """Draw from edges whose ends are balls, ``(E, 2, 4)``."""
    if count == 0:
        return np.empty((0, 4))
    chosen = ends[_pieces(lengths, count, generator)]
    along = generator.random((count, 1))
    drawn: FloatArray = chosen[:, 0] * (1 - along) + chosen[:, 1] * along
    return drawn
