"""The k-nearest-neighbour structuring element on a cloud of points (paper, Eq. 6)."""

from __future__ import annotations

from functools import cached_property, partial
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.compiled import run_blocks
from morphoskel.errors import InputError
from morphoskel.morphology import cell_kernels, neighbour_kernels
from morphoskel.shapes import FloatArray, IntArray

POINTS_A_CELL = 8
"""Aimed at; the fewer, the smaller the window around a cell, and the more often it has to be widened."""

LARGEST_CELL = 16
"""Points a non-empty cell, on average, above which the cells are made smaller."""

CELLS_A_POINT = 8
"""Cells are not made smaller once there are so many; each takes eight bytes."""

BLOCK_CELLS = 4096
BLOCK_POINTS = 1 << 16

Values = npt.NDArray[np.float32]


class StructuringElement:
    r"""The neighbourhoods over which a function on points is dilated and eroded.

    .. math:: SE(x) = \{y : |x - y| \le |x - x_k|\}

    where :math:`x_k` is the `k`-th nearest point of `x`, itself included. Points exactly as far as the `k`-th all
    belong to it, so that the neighbourhood depends on nothing but the points; the published program keeps one of
    them, whichever its search meets first. Distances are compared in float32, as there.

    Parameters
    ----------
    points
        ``(N, 3)`` float32, finite, in any order. Meant for samples of a volume or a surface; where some parts are a
        thousand times denser than others the search becomes slow.
    k
        Size; with fewer points than that, all of them. 20 in the paper.
    threads
        Threads of the search. Results do not depend on it.

    Raises
    ------
    InputError
        If the points have another shape or are not finite, or if `k` is not positive.
    """

    def __init__(self, points: npt.NDArray[np.float32], k: int = 20, *, threads: int = 1) -> None:
        if points.ndim != 2 or points.shape[1] != 3:
            raise InputError(f"structuring element: expected points (N, 3), got an array {points.shape}")
        if k < 1:
            raise InputError(f"structuring element: it needs k >= 1 points, got k = {k}")
        self.threads = threads
        self.k = min(k, len(points))
        if len(points) == 0:
            return
        points = np.ascontiguousarray(points, dtype=np.float32)
        self._lower, upper = cell_kernels.bounds(points)
        if not np.isfinite([self._lower, upper]).all():
            raise InputError("structuring element: a point has a NaN or infinite coordinate; remove it")
        self._side, self._cells, self._starts, numbers = self._choose_cells(points, upper - self._lower)
        self._order = cell_kernels.sort_into_cells(numbers, self._starts)
        self._points = np.empty((3, len(points)), dtype=np.float32)
        run_blocks(
            partial(cell_kernels.take, points, self._order, self._points),
            len(points),
            block=BLOCK_POINTS,
            threads=threads,
        )

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self._order) if self.k else 0

    def dilate(self, values: Values) -> Values:
        """Return the largest of `values`, ``(N,)`` float32, in the structuring element of each point."""
        return self._search(values, np.empty(0, dtype=np.int32))

    def erode(self, values: Values) -> Values:
        """Return the smallest of `values`, ``(N,)`` float32, in the structuring element of each point."""
        return -self.dilate(-values)

    def spread(self, values: Values) -> Values:
        """Return the largest of `values` among the points whose structuring element holds each point.

        The dilation by the transposed element: the adjoint of :meth:`erode`.
        """
        keys = self._sorted_keys(values)
        if len(self) == 0:
            return self._unsorted_values(keys)
        cells, radii = int(np.prod(self._cells)), self._radii

        def spread_block(start: int, stop: int) -> npt.NDArray[np.int32]:
            spread = keys.copy()
            neighbour_kernels.spread_over_cells(
                self._points, keys, radii, self._starts, self._cells, self._side, start, stop, spread
            )
            return spread

        parts = run_blocks(spread_block, cells, block=max(-(-cells // self.threads), 1), threads=self.threads)
        return self._unsorted_values(np.maximum.reduce(parts))

    @cached_property
    def _radii(self) -> npt.NDArray[np.int32]:
        """Squared distance of the `k`-th neighbour, as the bits of a float32, in the order of the cells."""
        radii = np.empty(len(self), dtype=np.int32)
        self._search(np.zeros(len(self), dtype=np.float32), radii)
        return radii

    def _search(self, values: Values, radii: npt.NDArray[np.int32]) -> Values:
        keys = self._sorted_keys(values)
        dilated = np.empty_like(keys)
        growth = neighbour_kernels.growth_table()
        run_blocks(
            lambda first, last: neighbour_kernels.dilate_cells(
                self._points, keys, self._starts, self._cells, self._lower, self._side, self.k, growth, first, last,
                dilated, radii,
            ),
            int(np.prod(self._cells)) if len(self) else 0,
            block=BLOCK_CELLS,
            threads=self.threads,
        )  # fmt: skip
        return self._unsorted_values(dilated)

    def _sorted_keys(self, values: Values) -> npt.NDArray[np.int32]:
        """Return integers that are ordered like the values, in the order of the cells."""
        if values.shape != (len(self),) or np.isnan(values).any():
            raise InputError(f"structuring element: expected {len(self)} values, none NaN, got {values.shape}")
        if len(self) == 0:
            return np.empty(0, dtype=np.int32)
        return _flip_negative(values.astype(np.float32, copy=False)[self._order].view(np.int32))

    def _unsorted_values(self, keys: npt.NDArray[np.int32]) -> Values:
        values = np.empty(len(self), dtype=np.float32)
        if len(self):
            values[self._order] = _flip_negative(keys).view(np.float32)
        return values

    def _choose_cells(self, points: Values, extent: FloatArray) -> tuple[float, IntArray, IntArray, Any]:
        """Choose cells that hold few points each, yet are not too many themselves.

        What matters is how full the cells are that hold points at all; a solid may fill any part of its box.

        Returns
        -------
        side, cells, starts, numbers
            Side and number of the cells along the axes; position of the first point of each cell; cell of each point.
        """
        thickness = np.maximum(extent, extent.max() * 1e-3)
        side = float((thickness.prod() * 4 * POINTS_A_CELL / len(points)) ** (1 / 3)) or 1.0  # all in one place
        numbers = np.empty(len(points), dtype=np.int32)
        while True:
            cells = np.maximum(np.ceil(extent / side), 1).astype(np.int64)
            run_blocks(
                partial(cell_kernels.cell_numbers, points, self._lower, side, cells, numbers),
                len(points),
                block=BLOCK_POINTS,
                threads=self.threads,
            )
            counts = cell_kernels.count_points(numbers, int(np.prod(cells)))
            fullness = len(points) / int(np.count_nonzero(counts))
            smaller = side * (POINTS_A_CELL / fullness) ** (1 / 3)
            too_many = np.prod(extent / smaller + 1) > CELLS_A_POINT * len(points) + 1000
            if fullness <= LARGEST_CELL or too_many or not extent.any():
                return side, cells, np.cumsum(counts), numbers
            side = smaller


def _flip_negative(bits: Any) -> npt.NDArray[np.int32]:
    """Turn the bits of float32 numbers into integers of the same order, and back: it is its own inverse."""
    flipped: npt.NDArray[np.int32] = bits ^ ((bits >> 31) & np.int32(0x7FFFFFFF))
    return flipped
