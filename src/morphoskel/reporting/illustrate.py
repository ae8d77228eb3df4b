"""Take one shape through the chain of MorphoSkel3D and keep what lies between its stages.

The stages, their settings and their seeds are those of :func:`morphoskel.skeletonization.skeletonize_shape`: the
points selected are the skeleton that it returns.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from morphoskel.cores import available_cores
from morphoskel.reporting.illustration import Illustration
from morphoskel.seeds import derive_generator, derive_seed
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud
from morphoskel.volume import Candidates

RESIDUE_DECADES, BINS_A_DECADE = 6, 6
"""Bins of the residues, equal in logarithm from the longest side of the surface's box downwards; the rest is one."""


@dataclass(frozen=True)
class Limits:
    """How much is kept for drawing: points of the cloud, candidates, and inner points beside those selected."""

    cloud: int = 10_000
    candidates: int = 10_000
    inner: int = 60_000


def illustrate(
    shape: PointCloud | Mesh,
    *,
    name: str,
    candidates: Mapping[str, Any],
    k: int,
    points: int,
    seed: int,
    surface: str = "poisson",
    reconstruction: Mapping[str, Any] | None = None,
    watertight_settings: Mapping[str, Any] | None = None,
    is_closed: bool = False,
    limits: Limits | None = None,
    threads: int = 0,
) -> Illustration:
    """Take one shape through the chain.

    Parameters
    ----------
    shape
        A cloud, whose surface is rebuilt and closed, or a mesh, which is closed.
    name
        Of the shape; with `seed`, it decides all that is random.
    candidates
        ``mode`` and ``count``, as in the configuration.
    k, points
        Size of the structuring element; points selected.
    seed
        The global seed.
    surface, reconstruction
        Name and settings of the reconstruction of a cloud.
    watertight_settings
        Settings of the watertight conversion.
    is_closed
        The mesh is closed as it is; the conversion, which rounds edges, is left out.
    limits
        How much is kept for drawing.
    threads
        Native threads; 0 means all cores. Does not change the result.

    Returns
    -------
    Illustration
        With all points that were selected, whatever the limits.

    Raises
    ------
    ConfigError
        If there is no such reconstruction.
    ShapeError
        If no surface can be rebuilt, it is not closed, or no candidate lies inside.
    """
    from morphoskel.surface import reconstruct, watertight

    mesh = shape
    if isinstance(mesh, PointCloud):
        mesh = reconstruct(mesh, surface, seed=derive_seed(seed, name, "reconstruct"), **(reconstruction or {}))
    if not is_closed:
        mesh = watertight(mesh, seed=derive_seed(seed, name, "watertight"), **(watertight_settings or {}))
    limits, generator = limits or Limits(), derive_generator(seed, name, "illustration")
    scattered = Candidates(*mesh.bounds, **candidates, seed=derive_seed(seed, name, "occupancy"))
    return Illustration(
        name=name,
        cloud=_some_of_cloud(shape, limits.cloud, generator),
        surface=mesh,
        mode=scattered.mode,
        k=k,
        candidate_count=len(scattered),
        **_stages(mesh, scattered, k, points, limits, generator, threads or available_cores()),
    )


def residue_edges(surface: Mesh) -> FloatArray:
    """Return the edges between which residues are counted; they are equal where the surface's box is."""
    lower, upper = surface.bounds
    shares = np.logspace(-RESIDUE_DECADES, 0, RESIDUE_DECADES * BINS_A_DECADE + 1)
    return np.concatenate([[0.0], float((upper - lower).max()) * shares])


def _stages(
    mesh: Mesh,
    scattered: Candidates,
    k: int,
    points: int,
    limits: Limits,
    generator: np.random.Generator,
    threads: int,
) -> dict[str, Any]:
    """Run the stages from the occupancy to the selection and return what is kept of each."""
    from morphoskel.morphology import dilation
    from morphoskel.morphology.residue import residue
    from morphoskel.skeleton.selection import select_smallest_residues
    from morphoskel.volume import SurfaceDistance, occupancy

    tested = occupancy(mesh, scattered, threads=threads)
    inner = tested.inner_points(threads=threads)
    udf = SurfaceDistance(mesh)(inner, threads=threads)
    dilated = dilation(inner, udf, k, threads=threads)
    residues = residue(udf, dilated)
    chosen = select_smallest_residues(residues, udf, points)
    kept = np.union1d(_some(len(inner), limits.inner, generator), chosen)
    shown = _some(len(scattered), limits.candidates, generator)
    edges = residue_edges(mesh)
    return {
        "inner_count": len(inner),
        "candidates": _take(scattered, shown),
        "inside": tested.mask()[shown],
        "inner": inner[kept].astype(np.float64),
        "udf": udf[kept],
        "dilated": dilated[kept],
        "selected": np.searchsorted(kept, chosen).astype(np.int64),
        "residue_edges": edges,
        "residue_counts": np.histogram(residues, edges)[0].astype(np.int64),
    }


def _some(count: int, limit: int, generator: np.random.Generator) -> IntArray:
    """Return at most `limit` distinct numbers below `count`, increasing."""
    if count <= limit:
        return np.arange(count)
    return np.sort(generator.choice(count, limit, replace=False, shuffle=False))


def _take(scattered: Candidates, rows: IntArray) -> FloatArray:
    """Return some of the candidates, ``(len(rows), 3)``; never all are in memory at once."""
    parts, before = [], 0
    for chunk in scattered.chunks():
        first, last = np.searchsorted(rows, [before, before + len(chunk)])
        parts.append(chunk[rows[first:last] - before])
        before += len(chunk)
    return np.concatenate(parts).astype(np.float64)


def _some_of_cloud(shape: PointCloud | Mesh, limit: int, generator: np.random.Generator) -> FloatArray:
    from morphoskel.formats.sample import sample_surface

    cloud = sample_surface(shape, limit, generator) if isinstance(shape, Mesh) else shape
    return cloud.points[_some(len(cloud), limit, generator)]
