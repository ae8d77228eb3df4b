"""Curves in the plane and in space from which the solids of the synthetic shapes are swept and extruded."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray

Outline = FloatArray | Sequence[tuple[float, float]]
Path3 = FloatArray | Sequence[tuple[float, float, float]]
Triple = FloatArray | tuple[float, float, float]

_AXES = {"x": (2, 1, 0), "y": (0, 2, 1), "z": (0, 1, 2)}


def embed(outline: Outline, normal: str, offset: float = 0.0, shift: Triple = (0.0, 0.0, 0.0)) -> FloatArray:
    """Put a plane curve into space.

    Parameters
    ----------
    outline
        ``(M, 2)`` points: ``(z, y)`` for normal ``"x"``, ``(x, z)`` for ``"y"``, ``(x, y)`` for ``"z"``.
    normal
        Axis orthogonal to the plane.
    offset
        Coordinate of the plane along that axis.
    shift
        Added to every point.

    Returns
    -------
    FloatArray
        ``(M, 3)``.
    """
    flat = np.asarray(outline, dtype=np.float64)
    first, second, along = _AXES[normal]
    points = np.full((len(flat), 3), offset, dtype=np.float64)
    points[:, first] = flat[:, 0]
    points[:, second] = flat[:, 1]
    points[:, along] = offset
    return points + np.asarray(shift, dtype=np.float64)


def arc(
    centre: tuple[float, float],
    radii: tuple[float, float],
    degrees: tuple[float, float],
    count: int = 16,
) -> FloatArray:
    """Return `count` points, ``(count, 2)``, of an elliptic arc; angles run from the first axis to the second."""
    angles = np.radians(np.linspace(degrees[0], degrees[1], count))
    return np.column_stack([centre[0] + radii[0] * np.cos(angles), centre[1] + radii[1] * np.sin(angles)])


def superellipse(half_width: float, half_height: float, exponent: float = 2.0, count: int = 24) -> FloatArray:
    """Return the closed curve ``|u/a|^n + |v/b|^n = 1`` around the origin, ``(count, 2)``.

    Exponent 2 is an ellipse; 4 and more approach a rectangle with rounded corners.
    """
    angles = 2.0 * np.pi * np.arange(count) / count
    cosine, sine = np.cos(angles), np.sin(angles)
    radius = (np.abs(cosine) ** exponent + np.abs(sine) ** exponent) ** (-1.0 / exponent)
    return np.column_stack([half_width * radius * cosine, half_height * radius * sine])


def rounded_rectangle(width: float, height: float, radius: float, corner_points: int = 4) -> FloatArray:
    """Return a rectangle around the origin whose corners are arcs of `radius`, ``(4 * corner_points, 2)``."""
    radius = min(radius, 0.499 * width, 0.499 * height)
    across, up = width / 2 - radius, height / 2 - radius
    corners = [(across, up, 0.0), (-across, up, 90.0), (-across, -up, 180.0), (across, -up, 270.0)]
    return np.vstack([arc((u, v), (radius, radius), (start, start + 90.0), corner_points) for u, v, start in corners])


def aerofoil(chord: float, thickness: float, count: int = 14) -> FloatArray:
    """Return a symmetric wing section, ``(count, 2)``: leading edge at ``(0, 0)``, trailing edge at ``(chord, 0)``.

    The trailing edge is a fifth as thick as the thickest place, so that no part of the wing has zero volume.
    """
    position = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, count // 2)))
    half = thickness / 2 * (np.sqrt(position) * (1.0 - position) * 2.6 + 0.2 * position)
    upper = np.column_stack([chord * position, half])
    lower = np.column_stack([chord * position, -half])[::-1]
    return np.vstack([upper, lower[:-1]])


def smooth_path(points: Path3, count: int = 24) -> FloatArray:
    """Return `count` points, ``(count, 3)``, of the cubic spline through `points`."""
    return _spline(np.asarray(points, dtype=np.float64), count, closed=False)


def smooth_outline(points: Outline, count: int = 48) -> FloatArray:
    """Return `count` points, ``(count, 2)``, of the closed cubic spline through `points`."""
    return _spline(np.asarray(points, dtype=np.float64), count, closed=True)


def mirrored_outline(half: Outline) -> FloatArray:
    """Complete an outline given on the side of positive first coordinate by its mirror image.

    `half` runs from the lowest to the highest point of the symmetry axis, both of them left out if on the axis twice.
    """
    points = np.asarray(half, dtype=np.float64)
    other = points[::-1] * (-1.0, 1.0)
    off_axis = np.abs(other[:, 0]) > 1e-9
    return np.vstack([points, other[off_axis]])


def _spline(points: FloatArray, count: int, *, closed: bool) -> FloatArray:
    from scipy.interpolate import CubicSpline

    if closed:
        points = np.vstack([points, points[:1]])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    position = np.concatenate([[0.0], np.cumsum(steps)])
    spline = CubicSpline(position, points, bc_type="periodic" if closed else "natural")
    where: npt.NDArray[np.float64] = np.linspace(0.0, position[-1], count, endpoint=not closed)
    return np.asarray(spline(where), dtype=np.float64)
