"""Balls as one triangle mesh."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import IntArray, Mesh, Skeleton

MOST_SUBDIVISIONS = 5
"""More would give each ball 81,920 triangles or more."""

FINEST_BY_CHOICE = 4
"""What :func:`subdivisions_within` stops at: the outline of a ball is round to 0.1 % of its radius."""

TRIANGLES_OF_ICOSAHEDRON = 20


def ball_mesh(skeleton: Skeleton, *, subdivisions: int) -> tuple[Mesh, IntArray]:
    """Return all balls as icospheres in one mesh.

    Parameters
    ----------
    skeleton
        Centres and radii; at least one ball.
    subdivisions
        How often the triangles of an icosahedron are cut in four, from 0 to :data:`MOST_SUBDIVISIONS`. The corners lie
        on the sphere, the triangles inside it.

    Returns
    -------
    mesh
        ``K * (10 * 4**subdivisions + 2)`` vertices and ``K * 20 * 4**subdivisions`` triangles, ball by ball.
    owner
        ``(V,)`` int64, the ball that each vertex lies on.

    Raises
    ------
    InputError
        If there is no ball, or `subdivisions` is out of range.
    """
    import trimesh

    if len(skeleton) == 0:
        raise InputError("the skeleton has no balls, so there is nothing to draw")
    if not 0 <= subdivisions <= MOST_SUBDIVISIONS:
        raise InputError(f"subdivisions: expected a number from 0 to {MOST_SUBDIVISIONS}, got {subdivisions}")
    sphere = trimesh.creation.icosphere(subdivisions=subdivisions)
    count, corners = len(skeleton), len(sphere.vertices)
    vertices = skeleton.points[:, None] + skeleton.radii[:, None, None] * np.asarray(sphere.vertices)
    triangles = np.arange(count)[:, None, None] * corners + np.asarray(sphere.faces)
    return Mesh(vertices.reshape(-1, 3), triangles.reshape(-1, 3)), np.repeat(np.arange(count), corners)


def subdivisions_within(balls: int, triangles: int) -> int:
    """Return the most subdivisions, from 1 to :data:`FINEST_BY_CHOICE`, that give at most `triangles` triangles.

    With 1 subdivision a ball has 80 triangles; so many balls that even these are too many get them all the same.
    """
    fitting = [
        level for level in range(1, FINEST_BY_CHOICE + 1) if balls * TRIANGLES_OF_ICOSAHEDRON * 4**level <= triangles
    ]
    return max(fitting, default=1)
