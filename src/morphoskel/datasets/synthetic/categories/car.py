"""Sedans, hatchbacks, off-road cars, pick-ups, vans and sports cars; front towards negative z."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import embed, superellipse
from morphoskel.datasets.synthetic.primitives import ball, both_sides, box, hull, lathe, loft, rod, rounded_box, union


@dataclass(frozen=True)
class _Plan:
    """Lengths along z as shares of the car's length (front 0, rear 1); heights as shares of it as well."""

    windscreen: tuple[float, float]
    rear_window: tuple[float, float]
    belt: float
    roof: float


_PLANS = {
    "sedan": _Plan((0.28, 0.41), (0.7, 0.85), 0.19, 0.31),
    "hatchback": _Plan((0.24, 0.4), (0.86, 0.96), 0.2, 0.35),
    "off-road": _Plan((0.27, 0.34), (0.9, 0.97), 0.24, 0.4),
    "pick-up": _Plan((0.27, 0.36), (0.55, 0.6), 0.22, 0.36),
    "van": _Plan((0.1, 0.22), (0.96, 0.98), 0.22, 0.44),
    "sports": _Plan((0.34, 0.5), (0.64, 0.86), 0.17, 0.25),
}


def build_car(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random car one unit long."""
    draw = generator.uniform
    kind = str(generator.choice(sorted(_PLANS)))
    plan = _PLANS[kind]
    half_width = draw(0.19, 0.22)
    belt, roof = plan.belt * draw(0.93, 1.07), plan.roof * draw(0.94, 1.06)
    shift = draw(-0.03, 0.03)
    screen = (plan.windscreen[0] + shift, plan.windscreen[1] + shift)
    wheel = draw(0.065, 0.08) * (1.2 if kind == "off-road" else 1.0)
    axles = (draw(0.17, 0.21), draw(0.77, 0.82))
    ground = 0.75 * wheel
    body = _hull_body(half_width, ground, belt, sharp=draw(3.0, 5.0), nose=draw(0.62, 0.85), rear=draw(0.8, 0.95))
    cabin = _cabin(half_width, belt, roof, screen, plan.rear_window)
    body = union(body, cabin, *_details(generator, kind, half_width, belt, screen))
    if kind == "pick-up":
        body -= box((1.3 * half_width, 0.16, 0.33), (0.0, belt + 0.02, 0.79))
    parts = []
    for share in axles:
        body -= rod((-1.0, wheel, share), (1.0, wheel, share), 1.18 * wheel) - box(
            (1.36 * half_width, 1.0, 1.0), (0.0, 0.0, share)
        )
        parts += [
            Part("wheel", _wheel(wheel, sign).translate((sign * 0.74 * half_width, wheel, share)))
            for sign in (-1.0, 1.0)
        ]
    parts.append(Part("body", body))
    parts.append(Part("roof", _roof(half_width, roof, screen[1], plan.rear_window[0])))
    if kind != "van":
        parts.append(Part("hood", _hood(half_width, belt, screen[0])))
    return parts


def _hull_body(half_width: float, ground: float, belt: float, *, sharp: float, nose: float, rear: float) -> Manifold:
    """Return the lower body: rounded boxy sections whose upper edge falls towards the nose and the rear."""
    rings = []
    for share, tall, wide in [
        (0.0, 0.5 * nose, 0.7),
        (0.02, 0.9 * nose, 0.86),
        (0.08, nose, 0.95),
        (0.22, 0.5 * (1 + nose), 1.0),
        (0.35, 1.0, 1.0),
        (0.75, 1.0, 1.0),
        (0.92, rear, 0.96),
        (0.98, 0.9 * rear, 0.9),
        (1.0, 0.6 * rear, 0.78),
    ]:
        top = ground + tall * (belt - ground)
        section = superellipse(wide * half_width, (top - ground) / 2, sharp)
        rings.append(embed(section, "z", share, shift=(0.0, (top + ground) / 2, 0.0)))
    return loft(np.stack(rings))


def _cabin(
    half_width: float, belt: float, roof: float, screen: tuple[float, float], rear: tuple[float, float]
) -> Manifold:
    low, high = 0.6 * belt, roof - 0.012
    corners = [(x, low, z) for x in (-0.9 * half_width, 0.9 * half_width) for z in (screen[0], rear[1])]
    corners += [(x, high - 0.015, z) for x in (-0.74 * half_width, 0.74 * half_width) for z in (screen[1], rear[0])]
    corners += [
        (x, high, z) for x in (-0.64 * half_width, 0.64 * half_width) for z in (screen[1] + 0.02, rear[0] - 0.02)
    ]
    return hull(corners)


def _roof(half_width: float, roof: float, front: float, rear: float) -> Manifold:
    middle, length = (front + rear) / 2, rear - front
    return rounded_box((1.42 * half_width, 0.03, max(length, 0.1)), (0.0, roof - 0.012, middle), 0.013)


def _hood(half_width: float, belt: float, cowl: float) -> Manifold:
    """Return the bonnet, a thin plate that swells out of the front of the body."""
    return (
        rounded_box((1.5 * half_width, 0.04, cowl - 0.03), (0.0, 0.0, 0.0), 0.018)
        .rotate((-4.0, 0.0, 0.0))
        .translate((0.0, belt - 0.024, 0.5 * (cowl + 0.05)))
    )


def _wheel(radius: float, outward: float) -> Manifold:
    """Return a wheel on the axis x with a dished rim on the side of `outward`."""
    half = 0.5 * radius
    profile = [
        (0.0, -half),
        (0.9 * radius, -half),
        (radius, -0.8 * half),
        (radius, 0.8 * half),
        (0.9 * radius, half),
        (0.68 * radius, half),
        (0.6 * radius, 0.5 * half),
        (0.25 * radius, 0.5 * half),
        (0.2 * radius, 0.8 * half),
        (0.0, 0.8 * half),
    ]
    return lathe([(r, outward * z) for r, z in profile], "x", segments=24)


def _details(
    generator: np.random.Generator, kind: str, half_width: float, belt: float, screen: tuple[float, float]
) -> list[Manifold]:
    """Return mirrors, bumpers and, now and then, a spoiler or a roof rack."""
    draw = generator.uniform
    solids = [rounded_box((1.7 * half_width, 0.045, 0.04), (0.0, 0.5 * belt, z), 0.018) for z in (0.012, 0.988)]
    mirror_at = screen[0] + 0.5 * (screen[1] - screen[0]) + 0.04
    mirror = ball((0.05, 0.018, 0.015), (0.95 * half_width, belt + 0.015, mirror_at), 10)
    solids += both_sides(mirror)
    if kind in ("sports", "sedan") and draw() < 0.5:
        up = belt + draw(0.02, 0.05)
        solids += [box((1.7 * half_width, 0.014, 0.06), (0.0, up, 0.95))]
        solids += [
            box((0.02, up - belt + 0.08, 0.03), (x * half_width, (up + belt - 0.08) / 2, 0.95)) for x in (-0.6, 0.6)
        ]
    if kind == "off-road" and draw() < 0.6:
        solids.append(rod((0.0, 0.7 * belt, 0.97), (0.0, 0.7 * belt, 1.035), 0.065))
    return solids
