"""Acoustic and electric guitars standing upright, strings towards negative z."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import mirrored_outline, smooth_outline
from morphoskel.datasets.synthetic.primitives import beam, box, prism, rod, rounded_box, union
from morphoskel.shapes import FloatArray


def build_guitar(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random guitar; the body spans heights 0 to about 1."""
    draw = generator.uniform
    kind = str(generator.choice(["acoustic", "acoustic", "horned", "single cut", "arrow"]))
    depth = draw(0.2, 0.3) if kind == "acoustic" else draw(0.08, 0.13)
    top, outline = _outline(generator, kind)
    body = prism(outline, depth, "z")
    face = -depth / 2
    length, half = draw(0.9, 1.25), draw(0.05, 0.065)
    end = top + length
    start = top - (0.08 if kind == "acoustic" else 0.3)
    thick = draw(0.045, 0.06)
    neck = union(
        beam((0.0, start, face - 0.015), (0.0, end, face - 0.015), 2.3 * half, 0.05, 0.8),
        rod((0.0, top - 0.04, face + 0.01), (0.0, end, face + 0.01), 1.05 * half, 0.8 * half),
        beam((0.0, top + 0.1, face + 0.02), (0.0, top - 0.06, 0.0), 2.2 * half, thick, 1.2),
    )
    parts = [Part("neck", neck), Part("head", _head(generator, half, end, face))]
    return [*parts, Part("body", union(_hollowed(generator, kind, body, face, top), *_fittings(kind, face)))]


def _outline(generator: np.random.Generator, kind: str) -> tuple[float, FloatArray]:
    """Return the height at which the neck meets the body, and the outline in x and y."""
    draw = generator.uniform
    if kind == "arrow":
        reach, low, notch = draw(0.36, 0.5), draw(-0.15, 0.0), draw(0.2, 0.35)
        half = [(0.0, notch), (reach - 0.16, low), (reach, low + 0.06), (0.14, 0.85), (0.09, 0.95), (0.0, 0.96)]
        return 0.95, mirrored_outline(half)
    lower, waist, upper = draw(0.36, 0.44), draw(0.23, 0.29), draw(0.28, 0.34)
    hips = [(0.7 * lower, 0.06), (lower, 0.28), (waist, 0.58)]
    if kind == "acoustic":
        outline = mirrored_outline([(0.0, 0.0), *hips, (upper, 0.84), (0.6 * upper, 0.98), (0.0, 1.0)])
        smooth = smooth_outline(outline, 64)
        cutaway = draw() < 0.35
        return 1.0, smooth[~((smooth[:, 0] > 0.07) & (smooth[:, 1] > 0.8))] if cutaway else smooth
    right = [(upper, 0.78), (0.85 * upper, draw(0.85, 0.95)), (0.5 * upper, 0.84), (0.08, 0.76)]
    horn = [(-0.08, 0.8), (-0.5 * upper, 0.92), (-0.85 * upper, draw(0.95, 1.1)), (-upper, 0.82)]
    shoulder = horn if kind == "horned" else [(-0.08, 0.92), (-0.6 * upper, 0.93), (-upper, 0.78)]
    left = [(-x, y) for x, y in reversed(hips)]
    return 0.8, smooth_outline([(0.0, 0.0), *hips, *right, *shoulder, *left], 64)


def _hollowed(generator: np.random.Generator, kind: str, body: Manifold, face: float, top: float) -> Manifold:
    """Sink the sound hole of an acoustic guitar, or raise the pickups of an electric one."""
    if kind == "acoustic":
        return body - rod(
            (0.0, 0.66 * top, face - 0.1), (0.0, 0.66 * top, face + 0.12), generator.uniform(0.09, 0.12), segments=28
        )
    at = generator.choice([0.3, 0.34])
    pickups = [box((0.2, 0.06, 0.05), (0.0, at + step, face - 0.005)) for step in (0.0, 0.13)]
    knobs = [rod((0.24, y, face - 0.04), (0.24, y, face + 0.02), 0.03, segments=12) for y in (0.2, 0.3)]
    return union(body, *pickups, *(knobs if kind != "arrow" else []))


def _fittings(kind: str, face: float) -> list[Manifold]:
    bridge = 0.26 if kind == "acoustic" else 0.2
    y = 0.3 if kind == "acoustic" else 0.24
    return [rounded_box((bridge, 0.05, 0.06), (0.0, y + (0.1 if kind == "arrow" else 0.0), face - 0.005), 0.012)]


def _head(generator: np.random.Generator, half: float, end: float, face: float) -> Manifold:
    draw = generator.uniform
    length, wide, thick = draw(0.26, 0.36), draw(1.5, 2.0) * half, 0.055
    if draw() < 0.6:
        outline = [
            (-half, -0.03),
            (half, -0.03),
            (wide, 0.08),
            (1.05 * wide, length),
            (0.0, length + draw(-0.03, 0.05)),
            (-1.05 * wide, length),
            (-wide, 0.08),
        ]
        sides = [-1.0, 1.0]
    else:
        outline = [
            (-half, -0.03),
            (half, -0.03),
            (1.3 * wide, 0.04),
            (0.9 * wide, length),
            (0.2 * wide, length + 0.1),
            (-0.8 * wide, length - 0.02),
            (-1.1 * half, 0.1),
        ]
        sides = [-1.0]
    solids = [prism(outline, thick, "z")]
    count = 3 if len(sides) == 2 else 5
    for side in sides:
        for up in np.linspace(0.12, length - 0.06, count):
            peg = rod((side * 0.5 * wide, up, 0.0), (side * (wide + 0.09), up, 0.0), 0.016, segments=8)
            solids += [peg, rounded_box((0.05, 0.05, 0.025), (side * (wide + 0.09), up, 0.0), 0.01)]
    return union(*solids).rotate((draw(4.0, 14.0), 0.0, 0.0)).translate((0.0, end, face + 0.005))
