"""Dining tables, desks, coffee tables and round tables."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import superellipse
from morphoskel.datasets.synthetic.primitives import beam, box, lathe, prism, rod, slab, union


def build_table(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random table; the top lies at height 0."""
    draw = generator.uniform
    style = str(generator.choice(["legs", "legs", "legs", "panels", "pedestal", "desk", "trestle"]))
    width, depth, height = draw(1.4, 2.2), draw(0.8, 1.2), draw(0.45, 1.15)
    thickness = draw(0.05, 0.12)
    if style in ("legs", "pedestal") and draw() < (0.35 if style == "legs" else 0.75):
        depth = width * (1.0 if draw() < 0.6 else draw(0.6, 0.8))
        top = prism(superellipse(width / 2, depth / 2, 2.0, 40), thickness, "y")
        inset = 0.6
    else:
        top, inset = slab(width, thickness, depth, (0.0, 0.0, 0.0), draw(0.01, 0.12)), 0.95
    parts = [Part("top", top)]
    x, z = inset * width / 2 - 0.06, inset * depth / 2 - 0.06
    if style == "legs":
        return parts + _legs(generator, x, z, height)
    if style == "pedestal":
        return [*parts, Part("leg", _pedestal(generator, min(width, depth), height))]
    if style == "desk":
        return parts + _desk(generator, x, z, height)
    return parts + (_panels if style == "panels" else _trestle)(generator, x, z, height)


def _legs(generator: np.random.Generator, x: float, z: float, height: float) -> list[Part]:
    draw = generator.uniform
    thick, taper, splay = draw(0.035, 0.075), draw(0.5, 1.0), draw(0.0, 0.2) if draw() < 0.4 else 0.0
    square = draw() < 0.5
    inward = 1.0 - splay
    parts = []
    for i in (-1, 1):
        for k in (-1, 1):
            head, foot = (i * x * inward, 0.0, k * z * inward), (i * x, -height, k * z)
            leg = beam(head, foot, 1.8 * thick, 1.8 * thick, taper) if square else rod(head, foot, thick, taper * thick)
            parts.append(Part("leg", leg))
    extra = str(generator.choice(["none", "apron", "shelf", "stretcher", "drawer"]))
    level = draw(0.55, 0.8)
    across, along = x * (inward + splay * level), z * (inward + splay * level)
    if extra == "apron":
        drop = 0.14
        rails = [box((2 * x * inward, drop, 0.05), (0.0, -drop / 2, s * z * inward)) for s in (-1, 1)]
        rails += [box((0.05, drop, 2 * z * inward), (s * x * inward, -drop / 2, 0.0)) for s in (-1, 1)]
        parts.append(Part("support", union(*rails)))
    elif extra == "shelf":
        parts.append(Part("support", box((2 * across + 0.04, 0.05, 2 * along + 0.04), (0.0, -level * height, 0.0))))
    elif extra == "stretcher":
        y, r = -level * height, 0.6 * thick * (0.5 + 0.5 * taper)
        rails = [rod((s * across, y, -along), (s * across, y, along), r) for s in (-1, 1)]
        parts.append(Part("support", union(*rails, rod((-across, y, 0.0), (across, y, 0.0), r))))
    elif extra == "drawer":
        parts.append(Part("support", _drawer((1.7 * x * inward, 0.2, 1.6 * z * inward), (0.0, -0.12, 0.0))))
    return parts


def _pedestal(generator: np.random.Generator, size: float, height: float) -> Manifold:
    draw = generator.uniform
    thick = draw(0.06, 0.12)
    if draw() < 0.5:
        foot = draw(0.28, 0.4) * size
        profile = [
            (0.0, 0.0),
            (1.8 * thick, 0.0),
            (thick, -0.15),
            (thick, -0.7 * height),
            (1.5 * thick, 0.06 - 0.95 * height),
        ]
        return lathe([*profile, (foot, 0.05 - height), (foot, -height), (0.0, -height)])
    count, reach = int(generator.choice([3, 4, 5])), draw(0.32, 0.42) * size
    arms = []
    for angle in 2 * np.pi * (np.arange(count) + 0.5) / count:
        start = (0.3 * thick * np.sin(angle), -0.75 * height, 0.3 * thick * np.cos(angle))
        arms.append(beam(start, (reach * np.sin(angle), -height, reach * np.cos(angle)), 0.1, 0.12, 0.6))
    return union(rod((0.0, 0.0, 0.0), (0.0, -0.85 * height, 0.0), thick), *arms)


def _panels(generator: np.random.Generator, x: float, z: float, height: float) -> list[Part]:
    draw = generator.uniform
    thick = draw(0.05, 0.12)
    parts = [Part("leg", box((thick, height, 2 * z), (s * x, -height / 2, 0.0))) for s in (-1, 1)]
    extra = str(generator.choice(["none", "shelf", "back"]))
    if extra == "shelf":
        parts.append(Part("support", box((2 * x, 0.05, 1.9 * z), (0.0, -draw(0.3, 0.8) * height, 0.0))))
    elif extra == "back":
        tall = draw(0.3, 0.8) * height
        parts.append(Part("support", box((2 * x, tall, 0.05), (0.0, -tall / 2, 0.8 * z))))
    return parts


def _trestle(generator: np.random.Generator, x: float, z: float, height: float) -> list[Part]:
    """Return two crossed or upright frames joined by a beam."""
    draw = generator.uniform
    at, thick = draw(0.7, 0.95) * x, draw(0.07, 0.11)
    crossed = draw() < 0.5
    parts = []
    for sign in (-1, 1):
        if crossed:
            bars = [beam((sign * at, 0.0, s * z), (sign * at, -height, -s * z), thick, thick) for s in (-1, 1)]
        else:
            bars = [box((1.4 * thick, height, 1.8 * thick), (sign * at, -height / 2, 0.0))]
            bars.append(box((1.4 * thick, thick, 1.9 * z), (sign * at, thick / 2 - height, 0.0)))
        parts.append(Part("leg", union(*bars)))
    parts.append(Part("support", box((2 * at, thick, 0.6 * thick), (0.0, -0.5 * height, 0.0))))
    return parts


def _desk(generator: np.random.Generator, x: float, z: float, height: float) -> list[Part]:
    """Return one or two pedestals with drawers, and legs or a panel on the open side."""
    draw = generator.uniform
    wide = draw(0.5, 0.75) * x
    height = max(height, 0.75)
    rows, both = int(generator.integers(2, 5)), draw() < 0.4
    parts = []
    for sign in (-1.0, 1.0):
        if sign > 0 or both:
            parts.append(Part("leg", box((wide, height, 1.8 * z), (sign * (x - wide / 2 + 0.04), -height / 2, 0.05))))
            tall = 0.86 * height / rows
            for row in range(rows):
                place = (sign * (x - wide / 2 + 0.04), -0.1 * height - (row + 0.45) * tall, -0.82 * z)
                parts.append(Part("support", _drawer((0.88 * wide, 0.84 * tall, 0.12), place)))
        else:
            parts += [Part("leg", box((0.1, height, 0.1), (sign * x, -height / 2, k * 0.9 * z))) for k in (-1, 1)]
    return parts


def _drawer(size: tuple[float, float, float], centre: tuple[float, float, float]) -> Manifold:
    front = centre[2] - size[2] / 2
    knob = rod((centre[0], centre[1], front + 0.02), (centre[0], centre[1], front - 0.05), 0.03, segments=12)
    return union(box(size, centre), knob)
