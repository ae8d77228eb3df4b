"""Dining chairs, stools with backs, swivel chairs and armchairs; the sitter looks towards negative z."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import rounded_rectangle
from morphoskel.datasets.synthetic.primitives import beam, box, loft, prism, rod, rounded_box, slab, union


def build_chair(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random chair; the seat lies at height 0 and is about one unit wide."""
    draw = generator.uniform
    if draw() < 0.15:
        return _armchair(generator)
    width, depth, thickness = draw(0.85, 1.15), draw(0.8, 1.0), draw(0.06, 0.15)
    round_seat = draw() < 0.25
    corner = 0.49 * min(width, depth) if round_seat else draw(0.02, 0.15)
    seat = slab(width, thickness, depth, (0.0, 0.0, 0.0), corner)
    if draw() < 0.3:
        cushion = 0.9 if round_seat else 0.88
        seat = union(
            seat, slab(cushion * width, 0.1, cushion * depth, (0.0, thickness / 2 + 0.03, 0.0), 0.9 * corner + 0.03)
        )
    parts = [Part("seat", seat)]
    parts += [Part("back", solid) for solid in _back(generator, width * (0.8 if round_seat else 1.0), depth)]
    base = str(generator.choice(["four legs", "four legs", "splayed", "swivel", "sled", "pedestal"]))
    parts += [Part("leg", solid) for solid in _base(generator, base, width, depth, round_seat)]
    if draw() < 0.4:
        parts += [Part("arm", solid) for solid in _arms(generator, width, depth, round_seat)]
    return parts


def _back(generator: np.random.Generator, width: float, depth: float) -> list[Manifold]:
    draw = generator.uniform
    height, lean = draw(0.8, 1.4), draw(0.02, 0.25)
    style = str(generator.choice(["solid", "solid", "slats", "ladder", "spindles", "shell"]))
    foot = depth / 2 - 0.08
    if style == "shell":
        return [_shell_back(generator, width, height, lean).translate((0.0, 0.0, foot - 0.1))]
    if style == "solid":
        thickness = draw(0.06, 0.14)
        panel = prism(rounded_rectangle(width * draw(0.85, 1.0), height + 0.1, draw(0.05, 0.3) * width), thickness, "z")
        return [_lean(panel.translate((0.0, height / 2 - 0.05, 0.0)), lean / height, foot)]
    post, half = draw(0.05, 0.09), width / 2 - 0.06
    posts = [rod((x, -0.05, 0.0), (x, height, 0.0), post / 2 + 0.01, segments=12) for x in (-half, half)]
    rail = box((2 * half, draw(0.1, 0.2), 0.05), (0.0, height - 0.1, 0.0))
    solids = [*posts, rail]
    if style == "ladder":
        solids += [
            box((2 * half, draw(0.08, 0.16), 0.045), (0.0, share * height, 0.0))
            for share in np.linspace(0.28, 0.72, int(generator.integers(2, 4)))
        ]
    else:
        count = int(generator.integers(3, 7))
        wide = 0.5 * 2 * half / count if style == "slats" else 0.045
        solids += [
            box((wide, height - 0.05, 0.04), (x, (height - 0.1) / 2 - 0.025, 0.0))
            for x in np.linspace(-half, half, count + 2)[1:-1]
        ]
    return [_lean(union(*solids), lean / height, foot)]


def _shell_back(generator: np.random.Generator, width: float, height: float, lean: float) -> Manifold:
    """Return a back that is bent around the sitter, widest at mid-height."""
    bow = generator.uniform(0.05, 0.2)
    share = np.linspace(0.0, 1.0, 8)
    half = width / 2 * (0.7 + 0.35 * np.sin(np.pi * (0.25 + 0.6 * share)))
    rings = []
    for angle in np.radians(np.linspace(0.0, 180.0, 12)):
        across, along = np.cos(angle), np.sin(angle)
        outer = np.column_stack([half * across, height * share - 0.06, (bow + 0.06) * along + lean * share])
        inner = np.column_stack([(half - 0.05) * across, height * share - 0.06, bow * along + lean * share])
        rings.append(np.vstack([outer, inner[::-1]]))
    return loft(np.stack(rings))


def _lean(solid: Manifold, slope: float, foot: float) -> Manifold:
    """Shear a back so that it recedes by `slope` a unit of height, and move it to z = `foot`."""
    return solid.transform(np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, slope, 1, foot]]))


