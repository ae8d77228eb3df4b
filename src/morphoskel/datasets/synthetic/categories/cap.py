"""Baseball caps, brimmed hats and flat caps; the peak points to negative z."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.curves import arc
from morphoskel.datasets.synthetic.primitives import ball, lathe, lathe_shell, prism


def build_cap(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random cap; the head has radius about 1."""
    kind = str(generator.choice(["baseball", "baseball", "hat", "service"]))
    if kind == "hat":
        return _hat(generator)
    parts = _dome(generator) if kind == "baseball" else _service_crown(generator)
    return [*parts, Part("peak", _peak(generator, long=kind == "baseball"))]


def _dome(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    height, oval = draw(0.75, 1.25), draw(1.0, 1.2)
    dome = np.column_stack([np.ones(3), [-0.12, -0.06, 0.0]]) if draw() < 0.6 else np.array([[1.0, -0.06]])
    rise = arc((0.0, 0.0), (1.0, height), (6.0, 82.0), 11)
    crown = lathe_shell(np.vstack([dome, rise, [(0.0, height)]]), draw(0.05, 0.08)).scale((1.0, 1.0, oval))
    parts = [Part("crown", crown)]
    if draw() < 0.75:
        parts.append(Part("crown", ball((0.1, 0.06, 0.1), (0.0, height, 0.0), 12)))
    return parts


def _service_crown(generator: np.random.Generator) -> list[Part]:
    """Return a stiff band that widens to a flat, slightly tilted top."""
    draw = generator.uniform
    band, flare, rise = draw(0.2, 0.4), draw(1.05, 1.4), draw(0.2, 0.5)
    outer = [
        (1.0, -0.1),
        (1.0, band),
        (flare, band + rise),
        (0.9 * flare, band + rise + 0.08),
        (0.0, band + rise + 0.16),
    ]
    crown = lathe_shell(outer, draw(0.05, 0.08))
    return [Part("crown", crown.scale((1.0, 1.0, draw(1.0, 1.15))))]


def _peak(generator: np.random.Generator, *, long: bool) -> Manifold:
    """Return a curved visor whose inner edge follows the band."""
    draw = generator.uniform
    reach, half_width = draw(0.75, 1.1) if long else draw(0.4, 0.6), draw(0.8, 0.92)
    inner = arc((0.0, 0.0), (0.97, 1.0), (-160.0, -20.0), 24)
    start = -np.sqrt(1.0 - half_width**2)
    outer = arc((0.0, start), (half_width + 0.05, reach + 1.0 + start), (-5.0, -175.0), 24)
    visor = prism(np.vstack([inner, outer]), draw(0.06, 0.09), "y").refine_to_length(0.15)
    bend, droop = draw(0.1, 0.45), draw(0.0, 0.3)

    def curve(points: np.ndarray) -> np.ndarray:
        bent = points.copy()
        bent[:, 1] -= bend * points[:, 0] ** 2 + droop * np.maximum(-0.9 - points[:, 2], 0.0)
        return bent

    return visor.warp_batch(curve).translate((0.0, 0.02, 0.0))


def _hat(generator: np.random.Generator) -> list[Part]:
    draw = generator.uniform
    height, top, brim = draw(0.8, 1.7), draw(0.65, 1.0), draw(0.4, 1.0)
    oval, wall = draw(1.0, 1.2), draw(0.06, 0.09)
    outer = [
        (1.0, -0.02),
        (0.5 + 0.5 * top, 0.5 * height),
        (top, 0.85 * height),
        (0.85 * top, height),
        (0.0, height - draw(0.0, 0.25)),
    ]
    crown = lathe_shell(outer, wall).scale((1.0, 1.0, oval))
    tilt = draw(-0.15, 0.25)
    ring = lathe([(0.93, -0.05), (0.93, 0.04), (1.0 + brim, 0.04 + tilt), (1.0 + brim, -0.05 + tilt)]).scale(
        (1.0, 1.0, oval)
    )
    ring = ring.refine_to_length(0.3)
    curl = draw(0.0, 0.25)

    def curve(points: np.ndarray) -> np.ndarray:
        bent = points.copy()
        bent[:, 1] += curl * np.maximum(np.abs(points[:, 0]) - 0.95, 0.0) ** 1.5
        return bent

    return [Part("crown", crown), Part("peak", ring.warp_batch(curve))]
