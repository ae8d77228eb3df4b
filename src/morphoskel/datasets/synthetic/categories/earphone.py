"""Headphones with a band over the head, and pairs of earbuds joined by their wire."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, embed, smooth_path
from morphoskel.datasets.synthetic.primitives import ball, box, lathe, loft, rod, tube, union


def build_earphone(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random earphone; the ears are at x = -1 and 1."""
    if generator.uniform() < 0.2:
        return _earbuds(generator)
    draw = generator.uniform
    radius, depth, oval = draw(0.36, 0.58), draw(0.2, 0.34), draw(1.0, 1.3)
    cup = _cup(radius, depth, draw(0.6, 0.95)).scale((1.0, oval, 1.0)).rotate((0.0, 0.0, draw(-6.0, 6.0)))
    parts = []
    for sign in (-1.0, 1.0):
        placed = cup.translate((1.0, 0.0, 0.0))
        parts.append(Part("earcup", placed if sign > 0 else placed.mirror((1.0, 0.0, 0.0))))
    parts += [Part("headband", solid) for solid in _band(generator, oval * radius)]
    wire = str(generator.choice(["one side", "both sides", "none", "microphone"]))
    foot = -0.9 * oval * radius
    if wire == "one side":
        parts.append(Part("wire", _cable(generator, [(0.95, foot, 0.0)])))
    elif wire == "both sides":
        parts.append(Part("wire", _cable(generator, [(0.95, foot, 0.0), (-0.95, foot, 0.0)])))
    elif wire == "microphone":
        boom = smooth_path([(0.98, -0.2, -0.1), (1.0, -0.5, -0.55), (0.75, -0.75, -0.95)], 16)
        parts.append(Part("wire", union(tube(boom, 0.035, 8), ball((0.1, 0.07, 0.07), (0.75, -0.75, -0.95), 12))))
    return parts


def _cup(radius: float, depth: float, pad: float) -> Manifold:
    """Return a cup on the axis x: an ear pad with a hollow towards the head and a rounded housing outside."""
    inner, outer = -0.5 * depth, 0.5 * depth
    pad_radius = radius * max(pad, 0.8)
    profile = [
        (0.0, -0.1 * depth),
        (0.5 * pad_radius, -0.1 * depth),
        (0.6 * pad_radius, inner),
        (0.9 * pad_radius, inner),
        (pad_radius, 0.5 * inner),
        (pad_radius, 0.0),
        (radius, 0.05 * depth),
        (radius, 0.3 * depth),
        (0.75 * radius, outer),
        (0.0, 1.15 * outer),
    ]
    return lathe(profile, "x", segments=32)


def _band(generator: np.random.Generator, cup: float) -> list[Manifold]:
    """Return the band with its padding and the sliders or yokes that hold the cups."""
    draw = generator.uniform
    rise, width, thick = draw(1.1, 1.5), draw(0.12, 0.3), draw(0.07, 0.11)
    outer, inner = (
        arc((0.0, 0.15), (1.0 + thick, rise + thick), (0.0, 180.0), 28),
        arc((0.0, 0.15), (1.0, rise), (0.0, 180.0), 28),
    )
    solids = [_strip(outer, inner, width)]
    if draw() < 0.6:
        pad_out, pad_in = (
            arc((0.0, 0.15), (1.02, rise + 0.02), (45.0, 135.0), 16),
            arc((0.0, 0.15), (0.9, rise - 0.12), (45.0, 135.0), 16),
        )
        solids.append(_strip(pad_out, pad_in, 1.5 * width))
    if draw() < 0.5:
        for sign in (-1.0, 1.0):
            solids.append(box((0.05, 0.35, 0.6 * width), (sign * (1.0 + thick / 2), 0.1, 0.0)))
            yoke = tube(embed(arc((0.0, 0.0), (cup * 1.02, cup * 0.95), (0.0, 180.0), 16), "x", sign * 1.0), 0.045, 8)
            solids.append(yoke)
            solids += [rod((sign * 1.0, 0.0, z), (sign * 0.98, 0.0, 0.85 * z), 0.045, segments=10) for z in (-cup, cup)]
    else:
        solids += [box((0.05, 0.4, 0.8 * width), (sign * (1.0 + thick / 2), 0.05, 0.0)) for sign in (-1.0, 1.0)]
    return [union(*solids)]


def _strip(outer: np.ndarray, inner: np.ndarray, width: float) -> Manifold:
    """Return a flat band between two arcs of the plane z = 0."""
    half = width / 2
    corners = [embed(curve, "z", z) for curve, z in ((outer, -half), (outer, half), (inner, half), (inner, -half))]
    return loft(np.stack(corners, axis=1))


def _cable(generator: np.random.Generator, starts: list[tuple[float, float, float]]) -> Manifold:
    """Return a hanging wire from each start to a common plug below."""
    draw = generator.uniform
    radius, low, aside = draw(0.03, 0.045), draw(-2.0, -1.5), draw(-0.3, 0.3)
    solids = []
    for x, y, z in starts:
        middle = (0.6 * x + aside, 0.4 * y + 0.6 * low, z + draw(-0.2, 0.2))
        solids.append(tube(smooth_path([(x, y + 0.12, z), (x, y - 0.15, z), middle, (aside, low, 0.0)], 24), radius, 8))
    solids.append(rod((aside, low - 0.2, 0.0), (aside, low + 0.05, 0.0), 0.06, segments=12))
    return union(*solids)


def _earbuds(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    bud, stem = draw(0.22, 0.3), draw(0.35, 0.6)
    parts = []
    join = (draw(-0.2, 0.2), -draw(1.6, 2.0), 0.0)
    for sign in (-1.0, 1.0):
        x = 0.6 * sign
        tip = lathe(
            [(0.0, 0.0), (bud, 0.0), (0.9 * bud, 0.12), (0.45 * bud, 0.3), (0.4 * bud, 0.45), (0.0, 0.45)],
            "x",
            segments=24,
        )
        dome = ball((0.5 * bud, bud, bud), (0.0, 0.0, 0.0), 20)
        head = union(tip.mirror((1.0, 0.0, 0.0)), dome)
        head = head if sign > 0 else head.mirror((1.0, 0.0, 0.0))
        parts.append(
            Part("earcup", union(head.translate((x, 0.0, 0.0)), rod((x, 0.0, 0.0), (x, -stem, 0.0), 0.085, 0.06)))
        )
        path = [(x, -stem + 0.08, 0.0), (x, -stem - 0.2, 0.0), (0.5 * x, -1.2, draw(-0.2, 0.2)), join]
        parts.append(Part("wire", tube(smooth_path(path, 24), 0.035, 8)))
    low = (join[0] + draw(-0.3, 0.3), join[1] - draw(0.6, 1.0), draw(-0.2, 0.2))
    lead = tube(smooth_path([(join[0], join[1] + 0.05, 0.0), (join[0], join[1] - 0.3, 0.05), low], 16), 0.04, 8)
    parts.append(
        Part("wire", union(lead, ball(0.08, join, 12), rod(low, (low[0], low[1] - 0.25, low[2]), 0.07, segments=12)))
    )
    return parts
