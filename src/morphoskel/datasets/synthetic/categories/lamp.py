"""Floor, table, desk and ceiling lamps."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, smooth_path
from morphoskel.datasets.synthetic.primitives import ball, box, lathe, lathe_shell, rod, rounded_box, tube, union


def build_lamp(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random lamp."""
    kind = str(generator.choice(["floor", "table", "desk", "pendant", "chandelier", "bow"]))
    builders = {"desk": _desk_lamp, "pendant": _pendant, "chandelier": _chandelier, "bow": _bow_lamp}
    if kind in builders:
        return builders[kind](generator)
    return _standing_lamp(generator, tall=kind == "floor")


def _standing_lamp(generator: np.random.Generator, *, tall: bool) -> list[Part]:
    draw = generator.uniform
    height = draw(1.8, 2.6) if tall else draw(0.7, 1.1)
    stem = draw(0.03, 0.05)
    parts = []
    if tall and draw() < 0.3:
        legs = [
            rod((0.0, 0.75 * height, 0.0), (0.5 * np.sin(a), 0.0, 0.5 * np.cos(a)), 0.035)
            for a in 2 * np.pi * np.arange(3) / 3
        ]
        parts.append(Part("base", union(*legs)))
        low = 0.65 * height
    elif not tall and draw() < 0.5:
        belly, neck = draw(0.22, 0.36), draw(0.05, 0.09)
        curve = smooth_path([(0.18, 0.0, 0.0), (belly, 0.3 * height, 0.0), (neck, 0.7 * height, 0.0)], 12)
        parts.append(
            Part("base", lathe([(0.0, 0.0), *((float(r), float(y)) for r, y, _ in curve), (0.0, 0.7 * height)]))
        )
        low = 0.6 * height
    else:
        parts.append(Part("base", _foot(generator, draw(0.25, 0.38))))
        low = 0.02
    wide, high = (draw(0.35, 0.55), draw(0.35, 0.6))
    shade, hang = _shade(generator, wide, high)
    parts.append(Part("pole", rod((0.0, low, 0.0), (0.0, height + hang + 0.08, 0.0), stem)))
    parts.append(Part("shade", shade.translate((0.0, height, 0.0))))
    return parts


def _foot(generator: np.random.Generator, radius: float) -> Manifold:
    if generator.uniform() < 0.3:
        return rounded_box((2 * radius, 0.07, 2 * radius), (0.0, 0.035, 0.0), 0.02)
    rise = generator.uniform(0.03, 0.16)
    return lathe([(0.0, 0.0), (radius, 0.0), (radius, 0.04), (0.25 * radius, 0.04 + rise), (0.0, 0.04 + rise)])


def _shade(generator: np.random.Generator, wide: float, high: float) -> tuple[Manifold, float]:
    """Return a shade from height 0 upwards, held by the pole, and the height of its holder."""
    draw = generator.uniform
    style = str(generator.choice(["cone", "drum", "bell", "globe", "box"]))
    if style == "globe":
        radius = draw(0.25, 0.35)
        return ball(radius, (0.0, radius - 0.03, 0.0), 28), -0.05
    hold = 0.75 * high
    wall = 0.04
    if style == "box":
        outer = box((2 * wide * 0.8, high, 2 * wide * 0.8), (0.0, high / 2, 0.0))
        shade = outer - box((1.6 * wide - 2 * wall, 2 * high, 1.6 * wide - 2 * wall), (0.0, high / 2, 0.0))
        reach = 0.8 * wide
    else:
        top = {"cone": draw(0.3, 0.6), "drum": draw(0.85, 1.0), "bell": draw(0.35, 0.5)}[style] * wide
        bulge = -0.3 if style == "bell" else 0.0
        share = np.linspace(0.0, 1.0, 7)
        radii = wide + (top - wide) * share + bulge * (wide - top) * np.sin(np.pi * share)
        shade = lathe_shell(np.column_stack([radii, high * share]), wall)
        reach = float(np.interp(0.75, share, radii)) - wall / 2
    spokes = [
        rod((0.0, hold, 0.0), (reach * np.sin(a), hold, reach * np.cos(a)), 0.018, segments=8)
        for a in 2 * np.pi * np.arange(4) / 4
    ]
    return union(shade, *spokes), hold


def _desk_lamp(generator: np.random.Generator) -> list[Part]:
    """Return a jointed arm with a reflector at its end."""
    draw = generator.uniform
    first, second = draw(0.7, 1.0), draw(0.6, 0.9)
    lean, bend = np.radians(draw(10.0, 35.0)), np.radians(draw(40.0, 75.0))
    elbow = np.array([0.0, 0.06 + first * np.cos(lean), first * np.sin(lean)])
    wrist = elbow + second * np.array([0.0, np.cos(bend), -np.sin(bend)])
    thick = draw(0.028, 0.045)
    arm = [
        rod((0.0, 0.03, 0.0), elbow, thick),
        rod(elbow, wrist, thick),
        ball(1.7 * thick, elbow, 12),
        ball(1.7 * thick, (0.0, 0.1, 0.0), 12),
    ]
    return [
        Part("base", _foot(generator, draw(0.28, 0.4))),
        Part("pole", union(*arm)),
        Part("shade", _reflector(generator).rotate((draw(-5.0, 40.0), 0.0, 0.0)).translate(tuple(wrist))),
    ]


