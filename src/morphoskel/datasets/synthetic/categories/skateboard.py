"""Skateboards and longboards lying on their wheels; length along z."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import mirrored_outline, rounded_rectangle, smooth_outline
from morphoskel.datasets.synthetic.primitives import hull, lathe, prism, rod, union


def build_skateboard(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random skateboard about two units long."""
    draw = generator.uniform
    kind = str(generator.choice(["street", "street", "longboard", "cruiser"]))
    half_width, thickness = draw(0.22, 0.3), draw(0.035, 0.055)
    parts = [Part("deck", _deck(generator, kind, half_width, thickness))]
    radius, width = draw(0.065, 0.1), draw(0.08, 0.12)
    axle_at = draw(0.5, 0.62) if kind != "longboard" else draw(0.6, 0.7)
    drop = -thickness / 2 - draw(0.07, 0.1)
    reach = half_width - draw(0.0, 0.05)
    for sign in (-1.0, 1.0):
        parts.append(Part("truck", _truck(sign * axle_at, drop, reach, -thickness / 2, sign)))
        for side in (-1.0, 1.0):
            wheel = _wheel(radius, width).translate((side * (reach - 0.3 * width), drop, sign * axle_at))
            parts.append(Part("wheel", wheel))
    return parts


def _deck(generator: np.random.Generator, kind: str, half_width: float, thickness: float) -> Manifold:
    draw = generator.uniform
    if kind == "street":
        outline = rounded_rectangle(2 * half_width, 2.0, draw(0.8, 1.0) * half_width, 10)
        kick, kick_front = draw(0.1, 0.2), draw(0.1, 0.2)
    elif kind == "longboard":
        waist = draw(0.75, 1.0)
        outline = _waisted(half_width, waist, draw(0.3, 0.7))
        kick, kick_front = 0.0, 0.0
    else:
        outline = _waisted(half_width, 1.05, draw(0.1, 0.35))
        kick, kick_front = draw(0.1, 0.2), 0.0
    concave, rocker = draw(0.0, 0.6), draw(-0.03, 0.05)
    deck = prism(outline, thickness, "y").refine_to_length(0.12)

    def bend(points: np.ndarray) -> np.ndarray:
        bent = points.copy()
        x, z = points[:, 0], points[:, 2]
        beyond = np.maximum(np.abs(z) - 0.68, 0.0)
        height = np.where(z > 0, kick, kick_front) * (beyond / 0.32) ** 1.3
        bent[:, 1] += height + 0.5 * concave * x**2 + rocker * (z**2 - 0.3)
        return bent

    return deck.warp_batch(bend)


def _waisted(half_width: float, waist: float, nose: float) -> np.ndarray:
    half = [(0.0, -1.0), (nose * half_width, -0.97), (0.95 * half_width, -0.6), (waist * half_width, 0.0)]
    half += [(0.95 * half_width, 0.6), (max(nose, 0.5) * half_width, 0.97), (0.0, 1.0)]
    return smooth_outline(mirrored_outline(half), 48)


def _truck(at: float, drop: float, reach: float, underside: float, sign: float) -> Manifold:
    base = hull(
        [(x, y, at + z) for x in (-0.1, 0.1) for y in (underside - 0.03, underside + 0.025) for z in (-0.14, 0.14)]
    )
    hanger = hull(
        [(x, drop + y, at + z) for x in (-0.55 * reach, 0.55 * reach) for y in (-0.02, 0.02) for z in (-0.02, 0.02)]
        + [(x, underside - 0.02, at + z - 0.05 * sign) for x in (-0.04, 0.04) for z in (-0.05, 0.05)]
    )
    axle = rod((-reach - 0.03, drop, at), (reach + 0.03, drop, at), 0.02, segments=10)
    return union(base, hanger, axle)


def _wheel(radius: float, width: float) -> Manifold:
    half = width / 2
    profile = [
        (0.0, -half),
        (0.8 * radius, -half),
        (radius, -0.6 * half),
        (radius, 0.6 * half),
        (0.8 * radius, half),
        (0.0, half),
    ]
    return lathe(profile, "x", segments=20)
