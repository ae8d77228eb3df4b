"""Which candidates lie inside a closed surface (paper, Eq. 3)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.compiled import run_blocks
from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, IntArray, Mesh
from morphoskel.volume.candidates import Candidates

OUTSIDE, INSIDE, CROSSED = 0, 1, 2
"""What a tile of candidates can be: wholly outside, wholly inside, or crossed by the surface."""

BLOCK_TILES = 1 << 10


@dataclass(frozen=True, eq=False)
class Occupancy:
    """Which candidates lie inside: the state of each tile, and a mask for the tiles that the surface crosses.

    Parameters
    ----------
    candidates
        The points asked about.
    states
        ``(tiles,)`` uint8, `OUTSIDE`, `INSIDE` or `CROSSED`.
    crossed_mask
        ``(candidates in crossed tiles,)`` bool, in their order.
    """

    candidates: Candidates
    states: npt.NDArray[np.uint8]
    crossed_mask: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        """Return the number of candidates inside."""
        return int(self.candidates.counts[self.states == INSIDE].sum() + self.crossed_mask.sum())

    def mask(self) -> npt.NDArray[np.bool_]:
        """Return which candidates lie inside, ``(len(candidates),)`` bool."""
        states = np.repeat(self.states, self.candidates.counts)
        mask: npt.NDArray[np.bool_] = states == INSIDE
        mask[states == CROSSED] = self.crossed_mask
        return mask

    def inner_points(self, *, threads: int = 1) -> npt.NDArray[np.float32]:
        """Make the candidates inside, ``(len(self), 3)`` float32 in spatial order; those outside are passed over."""
        tiles = np.flatnonzero(self.states != OUTSIDE)
        sizes = np.where(self.states[tiles] == INSIDE, self.candidates.counts[tiles], self._inside_crossed[tiles])
        offsets = np.concatenate([[0], np.cumsum(sizes)])
        inner = np.empty((offsets[-1], 3), dtype=np.float32)

        def make(start: int, stop: int) -> None:
            points = self.candidates.points(tiles[start:stop])
            inner[offsets[start] : offsets[stop]] = points[self._mask_of(tiles[start:stop])]

        run_blocks(make, len(tiles), block=BLOCK_TILES, threads=threads)
        return inner

    @cached_property
    def _crossed_offsets(self) -> IntArray:
        """Position of each tile's candidates in the mask; of use for crossed tiles only."""
        counts = np.where(self.states == CROSSED, self.candidates.counts, 0)
        return np.concatenate([[0], np.cumsum(counts)])

    @cached_property
    def _inside_crossed(self) -> IntArray:
        """Number of candidates inside in each crossed tile."""
        sums = np.concatenate([[0], np.cumsum(self.crossed_mask, dtype=np.int64)])
        return np.diff(sums[self._crossed_offsets])

    def _mask_of(self, tiles: IntArray) -> npt.NDArray[np.bool_]:
        """Return which candidates of consecutive non-outside tiles lie inside."""
        states = np.repeat(self.states[tiles], self.candidates.counts[tiles])
        mask: npt.NDArray[np.bool_] = states == INSIDE
        mask[states == CROSSED] = self.crossed_mask[
            self._crossed_offsets[tiles[0]] : self._crossed_offsets[tiles[-1] + 1]
        ]
        return mask


