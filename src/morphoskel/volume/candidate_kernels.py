"""Compiled generation of candidate points, tile by tile."""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from morphoskel.compiled import kernel

ROUNDS = 10
MULTIPLIERS = (np.uint64(0xD2E7470EE14C6C93), np.uint64(0xCA5A826395121157))
KEY_STEPS = (np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBB67AE8584CAA73B))


@kernel
def morton_cells(cells_per_axis):
    """Return the coordinates ``(cells_per_axis ** 3, 3)`` int32 of all cells of a cube, along a Morton curve."""
    cells = np.empty((cells_per_axis**3, 3), np.int32)
    coordinates = np.empty(3, np.int32)
    found, code = 0, 0
    while found < len(cells):
        coordinates[:] = 0
        remaining, bit = code, 0
        while remaining:
            for axis in range(3):
                coordinates[axis] |= np.int32((remaining >> axis & 1) << bit)
            remaining >>= 3
            bit += 1
        if coordinates.max() < cells_per_axis:
            cells[found] = coordinates
            found += 1
        code += 1
    return cells


@intrinsic  # type: ignore[untyped-decorator]
def _high_half(_typing: Any, first: Any, second: Any) -> Any:
    """Return the upper 64 bits of the product of two uint64 numbers."""

    def generate(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        wide = ir.IntType(128)
        product = builder.mul(*(builder.zext(argument, wide) for argument in arguments))
        return builder.trunc(builder.lshr(product, ir.Constant(wide, 64)), ir.IntType(64))

    return types.uint64(first, second), generate


@kernel
def _philox(counter, first_key, second_key, numbers):
    """Write four random 64-bit numbers: Philox4x64-10 (Salmon et al. 2011), as in NumPy."""
    a, b, c, d = np.uint64(counter), np.uint64(0), np.uint64(0), np.uint64(0)
    first_key, second_key = np.uint64(first_key), np.uint64(second_key)
    for _ in range(ROUNDS):
        low_a, low_c = MULTIPLIERS[0] * a, MULTIPLIERS[1] * c
        high_a, high_c = _high_half(MULTIPLIERS[0], a), _high_half(MULTIPLIERS[1], c)
        a, b, c, d = high_c ^ b ^ first_key, low_c, high_a ^ d ^ second_key, low_a
        first_key += KEY_STEPS[0]
        second_key += KEY_STEPS[1]
    numbers[0], numbers[1], numbers[2], numbers[3] = a, b, c, d


@kernel
def place_random(cells, tiles, offsets, seed, lower, size, start, stop, points):
    """Write the points of the tiles from `start` to `stop`: independent, uniform in the tile's cell.

    Each tile has a stream of its own, keyed by its number: the doubles that ``numpy.random.Philox`` with the key
    ``[seed, tile + 1]`` gives. The points of tile ``tiles[i]`` go to the rows from ``offsets[i]`` to
    ``offsets[i + 1]``.
    """
    numbers = np.empty(4, np.uint64)
    for i in range(start, stop):
        tile = tiles[i]
        drawn = 0
        for p in range(offsets[i], offsets[i + 1]):
            for axis in range(3):
                if drawn % 4 == 0:
                    _philox(drawn // 4 + 1, seed, tile + 1, numbers)
                share = np.float64(numbers[drawn % 4] >> np.uint64(11)) * 2.0**-53
                points[p, axis] = lower[axis] + (cells[tile, axis] + share) * size[axis]
                drawn += 1


@kernel
def place_nodes(cells, tiles, offsets, axes, side, start, stop, points):
    """Write the grid nodes of the tiles from `start` to `stop`; a tile has `side` nodes an axis, fewer at the end."""
    nodes = axes.shape[1]
    for i in range(start, stop):
        x, y, z = cells[tiles[i]] * side
        p = offsets[i]
        for near_x in range(x, min(x + side, nodes)):
            for near_y in range(y, min(y + side, nodes)):
                for near_z in range(z, min(z + side, nodes)):
                    points[p, 0], points[p, 1], points[p, 2] = axes[0, near_x], axes[1, near_y], axes[2, near_z]
                    p += 1
