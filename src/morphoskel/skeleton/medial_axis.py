"""The medial axis of a closed surface, dense and pruned: the reference that skeletons are measured against.

The published axes of the Point2Skeleton shapes were simplified by hand. Where they cannot be had, this one takes their
place; it is called MAT* then, because distances to one and to the other must not be compared.
"""

from __future__ import annotations

import numpy as np

from morphoskel.errors import InputError, ShapeError
from morphoskel.formats.sample import sample_surface
from morphoskel.shapes import FloatArray, Mesh, Skeleton
from morphoskel.skeleton.shrinking_balls import shrink_balls
from morphoskel.skeleton.thinning import separated_points
from morphoskel.surface.normals import complete_normals


def medial_axis(
    points: FloatArray,
    normals: FloatArray,
    *,
    separation_angle: float = 60.0,
    scale: float = 0.002,
    tolerance: float = 0.02,
    gap: float = 0.002,
    count: int = 2048,
) -> Skeleton:
    """Return points of the medial axis of a closed surface that is given by dense, oriented samples.

    The inner ball of every sample is shrunk (:func:`~morphoskel.skeleton.shrinking_balls.shrink_balls`). Balls whose
    two touching points are seen under a small angle belong to ripples and blunt edges of the surface, and balls whose
    touching points are close together to details below the scale of interest; both are pruned. What is left is
    thinned evenly.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite, at least two of them distinct.
    normals
        ``(N, 3)`` float64, outward, unit length.
    separation_angle
        Smallest angle at a centre between its two touching points, in degrees, 0 to 180 (Peters 2018). The sheet
        between two walls that meet at the angle a has 180 - a.
    scale
        Smallest distance between the touching points, as a share of the diagonal of the points' bounding box.
    tolerance
        Share of its radius by which samples may lie in a ball; see there.
    gap
        Smallest distance between two points of the axis, as a share of the diagonal.
    count
        Largest number of points of the axis.

    Returns
    -------
    Skeleton
        The largest ball first, then each centre the farthest from all before it, so that any first part covers the
        axis evenly. A radius is that of the ball, which may exceed the distance to the samples by `tolerance`.

    Raises
    ------
    InputError
        If an array or a setting is not legal.
    ShapeError
        If no ball is left.

    Notes
    -----
    `scale` filters like the λ-medial axis (Chazal and Lieutier, *The λ-medial axis*, Graphical Models 67, 2005), whose
    λ is the radius of the smallest ball around the touching points: half their distance where there are two.
    """
    if not 0 <= separation_angle <= 180:
        raise InputError(f"separation_angle: expected degrees from 0 to 180, got {separation_angle:g}")
    for name, share in (("scale", scale), ("gap", gap)):
        if not 0 <= share < 1:
            raise InputError(f"{name}: expected a share of the diagonal from 0 to below 1, got {share:g}")
    if count < 1:
        raise InputError(f"count: expected at least 1 point, got {count}")
    balls = shrink_balls(points, normals, tolerance=tolerance)
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    kept = (balls.separation_angles >= separation_angle) & (balls.chords >= scale * diagonal)
    if not kept.any():
        raise ShapeError(
            f"medial axis: none of the {len(balls.radii)} balls of {len(points)} samples has a separation angle of "
            f"{separation_angle:g} degrees and touching points {scale * diagonal:g} apart; check that the surface is "
            "closed and its normals point outward, or lower both"
        )
    centres, radii = balls.centres[kept], balls.radii[kept]
    chosen = separated_points(centres, gap * diagonal, limit=count, first=int(radii.argmax()))
    return Skeleton(centres[chosen], radii[chosen])


def medial_axis_of_mesh(
    mesh: Mesh,
    generator: np.random.Generator,
    *,
    samples: int = 20_000,
    separation_angle: float = 60.0,
    scale: float = 0.002,
    tolerance: float = 0.02,
    gap: float = 0.002,
    count: int = 2048,
) -> Skeleton:
    """Return points of the medial axis of a closed mesh, from samples that are uniform by area.

    Parameters
    ----------
    mesh
        Closed, oriented outward. Parts thinner than the samples are apart come out coarsely.
    generator
        Source of randomness of the samples.
    samples
        Number of samples, at least 4.
    separation_angle, scale, tolerance, gap, count
        As for :func:`medial_axis`.

    Returns
    -------
    Skeleton
        As for :func:`medial_axis`.

    Raises
    ------
    InputError
        If the mesh has no area or a setting is not legal.
    ShapeError
        If no ball is left.
    """
    cloud = sample_surface(mesh, samples, generator)
    return medial_axis(
        cloud.points,
        complete_normals(cloud),
        separation_angle=separation_angle,
        scale=scale,
        tolerance=tolerance,
        gap=gap,
        count=count,
    )