def _base(generator: np.random.Generator, style: str, width: float, depth: float, round_seat: bool) -> list[Manifold]:
    draw = generator.uniform
    height, inset = draw(0.75, 1.15), 0.68 if round_seat else 0.9
    x, z = inset * width / 2 - 0.03, inset * depth / 2 - 0.03
    if style in ("four legs", "splayed"):
        return _legs(generator, height, x, z, splay=draw(0.1, 0.25) if style == "splayed" else 0.0)
    if style == "sled":
        radius = draw(0.03, 0.045)
        frame = [(0.0, z), (-height, z), (-height, -z), (0.0, -z)]
        rods = [rod((s * x, a, b), (s * x, c, d), radius) for s in (-1, 1) for (a, b), (c, d) in pairwise(frame)]
        joints = [box((2.2 * radius,) * 3, (s * x, -height, b)) for s in (-1, 1) for b in (-z, z)]
        return [union(*rods, *joints, rod((-x, -0.95 * height, z), (x, -0.95 * height, z), 0.8 * radius))]
    column = rod((0.0, 0.0, 0.0), (0.0, -height, 0.0), draw(0.05, 0.09))
    if style == "pedestal":
        foot = rod((0.0, -height, 0.0), (0.0, -height + 0.08, 0.0), draw(0.4, 0.5), 0.2, segments=32)
        return [union(column, foot)]
    count, reach = int(generator.choice([4, 5, 5])), draw(0.5, 0.6)
    star = []
    for angle in 2 * np.pi * np.arange(count) / count:
        tip = (reach * np.sin(angle), -height - 0.06, reach * np.cos(angle))
        star += [
            beam((0.0, -height + 0.05, 0.0), tip, 0.09, 0.08, 0.6),
            rod((tip[0] - 0.03, tip[1] - 0.05, tip[2]), (tip[0] + 0.03, tip[1] - 0.05, tip[2]), 0.06, segments=12),
        ]
    return [union(column, *star)]


def _legs(generator: np.random.Generator, height: float, x: float, z: float, *, splay: float) -> list[Manifold]:
    draw = generator.uniform
    thick, taper = draw(0.035, 0.065), draw(0.5, 1.0)
    square = draw() < 0.5
    solids = []
    for i in (-1, 1):
        for k in (-1, 1):
            top, foot = (
                (i * x * (1 - splay), 0.0, k * z * (1 - splay)),
                (i * x * (1 + splay), -height, k * z * (1 + splay)),
            )
            solids.append(
                beam(top, foot, 1.8 * thick, 1.8 * thick, taper) if square else rod(top, foot, thick, taper * thick)
            )
    if draw() < 0.45:
        level, spread = draw(0.4, 0.75), 1.0
        spread = 1 - splay + 2 * splay * level
        y, r = -level * height, 0.55 * thick
        solids += [rod((s * x * spread, y, -z * spread), (s * x * spread, y, z * spread), r) for s in (-1, 1)]
        solids.append(rod((-x * spread, y, 0.0), (x * spread, y, 0.0), r))
    return [union(*solids)]


def _arms(generator: np.random.Generator, width: float, depth: float, round_seat: bool) -> list[Manifold]:
    draw = generator.uniform
    x, height, thick = width / 2 * (0.86 if round_seat else 0.98), draw(0.35, 0.5), draw(0.05, 0.08)
    front = (-0.2 if round_seat else -0.36) * depth
    rest = rounded_box(
        (thick + 0.05, 0.06, depth / 2 + 0.1 - front), (0.0, height, (front + depth / 2 + 0.1) / 2), 0.025
    )
    if draw() < 0.3:
        support = box((0.06, height + 0.02, depth / 2 - front - 0.05), (0.0, height / 2, (front + depth / 2) / 2))
    else:
        post = rod((0.0, -0.02, front + 0.06), (0.0, height, front + 0.06 - draw(-0.03, 0.03)), thick / 2)
        rear = rod((0.0, -0.02, depth / 2 - 0.1), (0.0, height, depth / 2 - 0.06), thick / 2)
        support = union(post, rear)
    bracket = box((0.14, 0.05, 0.5 * depth), (-0.06, 0.0, 0.05))
    arm = union(rest, support, bracket)
    return [arm.translate((x, 0.0, 0.0)), arm.mirror((1.0, 0.0, 0.0)).translate((-x, 0.0, 0.0))]


def _armchair(generator: np.random.Generator) -> list[Part]:
    """Return a low upholstered chair with closed arms and short legs."""
    draw = generator.uniform
    width, depth, arm, height = draw(0.9, 1.5), draw(0.8, 1.0), draw(0.14, 0.26), draw(0.3, 0.45)
    parts = [Part("seat", rounded_box((width + 0.06, 0.32, depth), (0.0, 0.0, 0.0), 0.06))]
    back = rounded_box((width + 2 * arm - 0.02, draw(0.9, 1.2), 0.24), (0.0, 0.35, 0.0), 0.08)
    parts.append(Part("back", _lean(back, draw(0.0, 0.2), depth / 2 + 0.04)))
    for sign in (-1.0, 1.0):
        solid = rounded_box(
            (arm, 0.36 + height, depth + 0.02), (sign * (width / 2 + arm / 2), height / 2 - 0.02, 0.0), 0.06
        )
        parts.append(Part("arm", solid))
        for z in (-0.4 * depth, 0.4 * depth):
            foot = (sign * (width / 2 + 0.3 * arm), -0.14, z)
            parts.append(Part("leg", rod(foot, (foot[0], -0.14 - draw(0.14, 0.2), z), 0.05, 0.035)))
    return parts
