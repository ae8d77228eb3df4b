"""Pistols, revolvers and duelling pistols; muzzle towards negative z."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, embed, smooth_path
from morphoskel.datasets.synthetic.primitives import box, lathe, loft, prism, rod, rounded_box, tube, union


def build_pistol(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random pistol about two units long; the bore lies at height 0."""
    kind = str(generator.choice(["automatic", "automatic", "revolver", "revolver", "duelling"]))
    return {"automatic": _automatic, "revolver": _revolver, "duelling": _duelling}[kind](generator)


def _automatic(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    length, high, wide = draw(1.3, 1.8), draw(0.24, 0.32), draw(0.18, 0.24)
    rear = 0.45
    slide = rounded_box((wide, high, length), (0.0, 0.0, rear - length / 2), 0.025)
    frame_length = draw(0.7, 0.95) * length
    frame = rounded_box(
        (0.85 * wide, 0.14, frame_length), (0.0, -0.55 * high - 0.03, rear - 0.04 - frame_length / 2), 0.02
    )
    solids = [
        slide,
        frame,
        box((0.04, 0.06, 0.06), (0.0, high / 2 + 0.02, rear - length + 0.1)),
        box((0.1, 0.06, 0.06), (0.0, high / 2 + 0.02, rear - 0.1)),
    ]
    muzzle = rear - length
    extra = draw(0.35, 0.8) if draw() < 0.25 else draw(0.03, 0.12)
    solids.append(rod((0.0, 0.02, muzzle + 0.1), (0.0, 0.02, muzzle - extra), 0.11 if extra > 0.3 else 0.07))
    top = -0.5 * high - 0.06
    grip = _straight_grip(generator, top, draw(0.62, 0.85), 0.9 * wide)
    return [Part("barrel", union(*solids)), Part("grip", grip), *_trigger(generator, top - 0.04, 0.0)]


def _straight_grip(generator: np.random.Generator, top: float, length: float, wide: float) -> Manifold:
    draw = generator.uniform
    slope, deep = draw(0.1, 0.35), draw(0.34, 0.42)
    rings = []
    for share, size in ((0.0, 0.95), (0.25, 0.92), (0.7, 1.0), (1.0, 1.05)):
        z = 0.22 + slope * share * length
        rings.append(
            embed(
                [
                    (-0.5 * wide, z + 0.4 * size * deep),
                    (-0.5 * wide, z - 0.4 * size * deep),
                    (-0.2 * wide, z - 0.5 * size * deep),
                    (0.2 * wide, z - 0.5 * size * deep),
                    (0.5 * wide, z - 0.4 * size * deep),
                    (0.5 * wide, z + 0.4 * size * deep),
                    (0.2 * wide, z + 0.5 * size * deep),
                    (-0.2 * wide, z + 0.5 * size * deep),
                ],
                "y",
                top + 0.1 - share * (length + 0.1),
            )
        )
    grip = loft(np.stack(rings))
    foot = rounded_box((1.08 * wide, 0.07, 1.1 * deep), (0.0, top - length, 0.22 + slope * length), 0.02)
    return union(grip, foot) if draw() < 0.6 else grip


def _revolver(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    length, bore = draw(0.6, 1.4), draw(0.075, 0.1)
    drum, drum_length = draw(0.2, 0.26), draw(0.36, 0.48)
    front = -0.2 - drum_length
    flutes = [
        rod(
            (1.1 * drum * np.sin(a), -0.1 + 1.1 * drum * np.cos(a), front - 0.05),
            (1.1 * drum * np.sin(a), -0.1 + 1.1 * drum * np.cos(a), front + 0.65 * drum_length),
            0.26 * drum,
            segments=12,
        )
        for a in 2 * np.pi * (np.arange(6) + 0.5) / 6
    ]
    cylinder = rod((0.0, -0.1, front), (0.0, -0.1, front + drum_length), drum, segments=24)
    for flute in flutes:
        cylinder -= flute
    solids = [
        rod((0.0, 0.0, front + 0.1), (0.0, 0.0, front - length), bore),
        box((0.1, 0.14, length * draw(0.4, 0.95)), (0.0, -0.1, front - 0.2 * length - 0.1)),
        box((0.04, 0.09, 0.1), (0.0, bore + 0.03, front - length + 0.08)),
        box((0.13, 0.16, drum_length + 0.35), (0.0, 0.09, front + drum_length / 2)),
        box((0.14, 0.14, drum_length + 0.4), (0.0, -0.1 - 0.9 * drum, front + drum_length / 2)),
        rounded_box((0.15, 0.45, 0.3), (0.0, -0.08, -0.08), 0.04),
        box((0.13, 0.42, 0.1), (0.0, -0.1, front - 0.05)),
        cylinder,
    ]
    hammer = prism([(0.02, 0.0), (0.12, 0.0), (0.2, 0.2), (0.12, 0.22)], 0.06, "x")
    return [
        Part("barrel", union(*solids, hammer)),
        Part("grip", _curved_grip(generator, -0.12, 0.1)),
        *_trigger(generator, -0.1 - 0.9 * drum - 0.02, -0.22),
    ]


def _duelling(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    length, bore = draw(1.2, 1.9), draw(0.06, 0.085)
    barrel = lathe(
        [
            (0.0, 0.1),
            (1.25 * bore, 0.1),
            (bore, -length + 0.1),
            (1.2 * bore, -length),
            (0.6 * bore, -length),
            (0.6 * bore, 0.1 - length),
            (0.0, 0.1 - length),
        ],
        "z",
    )
    stock = rounded_box((0.17, 0.15, 0.75 * length), (0.0, -0.08, -0.3 * length), 0.03)
    lock = union(
        rounded_box((0.09, 0.15, 0.42), (0.09, -0.02, -0.02), 0.02),
        prism([(-0.05, 0.0), (0.1, 0.0), (0.18, 0.26), (0.02, 0.2)], 0.06, "x", 0.09),
    )
    return [
        Part("barrel", union(barrel, stock, lock)),
        Part("grip", _curved_grip(generator, -0.06, 0.0)),
        *_trigger(generator, -0.12, -0.18),
    ]


def _curved_grip(generator: np.random.Generator, top: float, start: float) -> Manifold:
    """Return a grip that sweeps back and down and swells at its end."""
    draw = generator.uniform
    drop, back = draw(0.55, 0.75), draw(0.25, 0.45)
    path = smooth_path(
        [
            (0.0, top, start - 0.2),
            (0.0, top - 0.08, start + 0.12),
            (0.0, top - 0.55 * drop, start + 0.75 * back),
            (0.0, top - drop, start + back + 0.02),
        ],
        16,
    )
    sizes = np.interp(np.linspace(0, 1, 16), [0.0, 0.3, 0.6, 0.92, 1.0], [0.12, 0.13, 0.13, 0.19, 0.15])
    return tube(path, sizes, 14, flatten=0.65)


def _trigger(generator: np.random.Generator, top: float, at: float) -> list[Part]:
    """Return the curved trigger and the guard around it, which hang below height `top` near z = `at`."""
    draw = generator.uniform
    deep, half, radius = draw(0.2, 0.26), draw(0.16, 0.2), 0.03
    centre = at - half - 0.02
    shape = str(generator.choice(["round", "square"]))
    if shape == "round":
        guard = tube(embed(arc((centre, top + 0.03), (half + 0.03, deep + 0.03), (180.0, 360.0), 20), "x"), radius, 8)
    else:
        corners = [
            (centre - half, top + 0.05),
            (centre - half, top - deep),
            (centre + half, top - deep),
            (centre + half, top + 0.05),
        ]
        guard = union(
            *[
                box(
                    (0.07, abs(b[1] - a[1]) + 0.05, abs(b[0] - a[0]) + 0.05),
                    (0.0, (a[1] + b[1]) / 2, (a[0] + b[0]) / 2),
                )
                for a, b in pairwise(corners)
            ]
        )
    blade = tube(
        smooth_path(
            [
                (0.0, top + 0.04, centre + 0.06),
                (0.0, top - 0.4 * deep, centre + 0.03),
                (0.0, top - 0.75 * deep, centre - 0.03),
            ],
            8,
        ),
        0.028,
        8,
    )
    return [Part("trigger", guard), Part("trigger", blade)]
