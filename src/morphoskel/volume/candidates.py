"""Candidate centres of maximal balls: points scattered in the bounding box (paper, section on occupancy).

Candidates are never stored. They are a pure function of box, count, mode and seed, and they come in spatial
order, tile after tile along a Morton curve: neighbours in space are neighbours in memory, which by itself makes the
distance and neighbour queries that follow two to three times faster.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray

TILE_POINTS = 1024
"""Candidates a tile, about; small enough for a tile to stay in cache, large enough to amortise its generator."""

CHUNK_POINTS = 1 << 18
"""Candidates handed out at once; bounds memory (3 MB a chunk)."""


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
        """Return the number of points that :meth:`chunks` yields in all."""
        return self.count if self.mode == "random" else self.nodes_per_axis**3

    def chunks(self) -> Iterator[npt.NDArray[np.float32]]:
        """Yield the points in spatial order, as ``(n, 3)`` float32 arrays of about `CHUNK_POINTS` rows."""
        pending: list[npt.NDArray[np.float32]] = []
        size = 0
        for tile in self._random_tiles() if self.mode == "random" else self._grid_tiles():
            pending.append(tile)
            size += len(tile)
            if size >= CHUNK_POINTS:
                yield np.concatenate(pending)
                pending, size = [], 0
        if pending:
            yield np.concatenate(pending)

    def _random_tiles(self) -> Iterator[npt.NDArray[np.float32]]:
        """Draw how many points fall into each tile, then place them: the same law as drawing them one by one.

        The counts of independent uniform points in equal cells are multinomial, and given its count the points of
        a cell are independent and uniform in it. Each tile has a counter-based stream of its own.
        """
        tiles = max(round((self.count / TILE_POINTS) ** (1 / 3)), 1)
        counts = np.random.Generator(np.random.Philox(key=[self.seed, 0])).multinomial(
            self.count, np.full(tiles**3, tiles**-3.0)
        )
        size = (self.upper - self.lower) / tiles
        for number, (cell, count) in enumerate(zip(_morton_cells(tiles), counts, strict=True), start=1):
            if count:
                stream = np.random.Generator(np.random.Philox(key=[self.seed, number]))
                yield (self.lower + (cell + stream.random((count, 3))) * size).astype(np.float32)

    def _grid_tiles(self) -> Iterator[npt.NDArray[np.float32]]:
        axes = [np.linspace(low, high, self.nodes_per_axis) for low, high in zip(self.lower, self.upper, strict=True)]
        side = round(TILE_POINTS ** (1 / 3))
        for cell in _morton_cells(-(-self.nodes_per_axis // side)):
            parts = [
                axis[start * side : (start + 1) * side] for axis, start in zip(axes, cell.astype(int), strict=True)
            ]
            yield np.stack(np.meshgrid(*parts, indexing="ij"), axis=-1).reshape(-1, 3).astype(np.float32)


def _morton_cells(cells_per_axis: int) -> FloatArray:
    """Return the integer coordinates ``(cells_per_axis ** 3, 3)`` of all cells, along a Morton curve."""
    axis = np.arange(cells_per_axis, dtype=np.int64)
    cells = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    code = np.zeros(len(cells), dtype=np.int64)
    for bit in range(int(cells_per_axis).bit_length()):
        for dimension in range(3):
            code |= ((cells[:, dimension] >> bit) & 1) << (3 * bit + dimension)
    return cells[np.argsort(code)].astype(np.float64)
