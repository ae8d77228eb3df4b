"""Hunting rifles, assault rifles, sniper rifles and shotguns; muzzle towards negative z."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc, embed, smooth_path
from morphoskel.datasets.synthetic.primitives import box, lathe, prism, rod, rounded_box, tube, union


def build_rifle(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random rifle; the bore lies at height 0 and the receiver around z = 0."""
    draw = generator.uniform
    kind = str(generator.choice(["hunting", "assault", "sniper", "shotgun"]))
    length = {
        "hunting": draw(1.2, 1.6),
        "assault": draw(0.7, 1.1),
        "sniper": draw(1.2, 1.6),
        "shotgun": draw(1.0, 1.5),
    }[kind]
    parts = [Part("barrel", _barrel(generator, kind, length))]
    parts.append(Part("receiver", _receiver(generator, kind)))
    parts.append(Part("stock", _stock(generator, kind)))
    return parts


def _barrel(generator: np.random.Generator, kind: str, length: float) -> Manifold:
    draw = generator.uniform
    thick, front = draw(0.028, 0.042), -0.3 - length
    solids = [rod((0.0, 0.0, -0.2), (0.0, 0.0, front), 1.25 * thick, thick)]
    guard = draw(0.45, 0.7) * length if kind != "shotgun" else draw(0.3, 0.4) * length
    if kind == "assault":
        solids.append(rounded_box((0.13, 0.16, guard), (0.0, -0.01, -0.3 - guard / 2), 0.02))
        solids.append(box((0.03, 0.13, 0.05), (0.0, 0.07, front + 0.12)))
        solids.append(rod((0.0, 0.0, front + 0.02), (0.0, 0.0, front - 0.12), 1.5 * thick))
    elif kind == "shotgun":
        solids.append(rod((0.0, -0.09, -0.2), (0.0, -0.09, front + 0.15), 1.1 * thick))
        solids.append(rounded_box((0.12, 0.14, guard), (0.0, -0.09, -0.35 - guard / 2), 0.04))
        solids.append(rod((0.0, 0.02, front + 0.2), (0.0, -0.1, front + 0.2), 0.035))
    else:
        solids.append(
            prism(
                [(-0.25, 0.0), (-0.25, -0.15), (-0.32 - guard, -0.08), (-0.36 - guard, -0.03), (-0.32 - guard, 0.0)],
                0.12,
                "x",
            )
        )
        solids.append(box((0.025, 0.08, 0.04), (0.0, 0.04, front + 0.06)))
    if kind == "sniper":
        solids.append(rod((0.0, 0.0, front + 0.02), (0.0, 0.0, front - 0.15), 1.7 * thick))
        if draw() < 0.7:
            at, spread = -0.3 - 0.8 * guard, draw(0.12, 0.25)
            solids += [rod((0.0, -0.04, at), (s * spread, -0.45, at - 0.06), 0.022) for s in (-1, 1)]
    return union(*solids)


def _receiver(generator: np.random.Generator, kind: str) -> Manifold:
    draw = generator.uniform
    high = draw(0.17, 0.22)
    body = rounded_box((0.14, high, 0.62), (0.0, -0.03, -0.02), 0.03)
    solids = [body, *_trigger_guard(-0.03 - high / 2, 0.12)]
    if kind == "assault":
        grip = prism([(0.2, -0.08), (0.33, -0.08), (0.42, -0.42), (0.28, -0.42)], 0.1, "x")
        solids += [grip, _magazine(generator), box((0.05, 0.06, 0.5), (0.0, high / 2 - 0.02, 0.0))]
        if draw() < 0.5:
            handle = [
                (-0.1, 0.05),
                (-0.02, 0.2),
                (0.2, 0.2),
                (0.24, 0.05),
                (0.2, 0.05),
                (0.17, 0.15),
                (0.0, 0.15),
                (-0.05, 0.05),
            ]
            solids.append(prism(handle, 0.05, "x"))
    elif kind != "shotgun":
        solids.append(rod((0.05, 0.0, 0.18), (0.16, -0.06, 0.2), 0.02))
        if kind == "sniper" or draw() < 0.4:
            solids += _scope(generator, high / 2 - 0.03)
        if draw() < 0.6:
            solids.append(box((0.08, 0.16, 0.22), (0.0, -0.18, -0.12)))
    return union(*solids)