def _reflector(generator: np.random.Generator) -> Manifold:
    """Return a bell open downwards with a closed neck at the origin."""
    draw = generator.uniform
    wide, high = draw(0.2, 0.32), draw(0.25, 0.4)
    outer = [(wide, -high), (0.85 * wide, -0.5 * high), (0.3 * wide, -0.05 * high), (0.28 * wide, 0.12), (0.0, 0.13)]
    return union(
        lathe_shell(outer, 0.03),
        ball(0.28 * wide, (0.0, -0.5 * high, 0.0), 14),
        rod((0.0, 0.12, 0.0), (0.0, -0.5 * high, 0.0), 0.04),
    )


def _pendant(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    drop = draw(0.6, 1.6)
    plate = lathe([(0.0, 0.0), (draw(0.12, 0.25), 0.0), (0.08, -0.09), (0.0, -0.09)])
    cord = rod((0.0, -0.04, 0.0), (0.0, -drop - 0.1, 0.0), draw(0.02, 0.035))
    wide, high = draw(0.35, 0.6), draw(0.3, 0.7)
    style = str(generator.choice(["dome", "cone", "globe", "drum"]))
    if style == "globe":
        shade = ball((wide, wide * draw(0.6, 1.0), wide), (0.0, -drop - 0.5 * wide, 0.0), 28)
    elif style == "drum":
        ring = lathe_shell([(wide, -high), (wide, 0.0)], 0.04)
        bars = [
            rod((-wide + 0.02, -0.05, 0.0), (wide - 0.02, -0.05, 0.0), 0.02).rotate((0.0, a, 0.0)) for a in (0.0, 90.0)
        ]
        shade = union(ring, *bars).translate((0.0, -drop, 0.0))
    else:
        dome = [*arc((0.0, -high), (wide, high), (0.0, 82.0), 12), (0.0, 0.0)]
        outer = dome if style == "dome" else [(wide, -high), (0.1, 0.0), (0.0, 0.02)]
        shade = lathe_shell(np.array(outer), 0.04).translate((0.0, -drop, 0.0))
    return [Part("canopy", plate), Part("pole", cord), Part("shade", shade)]


def _chandelier(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    drop, reach, count = draw(0.6, 1.0), draw(0.5, 0.8), int(generator.integers(3, 8))
    plate = lathe([(0.0, 0.0), (0.2, 0.0), (0.16, -0.08), (0.0, -0.08)])
    hub = -drop - 0.2
    stem = union(rod((0.0, -0.04, 0.0), (0.0, hub - 0.1, 0.0), 0.035), ball((0.12, 0.16, 0.12), (0.0, hub, 0.0), 16))
    dip, lift, size = draw(0.1, 0.3), draw(0.05, 0.25), draw(0.14, 0.2)
    upward = draw() < 0.6
    path = [
        (0.05, hub, 0.0),
        (0.5 * reach, hub - dip, 0.0),
        (0.9 * reach, hub - 0.5 * dip, 0.0),
        (reach, hub + lift, 0.0),
    ]
    cup = lathe(
        [(0.0, -0.06), (0.4 * size, -0.06), (size, 0.18), (0.85 * size, 0.18), (0.3 * size, 0.02), (0.0, 0.02)],
        segments=20,
    )
    shade = cup if upward else ball(size, (0.0, 0.6 * size, 0.0), 16)
    parts = [Part("canopy", plate)]
    arms = [tube(smooth_path(path, 16), 0.028, 8).rotate((0.0, 360.0 * i / count, 0.0)) for i in range(count)]
    parts.append(Part("pole", union(stem, *arms)))
    placed = shade.translate((reach, hub + lift, 0.0))
    return parts + [Part("shade", placed.rotate((0.0, 360.0 * i / count, 0.0))) for i in range(count)]


def _bow_lamp(generator: np.random.Generator) -> list[Part]:
    """Return a floor lamp whose stem bends over and lets the shade hang."""
    draw = generator.uniform
    height, reach = draw(1.6, 2.2), draw(0.5, 1.2)
    path = [
        (0.0, 0.03, 0.0),
        (0.02, 0.6 * height, 0.0),
        (0.35 * reach, height, 0.0),
        (reach, 0.92 * height, 0.0),
        (1.1 * reach, 0.8 * height, 0.0),
    ]
    stem = tube(smooth_path(path, 32), draw(0.03, 0.045))
    shade = _reflector(generator).scale((1.3, 1.2, 1.3)).translate((1.1 * reach, 0.8 * height - 0.1, 0.0))
    return [Part("base", _foot(generator, draw(0.3, 0.42))), Part("pole", stem), Part("shade", shade)]
