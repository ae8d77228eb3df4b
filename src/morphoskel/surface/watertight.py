"""Turn any triangle soup into a closed surface (Huang, Su and Guibas 2018, *Manifold*)."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import ShapeError
from morphoskel.placement import check_extent, remoteness
from morphoskel.shapes import Mesh

LARGEST_SEED = 2**31 - 1
"""The native function takes a C ``int`` and reads anything below 1 as "unseeded"."""

MOST_REMOTE = 4096.0
"""Largest coordinate in extents at which single precision still has some 4000 steps across the shape."""


def watertight(mesh: Mesh, *, seed: int, resolution: int = 20_000) -> Mesh:
    """Return a closed, consistently oriented surface around `mesh`.

    The native function returns the outer boundary of the octree's cells through which the surface passes, smoothed, so
    its result lies outside: by about 0.02 times half the longest side around a sphere or a cube with 20,000 leaves, and
    by half of that with four times as many. What a component encloses, a cavity or another component, counts as solid.
    It also works with lengths of its own, such as 5e-4, in absolute terms, so the mesh is first brought to the cube
    ``[-1, 1]^3``, the frame of the published clouds, and back afterwards: the result scales with the shape.

    Parameters
    ----------
    mesh
        Any mesh with some extent.
    seed
        Any non-negative integer, folded into the native function's range.
    resolution
        Number of octree leaves at which the surface is extracted; 20,000 in the paper.

    Returns
    -------
    Mesh
        Vertices are rounded to float32, the precision in which distances to the surface are computed.

    Raises
    ------
    ShapeError
        If the mesh has no usable extent, lies too far from the origin, or the conversion yields nothing.
    """
    import point_cloud_utils

    lower, upper = check_extent(mesh)
    centre, half_extent = (lower + upper) / 2, float((upper - lower).max()) / 2
    if remoteness(lower, upper) > MOST_REMOTE:
        raise ShapeError(
            f"watertight: {mesh!r} lies {remoteness(lower, upper):.3g} times its extent from the origin, where single "
            "precision cannot resolve it; move it nearer"
        )
    vertices, triangles = point_cloud_utils.make_mesh_watertight(
        (mesh.vertices - centre) / half_extent, mesh.triangles, resolution, seed % LARGEST_SEED + 1
    )
    if len(triangles) == 0:
        raise ShapeError(f"watertight: the conversion of {mesh!r} gave no triangles")
    restored = np.asarray(vertices) * half_extent + centre
    return Mesh(restored.astype(np.float32).astype(np.float64), np.asarray(triangles))
