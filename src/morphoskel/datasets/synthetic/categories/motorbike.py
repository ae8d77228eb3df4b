"""Cruisers, naked bikes, sports bikes and trail bikes; front wheel towards negative z."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, embed, smooth_path, superellipse
from morphoskel.datasets.synthetic.primitives import ball, box, lathe, loft, rod, rounded_box, tube, union


@dataclass(frozen=True)
class _Frame:
    """The measures that all parts of one bike share."""

    front: float  # z of the front axle
    rear: float  # z of the rear axle
    wheel: float  # outer radius of the wheels
    saddle: float  # height of the seat
    head: tuple[float, float]  # height and z of the steering head

    @property
    def tank_span(self) -> tuple[float, float]:
        """Front and rear end of the tank along z."""
        return self.head[1] + 0.1, 0.12

    @property
    def tank_centre(self) -> tuple[float, float, float]:
        """Middle of the tank."""
        return 0.0, 0.5 * (self.head[0] + self.saddle) + 0.03, 0.5 * sum(self.tank_span)


def build_motorbike(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random motorbike about two units long."""
    draw = generator.uniform
    kind = str(generator.choice(["cruiser", "naked", "sports", "trail"]))
    wheel = draw(0.3, 0.37)
    rake = {"cruiser": draw(0.35, 0.48), "naked": 0.28, "sports": 0.25, "trail": 0.28}[kind]
    saddle = wheel + {"cruiser": 0.2, "naked": 0.32, "sports": 0.36, "trail": 0.45}[kind] + draw(-0.03, 0.03)
    head_height = wheel + draw(0.45, 0.55)
    frame = _Frame(-draw(0.7, 0.8), draw(0.6, 0.72), wheel, saddle, (head_height, -0.75 + rake))
    tyre = draw(0.06, 0.09) * (0.8 if kind == "trail" else 1.0)
    spoked = kind in ("trail", "cruiser") or draw() < 0.3
    front_wheel = _wheel(wheel, tyre, spoked)
    parts = [
        Part("body", union(*_chassis(generator, frame), *_fork(frame, tyre), *_mudguards(frame, tyre, kind))),
        Part("tank", _tank(generator, frame)),
        Part("seat", _seat(generator, frame, kind)),
        Part("wheel", front_wheel.translate((0.0, wheel, frame.front))),
        Part("wheel", front_wheel.scale((1.25, 1.0, 1.0)).translate((0.0, wheel, frame.rear))),
        Part("handle", _handlebar(generator, frame, kind)),
    ]
    faired = kind == "sports" or (kind == "naked" and draw() < 0.3)
    if draw() < 0.85:
        y, z = frame.head
        lamp = draw(0.08, 0.11)
        parts.append(Part("light", _headlamp(lamp).translate((0.0, y - 0.03, z - (0.24 if faired else 0.1)))))
    if faired:
        parts.append(Part("body", _fairing(generator, frame)))
    return parts


def _wheel(radius: float, tyre: float, spoked: bool) -> Manifold:
    inner = radius - 2.0 * tyre
    ring = lathe(arc((radius - tyre, 0.0), (tyre, tyre), (0.0, 330.0), 12), "x", segments=32)
    rim = lathe(
        [
            (inner - 0.02, -0.6 * tyre),
            (inner + 0.03, -0.6 * tyre),
            (inner + 0.03, 0.6 * tyre),
            (inner - 0.02, 0.6 * tyre),
        ],
        "x",
    )
    hub = rod((-1.3 * tyre, 0.0, 0.0), (1.3 * tyre, 0.0, 0.0), 0.06)
    count, thickness = (9, 0.014) if spoked else (5, 0.03)
    spokes = [
        rod((0.0, 0.0, 0.0), (0.0, inner * np.sin(angle), inner * np.cos(angle)), thickness, segments=8)
        for angle in 2 * np.pi * np.arange(count) / count
    ]
    return union(ring, rim, hub, *spokes)


