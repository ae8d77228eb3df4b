"""Rockets standing upright, nose up."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import smooth_path
from morphoskel.datasets.synthetic.primitives import ball, lathe, prism, rod, union


def build_rocket(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random rocket; the top of its body lies at height 1."""
    draw = generator.uniform
    kind = str(generator.choice(["launcher", "missile", "toy"]))
    base, top, profile = _body_profile(generator, kind)
    parts = [Part("body", union(lathe([(0.0, -1.0), *profile, (0.0, 1.0)]), _nozzle(base * draw(0.55, 0.8))))]
    nose = draw(0.5, 1.0) if kind == "missile" else draw(0.3, 0.6)
    parts.append(Part("nose", _nose(generator, top, nose)))
    count = int(generator.choice([3, 4, 4, 5] if kind == "toy" else [3, 4, 4]))
    fin = _fin(generator, base, kind)
    parts += [Part("fin", fin.rotate((0.0, 360.0 * index / count, 0.0))) for index in range(count)]
    if kind == "missile" and draw() < 0.7:
        canard = prism([(0.5 * top, 0.45), (2.4 * top, 0.5), (2.4 * top, 0.58), (0.5 * top, 0.72)], 0.03, "z")
        parts += [Part("fin", canard.rotate((0.0, 360.0 * index / count, 0.0))) for index in range(count)]
    if kind == "launcher" and draw() < 0.7:
        booster = _booster(generator, base)
        number = int(generator.choice([2, 4])) if count == 4 else count
        turns = 360.0 * np.arange(number) / number + 180.0 / count
        parts += [Part("body", booster.rotate((0.0, turn, 0.0))) for turn in turns]
    return parts


def _booster(generator: np.random.Generator, base: float) -> Manifold:
    """Return a side rocket and the strut that ties it to the body of radius `base`."""
    draw = generator.uniform
    radius, height = base * draw(0.45, 0.7), draw(0.0, 0.6)
    tip = height + 3 * radius
    tank = lathe([(0.0, -1.1), (radius, -1.1), (radius, height), (0.15 * radius, tip), (0.0, tip)], segments=20)
    strut = rod((-radius, -0.7, 0.0), (-0.5 * radius, -0.7, 0.0), 0.5 * radius)
    return union(tank, strut).translate((base + 0.9 * radius, 0.0, 0.0))


def _body_profile(generator: np.random.Generator, kind: str) -> tuple[float, float, list[tuple[float, float]]]:
    """Return base radius, top radius and the ``(radius, height)`` points between heights -1 and 1."""
    draw = generator.uniform
    if kind == "toy":
        base, belly, top = draw(0.18, 0.28), draw(0.34, 0.46), draw(0.22, 0.3)
        curve = smooth_path([(base, -1.0, 0.0), (belly, draw(-0.3, 0.1), 0.0), (top, 1.0, 0.0)], 14)
        return base, top, [(float(r), float(y)) for r, y, _ in curve]
    base = draw(0.15, 0.24) if kind == "launcher" else draw(0.09, 0.14)
    if kind == "missile" or draw() < 0.4:
        return base, base, [(base, -1.0), (base, 1.0)]
    top, step = base * draw(0.6, 0.85), draw(-0.1, 0.4)
    return base, top, [(base, -1.0), (base, step), (top, step + 0.12), (top, 1.0)]


def _nose(generator: np.random.Generator, radius: float, length: float) -> Manifold:
    style = str(generator.choice(["ogive", "cone", "round", "spike"]))
    radius *= 1.0 if style == "cone" else generator.choice([1.0, 1.25])
    if style == "round":
        return ball((radius, 0.7 * length, radius), (0.0, 1.0, 0.0), 24)
    along = np.linspace(0.0, 0.97, 9)
    shape = 1.0 - along if style == "cone" else 1.0 - along**1.8
    profile = [
        (0.0, 0.93),
        (radius, 0.98),
        *((radius * s, 1.0 + length * a) for s, a in zip(shape, along, strict=True)),
    ]
    cone = lathe([*profile, (0.0, 1.0 + length)])
    if style != "spike":
        return cone
    return union(cone, rod((0.0, 1.0 + 0.8 * length, 0.0), (0.0, 1.3 + length, 0.0), 0.025))


def _fin(generator: np.random.Generator, base: float, kind: str) -> Manifold:
    draw = generator.uniform
    inner, reach, thickness = 0.6 * base, base + draw(0.18, 0.45), draw(0.035, 0.06)
    if kind == "toy":
        reach += 0.15
        outline = [(inner, draw(-0.5, -0.3)), (0.75 * reach, -0.75), (reach, -1.3), (0.8 * reach, -1.3), (inner, -0.95)]
    elif draw() < 0.5:
        outline = [(inner, draw(-0.6, -0.3)), (reach, draw(-0.95, -0.8)), (reach, -1.05), (inner, -0.98)]
    else:
        outline = [(inner, draw(-0.6, -0.4)), (reach, -1.0), (reach, -1.2), (inner, -0.98)]
    return prism(outline, thickness, "z")


def _nozzle(radius: float) -> Manifold:
    profile = [
        (0.0, -0.95),
        (0.5 * radius, -0.95),
        (radius, -1.18),
        (0.8 * radius, -1.18),
        (0.4 * radius, -1.05),
        (0.0, -1.05),
    ]
    return lathe(profile, segments=20)