def occupancy(mesh: Mesh, candidates: Candidates, *, threads: int = 1) -> Occupancy:
    """Tell which candidates lie inside: a line from them crosses the surface an odd number of times (Eq. 3).

    Parameters
    ----------
    mesh
        Closed surface; several components, nested ones and any orientation are fine.
    candidates
        Points in any box.
    threads
        Threads of the test. Does not change the result.

    Returns
    -------
    Occupancy
        Exact for the mesh rounded to 2**-25 of the box, about the resolution of float32.

    Raises
    ------
    ShapeError
        If the surface is not closed, or no candidate lies inside.
    """
    from morphoskel.volume import occupancy_kernels as kernels

    lattice = _Lattice(mesh, candidates)
    corners = lattice.round(mesh.vertices)[mesh.triangles]
    if kernels.edge_checksum(corners) != 0:
        raise ShapeError(_describe_open(corners))
    n, cells = candidates.tiles_per_axis, candidates.cells
    edges, margin = lattice.scale_to(candidates.edges), lattice.margin
    starts, triangles = _triangles_of_tiles(corners, edges, margin)
    touched = np.diff(starts).reshape(n, n, n) > 0
    centres_inside = kernels.columns_inside(corners, np.rint((edges[:, :-1] + edges[:, 1:]) / 2))
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    ends_free = np.column_stack([low >= edges[:, 0] - margin, high <= edges[:, -1] + margin]).ravel()
    directions = kernels.choose_directions(touched, ends_free)
    x, y, z = cells.T
    states = np.where(touched[x, y, z], CROSSED, centres_inside[x, y, z]).astype(np.uint8)
    crossed = np.flatnonzero(states == CROSSED)

    def test(start: int, stop: int) -> npt.NDArray[np.bool_]:
        tiles = crossed[start:stop]
        points = lattice.round(candidates.points(tiles)).T.copy()
        offsets = np.concatenate([[0], np.cumsum(candidates.counts[tiles])])
        inside = np.zeros(points.shape[1], dtype=np.bool_)
        kernels.test_points(
            points, offsets, cells[tiles], corners, edges, starts, triangles, directions, centres_inside, inside
        )
        return inside

    parts = run_blocks(test, len(crossed), block=BLOCK_TILES, threads=threads)
    result = Occupancy(candidates, states, np.concatenate([np.empty(0, dtype=np.bool_), *parts]))
    if len(result) == 0:
        raise ShapeError(
            f"none of the {len(candidates):,} candidates lies inside the surface; it may be too thin for them: "
            "raise skeleton.candidates.count, or check that the surface is closed"
        )
    return result


class _Lattice:
    """Integer coordinates, exact in float64, in the box around surface and candidates."""

    def __init__(self, mesh: Mesh, candidates: Candidates) -> None:
        from morphoskel.volume.occupancy_kernels import LATTICE

        lower, upper = mesh.bounds
        self._origin = np.minimum(lower, candidates.lower)
        extent = np.maximum(upper, candidates.upper) - self._origin
        self._scale = LATTICE / extent
        # Points are float32: they may lie beside the tile that they were made for by a few units in the last place.
        largest = np.abs([self._origin, self._origin + extent]).max(axis=0).astype(np.float32)
        self.margin: FloatArray = 2 + 4 * np.spacing(largest).astype(np.float64) * self._scale

    def scale_to(self, coordinates: FloatArray) -> FloatArray:
        """Return ``(3, n)`` coordinates in lattice steps, not rounded."""
        return np.ascontiguousarray((coordinates - self._origin[:, None]) * self._scale[:, None])

    def round(self, points: npt.NDArray[Any]) -> FloatArray:
        """Return ``(n, 3)`` points in whole lattice steps."""
        return np.ascontiguousarray(np.rint((points - self._origin) * self._scale))


def _triangles_of_tiles(corners: FloatArray, edges: FloatArray, margin: FloatArray) -> tuple[IntArray, IntArray]:
    """Return where the list of each tile begins, ``(tiles + 1,)``, and the lists of triangles that touch the tiles."""
    from morphoskel.volume.occupancy_kernels import list_triangles

    starts = np.zeros((edges.shape[1] - 1) ** 3 + 1, dtype=np.int64)
    list_triangles(corners, edges, margin, starts, np.empty(0, dtype=np.int64))
    starts = np.cumsum(starts)
    triangles = np.empty(starts[-1], dtype=np.int64)
    list_triangles(corners, edges, margin, starts[:-1].copy(), triangles)
    return starts, triangles


def _describe_open(corners: FloatArray) -> str:
    """Say how far a surface is from closed."""
    vertices, triangles = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    ends = triangles.reshape(-1, 3)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges, uses = np.unique(np.sort(ends[ends[:, 0] != ends[:, 1]], axis=1), axis=0, return_counts=True)
    return (
        f"the surface is not closed: {int((uses % 2).sum()):,} of its {len(edges):,} edges border an odd number of "
        f"triangles ({len(vertices):,} vertices, {len(corners):,} triangles), so inside and outside are not defined; "
        "close it with morphoskel.surface.watertight"
    )