def _chassis(generator: np.random.Generator, frame: _Frame) -> list[Manifold]:
    """Return engine, frame tubes, swing arm and exhaust."""
    draw = generator.uniform
    y, z = frame.head
    low = 0.75 * frame.wheel
    solids = [rounded_box((0.24, draw(0.26, 0.32), draw(0.4, 0.48)), (0.0, low + 0.16, -0.06), 0.05)]
    for tilt in (-40.0, 35.0) if draw() < 0.5 else (-20.0,):
        cylinder = lathe([(0.0, 0.0), (0.09, 0.0), (0.09, 0.3), (0.0, 0.3)], segments=14).rotate((tilt, 0.0, 0.0))
        solids.append(cylinder.translate((0.0, low + 0.2, -0.06)))
    solids.append(
        tube(
            smooth_path([(0.0, y - 0.05, z), (0.0, frame.saddle - 0.03, -0.05), (0.0, frame.saddle - 0.06, 0.45)], 12),
            0.045,
        )
    )
    solids.append(rod((0.0, y - 0.12, z + 0.02), (0.0, low + 0.12, -0.22), 0.035))
    solids.append(rod((0.0, frame.saddle - 0.03, -0.05), frame.tank_centre, 0.035))
    solids.append(rod((0.0, frame.saddle - 0.06, 0.3), (0.0, low + 0.1, 0.1), 0.035))
    for side in (-0.11, 0.11):
        solids.append(rod((side, low + 0.1, 0.08), (side, frame.wheel, frame.rear), 0.03))
        solids.append(rod((side, frame.saddle - 0.05, 0.35), (side, frame.wheel, frame.rear), 0.024))
    solids.append(rod((-0.13, frame.wheel, frame.rear), (0.13, frame.wheel, frame.rear), 0.025))
    solids.append(rod((-0.13, frame.saddle - 0.05, 0.35), (0.13, frame.saddle - 0.05, 0.35), 0.025))
    solids.append(rod((-0.13, low + 0.1, 0.08), (0.13, low + 0.1, 0.08), 0.035))
    bend = [(0.1, low + 0.25, -0.28), (0.14, low - 0.02, -0.22), (0.16, low - 0.02, 0.1)]
    lift = draw(0.0, 0.3)
    solids.append(tube(smooth_path(bend, 12), 0.03))
    solids.append(rod((0.16, low - 0.02, 0.06), (0.17, low + lift, draw(0.65, 0.9)), 0.035, 0.06))
    return solids


def _fork(frame: _Frame, tyre: float) -> list[Manifold]:
    y, z = frame.head
    side = 1.2 * tyre + 0.02
    legs = [rod((x, frame.wheel, frame.front), (x, y + 0.06, z), 0.028) for x in (-side, side)]
    yoke = [box((2 * side + 0.06, 0.04, 0.1), (0.0, y + offset, z)) for offset in (-0.06, 0.04)]
    return [
        *legs,
        *yoke,
        rod((0.0, y - 0.1, z), (0.0, y + 0.07, z), 0.04),
        rod((-side, frame.wheel, frame.front), (side, frame.wheel, frame.front), 0.025),
    ]


def _mudguards(frame: _Frame, tyre: float, kind: str) -> list[Manifold]:
    """Return a guard over each wheel, held by the fork in front and by the seat tubes behind."""
    gap = frame.wheel + (0.1 if kind == "trail" else 0.04)
    solids = []
    for axle, degrees, half in ((frame.front, (35.0, 115.0), 1.2 * tyre + 0.03), (frame.rear, (30.0, 120.0), 0.14)):
        outer = arc((axle, frame.wheel), (gap + 0.03, gap + 0.03), degrees, 16)
        inner = arc((axle, frame.wheel), (gap, gap), degrees, 16)
        rings = [
            np.vstack(
                [
                    embed(p[None], "x", -half),
                    embed(q[None], "x", -half),
                    embed(q[None], "x", half),
                    embed(p[None], "x", half),
                ]
            )
            for p, q in zip(outer, inner, strict=True)
        ]
        solids.append(loft(np.stack(rings)))
    at = np.radians(55.0)
    rim = (frame.wheel + (gap + 0.015) * np.sin(at), frame.rear + (gap + 0.015) * np.cos(at))
    return [*solids, *(rod((x, frame.wheel, frame.rear), (x, *rim), 0.018, segments=8) for x in (-0.125, 0.125))]


