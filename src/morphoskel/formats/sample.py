"""Turn a mesh into a cloud."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import MINIMUM_DISTINCT_POINTS, Mesh, PointCloud


def sample_surface(mesh: Mesh, samples: int, generator: np.random.Generator) -> PointCloud:
    """Draw points uniformly by area, with the normals of their triangles.

    Parameters
    ----------
    mesh
        Triangles without area are never hit.
    samples
        Number of points, at least 4.
    generator
        Source of randomness.

    Returns
    -------
    PointCloud
        ``samples`` independent points; a normal points to the side from which its triangle is seen counter-clockwise.

    Raises
    ------
    InputError
        If `samples` is too small or the mesh has no area.

    Notes
    -----
    Osada et al., *Shape Distributions*, ACM Transactions on Graphics 21(4), 2002, section 4.1.
    """
    if samples < MINIMUM_DISTINCT_POINTS:
        raise InputError(f"samples: expected at least {MINIMUM_DISTINCT_POINTS} points, got {samples}")
    a, b, c = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
    crosses = np.cross(b - a, c - a)
    doubled_areas = np.linalg.norm(crosses, axis=1)
    total = doubled_areas.sum()
    if not (np.isfinite(total) and total > 0):
        raise InputError(f"cannot be sampled: the area of its {len(crosses)} triangles is {total / 2:g}; rescale it")
    chosen = generator.choice(len(crosses), size=samples, p=doubled_areas / total)
    root, fraction = np.sqrt(generator.random(samples)), generator.random(samples)
    points = (
        (1 - root)[:, None] * a[chosen]
        + (root * (1 - fraction))[:, None] * b[chosen]
        + (root * fraction)[:, None] * c[chosen]
    )
    return PointCloud(points, normals=crosses[chosen] / doubled_areas[chosen, None])
