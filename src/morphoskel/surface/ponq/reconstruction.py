"""From an oriented cloud to a closed mesh by points, normals and quadrics (Maruani et al., CVPR 2024)."""

from __future__ import annotations

from typing import Literal

import numpy as np

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, Mesh, PointCloud
from morphoskel.surface.normals import complete_normals
from morphoskel.surface.ponq.cut import cut_surface
from morphoskel.surface.ponq.quadrics import QuadricVertices, fit_quadric_vertices
from morphoskel.surface.ponq.settings import FEWEST_SITES, PonqSettings, resolve_settings
from morphoskel.surface.ponq.sites import draw_sites, optimise_sites
from morphoskel.surface.ponq.tetrahedra import repair_tags, tag_tetrahedra, tetrahedralise

HALF_EXTENT = 0.9
"""Half the largest side of the shape's box inside the cube ``[-1, 1]^3``: the vertices need some room around it."""

FLAT = 1e-6
"""Thickness of a cloud, relative to its box, below which it encloses nothing."""

REACH_IN_SQUARED_CELLS = 3
"""How spread out a tetrahedron may be that the repair changes, see `repair_tags`."""


def reconstruct_ponq(
    cloud: PointCloud,
    *,
    seed: int,
    preset: Literal["sound", "released"] = "sound",
    sites: int | None = None,
    with_replacement: bool | None = None,
    steps: int | None = None,
    learning_rate: float | None = None,
    sample_fraction: float | None = None,
    grid: int | None = None,
) -> Mesh:
    """Spread sites over the cloud, fit a vertex to each, and cut the Delaunay tetrahedra of the vertices in two.

    Parameters
    ----------
    cloud
        Points on the surface; missing normals are completed.
    seed
        Of the drawing of the sites, and of the batches if a step does not use all points.
    preset
        ``sound``: a quarter as many sites as points, distinct, every point in every step, and a grid whose cells are
        about as wide as the sites are apart: with a finer one, sparse clouds lose parts that the repair cannot reach.
        ``released``: 50 000 sites drawn with replacement, a tenth of the points in each step, a grid of 128, as in the
        released program; on 10 000 points nearly every cell then holds one sample, and the vertices are hardly more
        than the points themselves.
    sites, with_replacement, steps, learning_rate, sample_fraction, grid
        See `PonqSettings`; ``None`` for the value of the preset.

    Returns
    -------
    Mesh
        Closed, free of self-intersection, outward oriented. Possibly several pieces, which may touch in edges or
        vertices.

    Raises
    ------
    ConfigError
        If there is no such preset or a value is out of its range.
    ShapeError
        If the points lie in a plane, are too few for the sites, or lack normals that cannot be estimated; or if the
        normals leave no tetrahedron inside.

    Notes
    -----
    The shape is brought to the cube ``[-1, 1]^3`` first, and back in the end, so that the result scales with it.
    Where the released program differs from this one in either preset: it moves the initial sites by 1e-5, leaves
    coincident vertices to Qhull, and repairs fewer tags (see `repair_tags`).
    """
    settings = resolve_settings(
        preset,
        sites=sites,
        with_replacement=with_replacement,
        steps=steps,
        learning_rate=learning_rate,
        sample_fraction=sample_fraction,
        grid=grid,
    )
    lower, upper = cloud.points.min(axis=0), cloud.points.max(axis=0)
    centre, scale = (lower + upper) / 2, float((upper - lower).max()) / 2 / HALF_EXTENT
    points = (cloud.points - centre) / scale
    _check_encloses_volume(cloud, points)
    distinct = np.unique(points, axis=0)
    count = _count_sites(distinct, settings)
    candidates = points if settings.with_replacement else distinct
    generator = np.random.default_rng(seed)
    vertices = _fit_vertices(candidates, points, complete_normals(cloud), count, settings, generator)

    cells = settings.count_cells(count)
    tetrahedra = tetrahedralise(vertices.positions)
    tags = tag_tetrahedra(tetrahedra, vertices.normals)
    tags = repair_tags(tetrahedra, tags, reach=REACH_IN_SQUARED_CELLS * (2 / cells) ** 2)
    triangles = cut_surface(tetrahedra, vertices, tags, grid=cells)
    used, renumbered = np.unique(triangles, return_inverse=True)
    return Mesh(vertices.positions[used] * scale + centre, renumbered.reshape(-1, 3))


def _check_encloses_volume(cloud: PointCloud, points: FloatArray) -> None:
    thickness = float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1]) / np.sqrt(len(points))
    if thickness < FLAT:
        raise ShapeError(f"ponq: the points of {cloud!r} lie in a plane and enclose no volume")


def _count_sites(distinct: FloatArray, settings: PonqSettings) -> int:
    count = settings.count_sites(len(distinct))
    if count < FEWEST_SITES:
        raise ShapeError(
            f"ponq: {len(distinct)} distinct points give {count} sites, and a tetrahedron needs {FEWEST_SITES}; set "
            "sites or use a denser cloud"
        )
    return count


def _fit_vertices(
    candidates: FloatArray,
    points: FloatArray,
    normals: FloatArray,
    count: int,
    settings: PonqSettings,
    generator: np.random.Generator,
) -> QuadricVertices:
    sites = draw_sites(candidates, count, with_replacement=settings.with_replacement, generator=generator)
    sites = optimise_sites(
        sites,
        points,
        steps=settings.steps,
        learning_rate=settings.learning_rate,
        batch=settings.count_batch(len(points)),
        generator=generator,
    )
    return fit_quadric_vertices(points, normals, sites)
