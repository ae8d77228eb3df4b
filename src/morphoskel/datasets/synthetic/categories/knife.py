"""Kitchen knives, cleavers, daggers, machetes and table knives, blade up."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import smooth_path
from morphoskel.datasets.synthetic.primitives import ball, box, lathe, loft, rod, rounded_box, union
from morphoskel.shapes import FloatArray


def build_knife(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random knife; the blade begins at height 0."""
    draw = generator.uniform
    kind = str(generator.choice(["chef", "cleaver", "dagger", "curved", "table"]))
    shortest, longest = {
        "chef": (1.1, 1.5),
        "cleaver": (0.9, 1.2),
        "dagger": (1.1, 1.7),
        "curved": (1.2, 1.8),
        "table": (0.8, 1.1),
    }[kind]
    blade = _blade(generator, kind, draw(shortest, longest), draw(0.035, 0.055))
    return [Part("blade", blade), Part("handle", _handle(generator, kind))]


def _blade(generator: np.random.Generator, kind: str, length: float, thickness: float) -> Manifold:
    """Return a blade between a back (positive z) and an edge (negative z), thin towards the edge."""
    draw = generator.uniform
    share = np.linspace(0.0, 1.0, 14)
    back, edge = _profile(generator, kind, share)
    bend = draw(0.25, 0.6) * share**2 - 0.12 * np.sin(np.pi * share) if kind == "curved" else np.zeros(14)
    double = kind == "dagger"
    rings = []
    for at, behind, ahead, aside in zip(share, back, edge, bend, strict=True):
        spine, fine = 0.5 * thickness * (1.0 - 0.5 * at), 0.006
        blunt, widest = (fine, 0.5) if double else (spine, 0.3)
        half = [(blunt, 0.0), (spine, widest), (fine, 1.0)]
        section = half + [(-x, across) for x, across in reversed(half)]
        up = -0.06 + at * (length + 0.06)
        rings.append([(x, up, aside - (behind + across * (ahead - behind))) for x, across in section])
    blade = loft(np.array(rings))
    if kind == "cleaver" and draw() < 0.7:
        wide = float(edge[0] - back[0])
        return blade - rod((-1.0, 0.86 * length, 0.22 * wide), (1.0, 0.86 * length, 0.22 * wide), 0.09 * wide)
    return blade


def _profile(generator: np.random.Generator, kind: str, share: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how far the back lies behind the axis (negative) and the edge before it, along the blade."""
    draw = generator.uniform
    low, high = {
        "chef": (0.22, 0.34),
        "cleaver": (0.5, 0.7),
        "dagger": (0.18, 0.28),
        "curved": (0.18, 0.3),
        "table": (0.12, 0.16),
    }[kind]
    wide = draw(low, high)
    if kind == "cleaver":
        return np.full_like(share, -0.4 * wide), np.full_like(share, 0.6 * wide)
    if kind == "dagger":
        half = wide / 2 * (1 - share ** draw(2.0, 4.0)) + 0.012
        return -half, half
    back = -0.4 * wide + (0.25 * wide if kind == "chef" else 0.0) * share**2
    edge = 0.6 * wide * (1 - share ** draw(2.2, 3.5)) - 0.1 * wide * share**2
    return back, np.maximum(edge, back + 0.025)


def _handle(generator: np.random.Generator, kind: str) -> Manifold:
    draw = generator.uniform
    length, wide, thick = draw(0.65, 0.95), draw(0.13, 0.18), draw(0.1, 0.13)
    if kind == "dagger":
        grip = lathe(
            [
                (0.0, 0.03),
                (0.06, 0.03),
                (0.075, -0.3 * length),
                (0.055, -0.7 * length),
                (0.07, -length),
                (0.0, -length),
            ],
            segments=18,
        )
        guard = rounded_box((0.12, 0.09, draw(0.35, 0.6)), (0.0, 0.0, 0.0), 0.04)
        return union(grip, guard, ball(draw(0.08, 0.11), (0.0, -length, 0.0), 16))
    style = str(generator.choice(["straight", "bellied", "hooked"]))
    bends = {"straight": (0.0, 0.0, 0.0, 0.0), "bellied": (0.0, 0.01, 0.02, 0.0), "hooked": (0.0, -0.03, -0.02, 0.1)}
    swells = {"straight": (1.0, 1.0, 1.0, 1.0), "bellied": (0.85, 1.2, 0.9, 1.15), "hooked": (0.9, 1.0, 0.85, 1.1)}
    heights = (0.02 * length, -0.3 * length, -0.7 * length, -length)
    axis = smooth_path(list(zip(swells[style], heights, bends[style], strict=True)), 12)
    angles = 2 * np.pi * np.arange(16) / 16
    rings = []
    for index, (size, y, z) in enumerate(axis):
        size *= 0.85 if index in (0, 11) else 1.0
        rings.append(
            np.column_stack(
                [0.5 * thick * size * np.cos(angles), np.full(16, y), z + 0.5 * wide * size * np.sin(angles)]
            )
        )
    handle = loft(np.stack(rings))
    solids = [handle]
    if draw() < 0.5:
        solids.append(box((1.25 * thick, 0.06, 1.25 * wide), (0.0, 0.0, 0.0)))
    if draw() < 0.6:
        solids += [
            rod((-0.56 * thick, -up * length, 0.0), (0.56 * thick, -up * length, 0.0), 0.03, segments=12)
            for up in (0.25, 0.5, 0.75)
        ]
    return union(*solids)