def _trigger_guard(top: float, at: float) -> list[Manifold]:
    guard = tube(embed(arc((at, top + 0.02), (0.11, 0.12), (180.0, 360.0), 16), "x"), 0.018, 8)
    return [guard, rod((0.0, top + 0.03, at + 0.02), (0.0, top - 0.06, at - 0.01), 0.018, segments=8)]


def _magazine(generator: np.random.Generator) -> Manifold:
    draw = generator.uniform
    if draw() < 0.25:
        return rod((-0.06, -0.25, -0.12), (0.06, -0.25, -0.12), 0.17, segments=24) + box(
            (0.08, 0.2, 0.14), (0.0, -0.1, -0.12)
        )
    length, forward = draw(0.25, 0.42), draw(0.0, 0.2)
    outline = [
        (-0.2, -0.08),
        (-0.06, -0.08),
        (-0.08, -0.08 - 0.5 * length),
        (-0.08 - forward, -0.08 - length),
        (-0.22 - forward, -0.04 - length),
        (-0.21, -0.06 - 0.5 * length),
    ]
    return prism(outline, 0.08, "x")


def _scope(generator: np.random.Generator, top: float) -> list[Manifold]:
    draw = generator.uniform
    half, wide, up = draw(0.26, 0.36), draw(0.055, 0.075), top + 0.14
    profile = [
        (0.0, -half),
        (wide, -half),
        (wide, -0.55 * half),
        (0.035, -0.35 * half),
        (0.035, 0.6 * half),
        (0.8 * wide, 0.75 * half),
        (0.8 * wide, half),
        (0.0, half),
    ]
    mounts = [box((0.04, 0.16, 0.05), (0.0, top + 0.05, z)) for z in (-0.1, 0.1)]
    return [lathe(profile, "z", (0.0, up, 0.0), 20), *mounts]


def _stock(generator: np.random.Generator, kind: str) -> Manifold:
    draw = generator.uniform
    length, deep, drop = draw(0.65, 0.9), draw(0.26, 0.36), draw(0.02, 0.12)
    start, end = 0.24, 0.3 + length
    if kind == "assault" and draw() < 0.5:
        bars = [
            rod((0.0, 0.0, start), (0.0, -0.02, end), 0.035),
            rod((0.0, -0.06, start), (0.0, -deep, end - 0.02), 0.03),
        ]
        return union(*bars, rounded_box((0.09, deep + 0.08, 0.07), (0.0, -deep / 2 - 0.01, end), 0.03))
    if kind == "assault":
        outline = [(start, 0.05), (end, 0.03), (end, -deep), (end - 0.12, -deep), (start + 0.25, -0.12), (start, -0.1)]
        return prism(outline, 0.1, "x")
    if draw() < 0.35:
        outline = [
            (start, 0.03),
            (end, -drop + 0.06),
            (end, -drop - deep),
            (end - 0.3, -drop - deep + 0.04),
            (0.62, -0.2),
            (0.56, -0.38),
            (0.42, -0.38),
            (0.42, -0.14),
            (start, -0.12),
        ]
        stock = prism(outline, 0.11, "x")
        return (
            stock
            - prism([(0.68, -0.08), (end - 0.14, -0.1 - drop), (end - 0.14, -0.18 - drop), (0.7, -0.16)], 0.4, "x")
            if draw() < 0.6
            else stock
        )
    path = smooth_path(
        [(0.0, -0.05, start), (0.0, -0.1, start + 0.18), (0.0, -0.12 - drop, 0.6 * end), (0.0, -0.13 - drop, end)], 14
    )
    sizes = np.interp(np.linspace(0, 1, 14), [0.0, 0.3, 0.6, 1.0], [0.09, 0.075, 0.12, deep / 2])
    return tube(path, sizes, 14, flatten=0.5)
