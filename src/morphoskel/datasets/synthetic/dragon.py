"""A dragon: a solid with thick, slender and thin parts, for figures that show the method on one shape.

It belongs to no category and is the same in every run. Its head faces negative z, its back is up.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part, unite
from morphoskel.datasets.synthetic.curves import Path3, Triple, smooth_path
from morphoskel.datasets.synthetic.primitives import ball, both_sides, hull, loft, rod, tube, union
from morphoskel.shapes import FloatArray, Mesh

_STATIONS = 96
"""Sections of the trunk from the tip of the tail to the head."""

_SPINE = (
    (-0.30, 0.34, 0.80),
    (-0.22, 0.22, 1.10),
    (0.06, 0.16, 1.22),
    (0.24, 0.20, 0.98),
    (0.16, 0.36, 0.66),
    (0.00, 0.52, 0.30),
    (-0.04, 0.56, -0.08),
    (0.00, 0.66, -0.42),
    (0.04, 0.94, -0.60),
    (0.03, 1.22, -0.58),
    (0.00, 1.36, -0.72),
)
"""The curve that the trunk is swept along; the tail curls to the side and the neck rises."""

_THICKNESS = (
    (0.0, 0.02),
    (0.18, 0.05),
    (0.38, 0.115),
    (0.52, 0.24),
    (0.6, 0.29),
    (0.69, 0.27),
    (0.8, 0.155),
    (1.0, 0.1),
)
"""Radii of the trunk at shares of its length."""

_WRIST = np.array([0.44, 1.22, 0.12])
_WING_RIM = ((0.62, 1.66, 0.42), (0.68, 1.42, 0.86), (0.58, 1.08, 1.06), (0.38, 0.8, 0.94), (0.06, 0.62, 0.46))
"""Ends of the struts that radiate from the wrist of a wing; the last lies inside the trunk."""

_MEMBRANE = 0.028
"""Thickness of the wings, a tenth of that of the trunk."""


def build_dragon() -> list[Part]:
    """Return the parts of the dragon, which is about 2.2 units long."""
    spine = smooth_path(_SPINE, _STATIONS)
    radii = _trunk_radii()
    limbs = [Part("leg", side) for leg in (_front_leg(), _hind_leg()) for side in both_sides(leg)]
    wings = [Part("wing", side) for side in both_sides(_wing())]
    return [
        Part("trunk", tube(spine, radii, 48)),
        Part("tail", _tail_blade(spine)),
        Part("head", _head(spine[-1])),
        *limbs,
        *wings,
        *(Part("spike", spike) for spike in _spikes(spine, radii)),
    ]


def dragon() -> Mesh:
    """Return the dragon as one watertight surface, normalised as :func:`assembly.unite` does."""
    mesh, _ = unite(build_dragon())
    return mesh


def _trunk_radii() -> FloatArray:
    from scipy.interpolate import PchipInterpolator

    shares, sizes = np.array(_THICKNESS).T
    radii: FloatArray = PchipInterpolator(shares, sizes)(np.linspace(0.0, 1.0, _STATIONS))
    return radii


def _tail_blade(spine: FloatArray) -> Manifold:
    """Return the flat arrow head at the tip of the tail."""
    tip, along = spine[0], spine[0] - spine[3]
    along /= np.linalg.norm(along)
    across = np.cross(along, (0.0, 1.0, 0.0))
    across /= np.linalg.norm(across)
    normal = 0.018 * np.cross(across, along)
    outline = [tip + 0.2 * along, tip + 0.11 * across - 0.03 * along, tip - 0.11 * across - 0.03 * along]
    middle = [tip - 0.06 * along]
    return hull(np.vstack([corner + sign * normal for corner in (*outline, *middle) for sign in (-1, 1)]))


def _head(neck: FloatArray) -> Manifold:
    """Return the skull with open jaws, teeth, horns, ears and brows, at the end of the neck."""
    skull = ball((0.12, 0.12, 0.16), (0.0, 0.03, -0.06), 48)
    upper = _jaw([(0.1, 0.02, 0.07), (0.085, 0.012, 0.055), (0.07, 0.004, 0.042), (0.04, -0.01, 0.03)], -0.08, 0.36)
    lower = _jaw([(0.085, -0.075, 0.035), (0.07, -0.1, 0.03), (0.055, -0.125, 0.026), (0.03, -0.14, 0.02)], -0.02, 0.3)
    nostril = ball(0.028, (0.034, 0.03, -0.4), 12)
    brow = ball((0.035, 0.03, 0.06), (0.08, 0.105, -0.13), 14)
    horn = tube(
        smooth_path([(0.06, 0.09, -0.02), (0.1, 0.2, 0.08), (0.13, 0.26, 0.22), (0.13, 0.35, 0.34)], 14),
        np.linspace(0.038, 0.008, 14),
        10,
    )
    ear = hull([(0.1, 0.02, -0.02), (0.1, -0.06, 0.0), (0.09, 0.0, 0.05), (0.24, 0.02, 0.14), (0.1, 0.03, 0.03)])
    teeth = [rod((x, -0.015, z), (x, -0.075, z - 0.005), 0.014, 0.003, 8) for x, z in ((0.05, -0.38), (0.062, -0.31))]
    whisker = tube(
        smooth_path([(0.05, -0.0, -0.37), (0.12, -0.02, -0.42), (0.17, -0.1, -0.4)], 8), np.linspace(0.014, 0.006, 8), 8
    )
    beard = hull([(0.02, -0.13, -0.2), (-0.02, -0.13, -0.2), (0.0, -0.12, -0.12), (0.0, -0.14, -0.26), (0, -0.3, -0.2)])
    pairs = [mirrored for solid in (nostril, brow, horn, ear, whisker, *teeth) for mirrored in both_sides(solid)]
    head = union(skull, upper, lower, beard, *pairs)
    return head.rotate((-8.0, 0.0, 0.0)).scale((1.15, 1.15, 1.15)).translate(tuple(neck + np.array([0.0, 0.01, -0.02])))


def _jaw(sections: list[tuple[float, float, float]], start: float, length: float) -> Manifold:
    """Return a jaw of rounded sections, each given by half its width, its height above the neck and half its height."""
    angles = 2.0 * np.pi * np.arange(32) / 32
    rings = [
        np.column_stack([wide * np.cos(angles), rise + high * np.sin(angles), np.full(32, start - share * length)])
        for (wide, rise, high), share in zip(sections, np.linspace(0.0, 1.0, len(sections)), strict=True)
    ]
    return loft(np.stack(rings))


def _front_leg() -> Manifold:
    """Return a leg from the shoulder to a foot on the ground at height 0."""
    return _leg([(0.1, 0.58, -0.3), (0.24, 0.46, -0.3), (0.25, 0.26, -0.22), (0.24, 0.08, -0.32)], 0.13)


def _hind_leg() -> Manifold:
    """Return a leg with a thick thigh."""
    return _leg([(0.08, 0.48, 0.36), (0.24, 0.42, 0.26), (0.27, 0.24, 0.4), (0.25, 0.08, 0.32)], 0.175)


def _leg(joints: Path3, thigh: float) -> Manifold:
    path = smooth_path(joints, 28)
    shares = np.linspace(0.0, 1.0, 28)
    limb = tube(path, np.interp(shares, [0.0, 0.3, 0.75, 1.0], [0.9 * thigh, thigh, 0.065, 0.068]), 28)
    ankle = path[-1]
    foot = ball((0.075, 0.05, 0.09), (ankle[0], 0.05, ankle[2] - 0.03), 18)
    claws = [
        rod((ankle[0], 0.055, ankle[2] - 0.03), (ankle[0] + spread, 0.018, ankle[2] - reach), 0.04, 0.012, 12)
        for spread, reach in ((-0.1, 0.17), (0.0, 0.21), (0.1, 0.17))
    ]
    return union(limb, foot, *claws)


def _wing() -> Manifold:
    """Return the wing on the side of positive x: arm, struts, and a membrane that hangs between the struts."""
    shoulder = (0.08, 0.66, 0.0)
    elbow = (0.3, 0.86, 0.22)
    arm = tube(smooth_path([shoulder, elbow, tuple(_WRIST)], 16), np.linspace(0.065, 0.036, 16), 12)
    rim = [np.array(end) for end in _WING_RIM]
    struts = [rod(tuple(_WRIST), tuple(end), 0.03, 0.014, 10) for end in rim[:-1]]
    panels = [
        _membrane(start, end, scallop)
        for (start, end), scallop in zip(pairwise(rim), (0.2,) * 3 + (0.12,), strict=True)
    ]
    return union(arm, ball(0.042, tuple(_WRIST), 14), *struts, *panels, _membrane(rim[-1], np.array(shoulder), -0.1))


def _membrane(start: FloatArray, end: FloatArray, scallop: float) -> Manifold:
    """Return the thin sheet between two struts; `scallop` is how deep its free edge is cut out, as a share."""
    across, out = np.linspace(0.0, 1.0, 10), np.linspace(0.02, 0.985, 12)
    normal = np.cross(start - _WRIST, end - _WRIST)
    normal /= np.linalg.norm(normal)
    rings = []
    for share in across:
        bow = np.sin(np.pi * share)
        strut = (1 - share) * (start - _WRIST) + share * (end - _WRIST)
        line = _WRIST + out[:, None] * (1 - scallop * bow) * strut + 0.05 * bow * out[:, None] ** 2 * normal
        half = _MEMBRANE / 2 * normal
        rings.append(np.vstack([line + half, line[::-1] - half]))
    return loft(np.stack(rings))


def _spikes(spine: FloatArray, radii: FloatArray) -> list[Manifold]:
    """Return the flat spikes along the back, from the tail to behind the horns."""
    tangents = np.gradient(spine, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    spikes = []
    for station in range(12, _STATIONS - 6, 5):
        along, radius = tangents[station], radii[station]
        up = _dorsal(along)
        side = 0.32 * radius * np.cross(along, up)
        foot, length = spine[station] + 0.6 * radius * up, 0.1 + 0.45 * radius
        base = [foot + shift * (0.05 + 0.2 * radius) * along + sign * side for shift in (-1, 1) for sign in (-1, 1)]
        spikes.append(hull([*base, spine[station] + (radius + length) * up - 0.08 * along]))
    return spikes


def _dorsal(along: Triple) -> FloatArray:
    """Return the direction away from the belly, at right angles to the trunk."""
    back = np.array([0.0, 1.0, 0.55])
    up = back - np.asarray(along) * (back @ np.asarray(along))
    return np.asarray(up / np.linalg.norm(up), dtype=np.float64)
