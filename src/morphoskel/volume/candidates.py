"""Candidate centres of maximal balls: points scattered in the bounding box (paper, section on occupancy).

Candidates are never stored. They are a pure function of box, count, mode and seed, made tile by tile, so that tiles
which lie outside the shape need not be made at all: what is left is the same as if all had been made and those
outside thrown away. Tiles come along a Morton curve: neighbours in space are neighbours in memory, which makes the
queries that follow several times faster.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray

TILE_POINTS = 64
"""Candidates a tile, about: few, so that the tiles that a surface crosses hold a small part of all candidates."""

TILE_SIDE = 4
"""Grid nodes a tile and axis."""

CHUNK_TILES = 1 << 12
"""Tiles handed out at once; bounds memory (3 MB a chunk)."""

Points = npt.NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Candidates:
    """Points in an axis-aligned box.

    Parameters
    ----------
    lower, upper
        ``(3,)`` corners of the box.
    count
        Points asked for. In grid mode ``floor(count ** (1/3))`` an axis, as in the released code.
    mode
        ``random``: independent and uniform in the box. ``grid``: regular from corner to corner, with equal
        counts, hence unequal spacings, along the axes.
    seed
        Of the random mode.

    Raises
    ------
    InputError
        If the box is empty.
    """

    lower: FloatArray
    upper: FloatArray
    count: int
    mode: Literal["random", "grid"] = "random"
    seed: int = 0

    def __post_init__(self) -> None:
        lower, upper = (np.asarray(corner, dtype=np.float64) for corner in (self.lower, self.upper))
        if lower.shape != (3,) or upper.shape != (3,) or not (lower < upper).all():
            raise InputError(f"the bounding box from {lower} to {upper} encloses no volume")
        object.__setattr__(self, "lower", lower)
        object.__setattr__(self, "upper", upper)

    @property
    def nodes_per_axis(self) -> int:
        """Grid mode: points along each axis."""
        # The small term keeps exact cubes, such as 1e6, from falling one short in floating point.
        return int(self.count ** (1 / 3) + 1e-9)

    def __len__(self) -> int:
        """Return the number of points in all tiles."""
        return self.count if self.mode == "random" else self.nodes_per_axis**3

    @property
    def tiles_per_axis(self) -> int:
        """Tiles along each axis of the box."""
        if self.mode == "grid":
            return -(-self.nodes_per_axis // TILE_SIDE)
        return max(round(float((self.count / TILE_POINTS) ** (1 / 3))), 1)

    @cached_property
    def cells(self) -> npt.NDArray[np.int32]:
        """Place of each tile among its like along the axes, ``(tiles, 3)``, in the order of the tiles."""
        from morphoskel.volume.candidate_kernels import morton_cells

        cells: npt.NDArray[np.int32] = morton_cells(self.tiles_per_axis)
        return cells

    @cached_property
    def edges(self) -> FloatArray:
        """Coordinates between which the tiles lie, ``(3, tiles_per_axis + 1)``."""
        corners = zip(self.lower, self.upper, strict=True)
        if self.mode == "random":
            return np.array([np.linspace(low, high, self.tiles_per_axis + 1) for low, high in corners])
        axes = self._axes.astype(np.float64)
        last = np.arange(TILE_SIDE - 1, self.nodes_per_axis - 1, TILE_SIDE)
        inner = (axes[:, last] + axes[:, last + 1]) / 2
        return np.column_stack([self.lower, inner, self.upper])

    @cached_property
    def counts(self) -> IntArray:
        """Points in each tile, ``(tiles,)`` int64.

        In random mode the counts of independent uniform points in equal cells, which are multinomial; given its
        count, the points of a cell are independent and uniform in it. So points made tile by tile have the same law
        as points drawn one by one.
        """
        if self.mode == "grid":
            nodes: IntArray = np.minimum(self.nodes_per_axis - self.cells * TILE_SIDE, TILE_SIDE).astype(np.int64)
            counts: IntArray = nodes.prod(axis=1)
            return counts
        stream = np.random.Generator(np.random.Philox(key=[self.seed, 0]))
        return stream.multinomial(self.count, np.full(len(self.cells), 1 / len(self.cells)))

    def points(self, tiles: IntArray) -> Points:
        """Return the points of some tiles, ``(n, 3)`` float32, tile after tile."""
        from morphoskel.volume import candidate_kernels as kernels

        offsets = np.concatenate([[0], np.cumsum(self.counts[tiles])])
        points = np.empty((offsets[-1], 3), dtype=np.float32)
        if self.mode == "random":
            size = (self.upper - self.lower) / self.tiles_per_axis
            kernels.place_random(self.cells, tiles, offsets, self.seed, self.lower, size, 0, len(tiles), points)
        else:
            kernels.place_nodes(self.cells, tiles, offsets, self._axes, TILE_SIDE, 0, len(tiles), points)
        return points

    def chunks(self) -> Iterator[Points]:
        """Yield all points in order, as arrays of the points of `CHUNK_TILES` tiles."""
        for start in range(0, len(self.cells), CHUNK_TILES):
            yield self.points(np.arange(start, min(start + CHUNK_TILES, len(self.cells))))

    @cached_property
    def _axes(self) -> Points:
        """Grid mode: coordinates of the nodes along each axis, ``(3, nodes_per_axis)``."""
        corners = zip(self.lower, self.upper, strict=True)
        axes = [np.linspace(low, high, self.nodes_per_axis) for low, high in corners]
        return np.array(axes).astype(np.float32)
