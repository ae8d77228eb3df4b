"""Mugs and cups; the handle points to positive z."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, embed, smooth_path
from morphoskel.datasets.synthetic.primitives import ball, lathe, rod, tube, union
from morphoskel.shapes import FloatArray


def build_mug(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random mug that stands on height 0."""
    draw = generator.uniform
    height, wall = draw(0.9, 1.9), draw(0.06, 0.11)
    heights = np.linspace(0.0, height, 13)
    radii = _radii(generator, heights / height)
    outer = np.column_stack([radii, heights])
    inner = np.column_stack([radii - wall, heights])[heights > 1.6 * wall]
    floor = float(inner[0, 1])
    body = lathe(np.vstack([[(0.0, 0.0)], outer, inner[::-1], [(0.0, floor)]]), segments=40)
    within_wall = np.column_stack([inner[:, 0] + 0.3 * wall, inner[:, 1]])
    inside = lathe(np.vstack([[(0.0, floor)], within_wall, [(0.0, height)]]), segments=40)
    handle = _handle(generator, height, heights, radii - 0.5 * wall) - inside
    return [Part("body", body), Part("handle", handle)]


def _radii(generator: np.random.Generator, share: FloatArray) -> FloatArray:
    draw = generator.uniform
    style = str(generator.choice(["straight", "tapered", "bellied", "waisted", "bowl"]))
    if style == "straight":
        return np.full_like(share, 0.6)
    if style == "tapered":
        return 0.6 + draw(-0.15, 0.2) * (share - 0.5)
    if style == "bellied":
        return 0.5 + draw(0.1, 0.2) * np.sin(np.pi * share)
    if style == "waisted":
        return 0.62 - draw(0.06, 0.14) * np.sin(np.pi * share)
    return 0.4 + draw(0.3, 0.5) * np.sqrt(share)


def _handle(generator: np.random.Generator, height: float, heights: FloatArray, wall: FloatArray) -> Manifold:
    """Return a handle whose ends reach into the `wall`, given as radii at `heights`."""
    draw = generator.uniform
    top, low = draw(0.78, 0.88) * height, draw(0.15, 0.3) * height
    upper, lower = float(np.interp(top, heights, wall)), float(np.interp(low, heights, wall))
    reach, radius = draw(0.35, 0.55), draw(0.06, 0.1)
    style = str(generator.choice(["round", "ear", "square"]))
    if style == "round":
        middle, half = (top + low) / 2, (top - low) / 2
        curve = embed(arc((min(upper, lower), middle), (reach + abs(upper - lower) / 2, half), (-90.0, 90.0), 20), "x")
        ends = [(0.0, low, lower - 0.01), (0.0, top, upper - 0.01)]
        return union(tube(curve, radius, 12, flatten=1.3), *_stubs(curve, ends, radius))
    if style == "ear":
        path = [
            (0.0, top, upper),
            (0.0, top + 0.04, upper + 0.7 * reach),
            (0.0, 0.6 * top + 0.4 * low, upper + reach),
            (0.0, low, lower),
        ]
        return tube(smooth_path(path, 24), radius, 12, flatten=1.2)
    out = max(upper, lower) + reach
    corners = [(0.0, top, upper), (0.0, top, out), (0.0, low, out), (0.0, low, lower)]
    bars = [rod(a, b, radius) for a, b in pairwise(corners)]
    return union(*bars, ball(radius, corners[1], 16), ball(radius, corners[2], 16))


def _stubs(curve: FloatArray, ends: list[tuple[float, float, float]], radius: float) -> list[Manifold]:
    """Return the straight pieces that lead the ends of an arc into the wall."""
    return [
        rod(tuple(tip), end, radius)
        for tip, end in zip(curve[[0, -1]], ends, strict=True)
        if abs(tip[2] - end[2]) > 0.02
    ]
