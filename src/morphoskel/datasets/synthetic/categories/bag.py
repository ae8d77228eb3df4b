"""Handbags, shopping bags, duffel bags and suitcases; the opening is up."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, embed, rounded_rectangle, smooth_path
from morphoskel.datasets.synthetic.primitives import box, lathe, loft, rod, rounded_box, tube, union


def build_bag(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random bag about two units wide."""
    kind = str(generator.choice(["handbag", "shopping", "duffel", "suitcase", "shoulder"]))
    builders = {"duffel": _duffel, "suitcase": _suitcase, "shoulder": _shoulder_bag}
    if kind in builders:
        return builders[kind](generator)
    return _handbag(generator, stiff=kind == "handbag")


def _handbag(generator: np.random.Generator, *, stiff: bool) -> list[Part]:
    draw = generator.uniform
    width, height, depth = draw(1.5, 2.0), draw(0.9, 1.6) if stiff else draw(1.7, 2.3), draw(0.45, 0.8)
    narrowing, top_depth = draw(0.6, 1.05), depth * (draw(0.3, 0.7) if stiff else draw(0.7, 1.0))
    body = _sack(width, height, depth, width * narrowing, top_depth)
    if stiff and draw() < 0.6:
        flap = _sack(0.85 * width, 0.5 * height, 0.5 * depth, 0.97 * width * narrowing, 0.9 * top_depth)
        body = union(body, flap.translate((0.0, 0.5 * height + 0.02, -0.14 * depth)))
    spread, rise, radius = width * narrowing * draw(0.25, 0.4), draw(0.45, 0.9), draw(0.035, 0.06)
    handles = [0.0] if stiff and draw() < 0.5 else [-0.32 * top_depth, 0.32 * top_depth]
    parts = [Part("body", body)]
    for z in handles:
        curve = embed(arc((0.0, height - 0.06), (spread, rise), (0.0, 180.0), 20), "z", z)
        parts.append(Part("handle", tube(curve, radius, 8)))
    return parts


def _duffel(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    length, radius, squash = draw(1.6, 2.4), draw(0.4, 0.55), draw(0.75, 1.0)
    half = length / 2
    profile = [
        (0, -half),
        (0.85 * radius, -half),
        (radius, 0.1 - half),
        (radius, half - 0.1),
        (0.85 * radius, half),
        (0, half),
    ]
    body = lathe(profile, "x", segments=28).scale((1.0, squash, 1.0))
    pocket = rounded_box((0.5 * length, 0.7 * radius, 0.3), (0.0, -0.1, -radius), 0.06)
    parts = [Part("body", union(body, pocket) if draw() < 0.6 else body)]
    rise, spread = draw(0.35, 0.6), draw(0.3, 0.5)
    for sign in (-1.0, 1.0):
        at = 0.35 * radius * sign
        curve = embed(arc((0.0, 0.8 * radius * squash), (spread, rise), (0.0, 180.0), 18), "z", at)
        parts.append(Part("handle", tube(curve, draw(0.035, 0.055), 8)))
    return parts


def _suitcase(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    upright = draw() < 0.5
    width, height, depth = (
        (1.3, draw(1.7, 2.1), draw(0.5, 0.75)) if upright else (draw(1.8, 2.2), draw(1.2, 1.5), draw(0.35, 0.6))
    )
    body = rounded_box((width, height, depth), (0.0, height / 2, 0.0), draw(0.06, 0.16))
    seam = box((width + 0.05, height - 0.3, 0.05), (0.0, height / 2, 0.0))
    solids = [body, seam]
    if upright:
        solids += [
            rod((x - 0.05, -0.05, z), (x + 0.05, -0.05, z), 0.1)
            for x in (-0.5, 0.5)
            for z in (-0.3 * depth, 0.3 * depth)
        ]
    spread, rise, radius = (
        draw(0.22, 0.35),
        draw(0.5, 0.9) if upright and draw() < 0.6 else draw(0.14, 0.22),
        draw(0.03, 0.05),
    )
    base = height - 0.05
    grip = union(
        rod((-spread, base, 0.0), (-spread, height + rise, 0.0), radius),
        rod((spread, base, 0.0), (spread, height + rise, 0.0), radius),
        rounded_box((2 * spread + 3 * radius, 3 * radius, 3 * radius), (0.0, height + rise, 0.0), radius),
    )
    return [Part("body", union(*solids)), Part("handle", grip)]


def _shoulder_bag(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    width, height, depth = draw(1.3, 1.8), draw(0.9, 1.3), draw(0.35, 0.6)
    body = _sack(width, height, depth, width * draw(0.85, 1.0), 0.8 * depth)
    flap_height = draw(0.5, 0.8) * height
    flap = rounded_box((0.96 * width, flap_height, 0.12), (0.0, height - flap_height / 2 + 0.04, -0.46 * depth), 0.05)
    rise, half = draw(1.1, 1.7), 0.44 * width
    path = [(half, 0.6 * height, 0.0), (half + 0.08, height + 0.2 * rise, 0.0), (0.5 * half, height + 0.9 * rise, 0.0)]
    path += [(-x, y, z) for x, y, z in reversed(path)]
    strap = tube(smooth_path(path, 32), draw(0.05, 0.08), 10, flatten=0.7)
    return [Part("body", union(body, flap)), Part("handle", strap)]


def _sack(width: float, height: float, depth: float, top_width: float, top_depth: float) -> Manifold:
    """Return a body of rounded rectangular sections, bulging a little between bottom and top."""
    rings = []
    for up in np.concatenate([[0.0], np.linspace(0.05, 0.95, 7), [1.0]]):
        bulge = 1.0 + 0.06 * np.sin(np.pi * up) - (0.08 if up in (0.0, 1.0) else 0.0)
        across, along = (width + up * (top_width - width)) * bulge, (depth + up * (top_depth - depth)) * bulge
        rings.append(embed(rounded_rectangle(across, along, 0.35 * along), "y", up * height))
    return loft(np.stack(rings))
