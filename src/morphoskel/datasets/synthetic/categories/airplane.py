"""Airliners, propeller planes and jet fighters; nose towards negative z."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import aerofoil, embed, superellipse
from morphoskel.datasets.synthetic.primitives import ball, both_sides, box, lathe, loft, union


def build_airplane(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random airplane about two units long."""
    kind = generator.choice(["airliner", "airliner", "propeller", "fighter"])
    builders = {"airliner": _airliner, "propeller": _propeller_plane, "fighter": _fighter}
    return builders[str(kind)](generator)


def _airliner(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    radius = draw(0.085, 0.13)
    layout = str(generator.choice(["two under wings", "four under wings", "two at rear"]))
    height = -0.5 * radius
    root, tip, span = draw(0.36, 0.5), draw(0.1, 0.18), draw(0.75, 1.05)
    lead, sweep, dihedral = draw(-0.3, -0.1), draw(0.3, 0.55), draw(0.03, 0.12)
    parts = [
        Part("body", _fuselage(radius, nose=draw(0.2, 0.35), taper=draw(0.5, 0.7))),
        Part("wing", _wing(span, root, tip, lead, sweep, height, dihedral)),
        *_tail(generator, radius, high=layout == "two at rear" or draw() < 0.15),
    ]
    size = draw(0.045, 0.065)
    if layout == "two at rear":
        nacelle = _nacelle((radius + 0.8 * size, 0.3 * radius, 0.45), size, draw(0.28, 0.36))
        return parts + [Part("engine", side) for side in both_sides(nacelle)]
    for share in (0.33,) if layout.startswith("two") else (0.3, 0.6):
        depth = lead + share * sweep + 0.02
        place = (share * span, height + share * dihedral - 1.35 * size, depth)
        nacelle = _nacelle(place, size, draw(0.26, 0.34))
        pylon = box((0.02, 1.7 * size, 0.14), (place[0], place[1] + 0.8 * size, depth + 0.05))
        parts += [Part("engine", side) for side in both_sides(union(nacelle, pylon))]
    return parts


def _propeller_plane(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    radius, twin = draw(0.1, 0.15), draw() < 0.45
    high_wing = draw() < 0.5
    height = (0.75 if high_wing else -0.6) * radius
    lead, root, span = draw(-0.45, -0.25), draw(0.28, 0.4), draw(0.8, 1.1)
    wing = _wing(span, root, root * draw(0.55, 1.0), lead, draw(0.0, 0.08), height, draw(0.0, 0.1))
    body = union(
        _fuselage(radius, nose=draw(0.15, 0.3), taper=draw(0.8, 1.1)),
        ball((0.75 * radius, 0.7 * radius, draw(0.2, 0.3)), (0.0, 0.8 * radius, -0.2)),
    )
    parts = [Part("body", body), Part("wing", wing), *_tail(generator, radius, high=draw() < 0.2, straight=True)]
    blades, blade = int(generator.integers(2, 5)), draw(0.18, 0.26)
    if not twin:
        return [*parts, Part("engine", _propeller((0.0, -0.1 * radius, -1.0), 0.4 * radius, blade, blades))]
    place = (draw(0.28, 0.36) * span, height, lead + 0.12)
    nacelle = lathe([(0.0, -0.2), (0.05, -0.19), (0.06, 0.0), (0.0, 0.3)], "z", place, 16)
    engine = union(nacelle, _propeller((place[0], place[1], lead - 0.08), 0.03, 0.8 * blade, blades))
    return parts + [Part("engine", side) for side in both_sides(engine)]


def _fighter(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    radius = draw(0.09, 0.12)
    body = union(
        _fuselage(radius, nose=draw(0.6, 0.9), taper=0.25, tail=0.75, flat=draw(1.0, 1.5), point=draw(1.4, 2.0)),
        ball((0.55 * radius, 0.75 * radius, 0.2), (0.0, 0.85 * radius, -0.4)),
    )
    span, lead, root = draw(0.5, 0.7), draw(-0.3, -0.05), draw(0.6, 0.85)
    wing = _wing(span, root, draw(0.08, 0.25), lead, draw(0.4, 0.6), -0.1 * radius, draw(-0.04, 0.04))
    parts = [Part("body", body), Part("wing", wing)]
    stabilizer = _wing(0.55 * span, 0.3, 0.12, 0.62, 0.2, 0.0, 0.0)
    fin_height, twin = draw(0.25, 0.38), draw() < 0.5
    fin = _fin(0.6, 0.34, fin_height, 0.15, draw(0.15, 0.3), 0.0)
    parts.append(Part("tail", stabilizer))
    if twin:
        leaning = fin.rotate((0.0, 0.0, -draw(5.0, 25.0))).translate((0.55 * radius, 0.0, 0.0))
        parts += [Part("tail", side) for side in both_sides(leaning)]
    else:
        parts.append(Part("tail", fin))
    bore = 0.5 * radius
    nozzle = lathe(
        [(0.0, -0.2), (bore, -0.2), (0.85 * bore, 0.1), (0.65 * bore, 0.1), (0.6 * bore, 0.0), (0.0, 0.0)], "z"
    )
    nozzles = (
        both_sides(nozzle.translate((0.55 * radius, 0.0, 0.98)))
        if twin
        else [nozzle.scale((1.5, 1.5, 1.0)).translate((0.0, 0.0, 0.98))]
    )
    return parts + [Part("engine", each) for each in nozzles]


def _fuselage(
    radius: float, *, nose: float, taper: float, tail: float = 0.12, flat: float = 1.0, point: float = 1.0
) -> Manifold:
    """Return a body of oval sections from z = -1 to 1.

    Parameters
    ----------
    radius
        Half the height of the straight middle.
    nose, taper
        Lengths of the nose and of the narrowing end.
    tail
        Size of the last section as a share of the middle.
    flat
        Width of a section over its height.
    point
        1 for an elliptic nose; more makes it more pointed.
    """
    front = 1.0 - np.cos(np.linspace(0.12, 0.5 * np.pi, 6))
    stations = np.concatenate([-1.0 + nose * front, np.linspace(1.0 - taper, 1.0, 6)])
    ahead = np.sqrt(1.0 - (1.0 - front) ** 2) ** point
    back = 1.0 - (1.0 - tail) * np.linspace(0.0, 1.0, 6) ** 1.6
    sizes = radius * np.concatenate([ahead, back])
    rise = np.concatenate([-0.25 * radius * (1 - ahead), 0.6 * (radius - radius * back)])
    rings = [
        embed(superellipse(flat * size, size), "z", station, shift=(0.0, up, 0.0))
        for station, size, up in zip(stations, sizes, rise, strict=True)
    ]
    return loft(np.stack(rings))


def _wing(span: float, root: float, tip: float, lead: float, sweep: float, height: float, dihedral: float) -> Manifold:
    """Return both wings in one: half `span`, chords, leading edge at the root, set-back and rise of the tip."""
    rings = []
    for side in (-1.0, 0.0, 1.0):
        chord = root if side == 0.0 else tip
        shift = (0.0, height + abs(side) * dihedral, lead + abs(side) * sweep)
        rings.append(embed(aerofoil(chord, max(0.11 * chord, 0.02)), "x", side * span, shift))
    return loft(np.stack(rings))


def _fin(lead: float, root: float, height: float, tip: float, sweep: float, base: float) -> Manifold:
    """Return an upright fin whose root chord starts at z = `lead`."""
    rings = []
    for up in (0.0, 1.0):
        chord = root + up * (tip - root)
        section = aerofoil(chord, max(0.1 * chord, 0.02))[:, ::-1]
        rings.append(embed(section, "y", base + up * height, (0.0, 0.0, lead + up * sweep)))
    return loft(np.stack(rings))


def _tail(generator: np.random.Generator, radius: float, *, high: bool, straight: bool = False) -> list[Part]:
    draw = generator.uniform
    height, sweep = draw(0.26, 0.36), draw(0.05, 0.12) if straight else draw(0.18, 0.28)
    fin = _fin(0.68, 0.3, height, 0.15, sweep, 0.4 * radius)
    span, chord = draw(0.28, 0.4), draw(0.16, 0.22)
    level = 0.4 * radius + height - 0.012 if high else 0.5 * radius
    lead = 0.68 + sweep if high else 0.76
    stabilizer = _wing(span, chord, 0.6 * chord, lead, 0.3 * sweep if straight else 0.6 * sweep, level, 0.02)
    return [Part("tail", fin), Part("tail", stabilizer)]


def _nacelle(place: tuple[float, float, float], radius: float, length: float) -> Manifold:
    """Return an engine with an open intake; `place` is the middle of its axis."""
    profile = [(0.0, -0.3), (0.75, -0.3), (0.85, -0.5), (1.0, -0.42), (1.0, 0.0), (0.6, 0.5), (0.0, 0.5)]
    return lathe([(radius * r, length * z) for r, z in profile], "z", place, 18)


def _propeller(place: tuple[float, float, float], hub: float, blade: float, blades: int) -> Manifold:
    spinner = lathe([(0.0, -0.09), (0.7 * hub, -0.05), (hub, 0.0), (hub, 0.16), (0.0, 0.16)], "z", (0.0, 0.0, 0.0), 14)
    one = box((0.045, blade, 0.018)).rotate((0.0, 20.0, 0.0)).translate((0.0, 0.5 * blade, -0.02))
    turned = [one.rotate((0.0, 0.0, 360.0 * index / blades)) for index in range(blades)]
    return union(spinner, *turned).translate(place)