def _tank(generator: np.random.Generator, frame: _Frame) -> Manifold:
    draw = generator.uniform
    height, width = draw(0.1, 0.14), draw(0.13, 0.18)
    front, back = frame.tank_span
    middle_height = frame.tank_centre[1]
    rings = []
    for share, size in ((0.0, 0.35), (0.1, 0.7), (0.3, 1.0), (0.6, 0.85), (0.9, 0.55), (1.0, 0.35)):
        y = middle_height + (0.5 - share) * 0.6 * (frame.head[0] - frame.saddle)
        rings.append(
            embed(
                superellipse(size * width, size * height, 2.5, 18),
                "z",
                front + share * (back - front),
                shift=(0.0, y, 0.0),
            )
        )
    return loft(np.stack(rings))


def _seat(generator: np.random.Generator, frame: _Frame, kind: str) -> Manifold:
    draw = generator.uniform
    length = draw(0.55, 0.7) if kind != "trail" else 0.75
    rise = {"cruiser": 0.1, "naked": 0.04, "sports": 0.16, "trail": 0.03}[kind]
    rings = []
    for share, size in ((0.0, 0.6), (0.08, 0.8), (0.4, 1.0), (0.6, 0.95), (0.92, 0.75), (1.0, 0.5)):
        lift = rise * max(share - 0.4, 0.0) / 0.6
        rings.append(
            embed(
                superellipse(0.14 * size, 0.065 * size, 3.0, 18),
                "z",
                0.05 + share * length,
                shift=(0.0, frame.saddle + lift, 0.0),
            )
        )
    return loft(np.stack(rings))


def _handlebar(generator: np.random.Generator, frame: _Frame, kind: str) -> Manifold:
    draw = generator.uniform
    y, z = frame.head
    rise = {"cruiser": draw(0.15, 0.35), "naked": 0.1, "sports": 0.02, "trail": 0.14}[kind]
    width, back = draw(0.34, 0.44), {"cruiser": 0.25, "naked": 0.1, "sports": 0.08, "trail": 0.06}[kind]
    half = [
        (0.0, y + 0.05, z),
        (0.12, y + 0.06, z),
        (0.2, y + 0.05 + rise, z + 0.02),
        (width, y + 0.04 + rise, z + back),
    ]
    bar = tube(smooth_path([(-x, v, w) for x, v, w in reversed(half[1:])] + half, 28), 0.024, 8)
    grips = [
        rod(
            (s * (width - 0.12), y + 0.045 + rise, z + 0.55 * back + 0.02),
            (s * (width + 0.02), y + 0.04 + rise, z + 1.05 * back),
            0.036,
        )
        for s in (-1, 1)
    ]
    return union(bar, *grips, ball(0.05, (0.0, y + 0.05, z), 12))


def _headlamp(radius: float) -> Manifold:
    """Return a round lamp that faces negative z, long enough behind to meet what holds it."""
    profile = [(0.0, -1.2), (0.5, -1.1), (1.0, -0.8), (1.0, -0.6), (0.8, 0.0), (0.3, 1.0), (0.0, 1.0)]
    return lathe([(radius * r, radius * z) for r, z in profile], "z", segments=20)


def _fairing(generator: np.random.Generator, frame: _Frame) -> Manifold:
    """Return the nose cowl and belly of a sports bike as one smooth shell around the engine."""
    draw = generator.uniform
    y, z = frame.head
    width = draw(0.15, 0.19)
    low = 0.6 * frame.wheel
    rings = []
    for share, top, bottom, size in (
        (0.0, 0.02, -0.12, 0.35),
        (0.15, 0.08, -0.2, 0.7),
        (0.35, 0.08, -0.4, 0.95),
        (0.6, -0.08, low - y, 1.0),
        (1.0, -0.25, low - y + 0.02, 0.75),
    ):
        section = superellipse(size * width, (top - bottom) / 2, 2.5, 20)
        rings.append(embed(section, "z", z - 0.24 + share * 0.75, shift=(0.0, y + (top + bottom) / 2, 0.0)))
    return loft(np.stack(rings))
