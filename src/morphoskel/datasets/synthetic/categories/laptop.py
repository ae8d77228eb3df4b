"""Open laptops; the user sits on the side of negative z."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from morphoskel.datasets.synthetic.assembly import Part
from morphoskel.datasets.synthetic.primitives import box, rod, slab, union


def build_laptop(generator: np.random.Generator) -> list[Part]:
    """Return the parts of a random laptop about two units wide."""
    draw = generator.uniform
    width, depth = draw(1.7, 2.1), draw(1.15, 1.55)
    base, lid = draw(0.07, 0.15), draw(0.05, 0.08)
    corner = draw(0.02, 0.14)
    hinge = 0.6 * max(base, lid)
    keyboard = _base(generator, width, depth, base, corner)
    style = str(generator.choice(["bar", "two knuckles"]))
    spans = (
        [(-0.4 * width, 0.4 * width)]
        if style == "bar"
        else [(-0.36 * width, -0.2 * width), (0.2 * width, 0.36 * width)]
    )
    axis = (base / 2, depth / 2)
    barrels = [rod((a, *axis), (b, *axis), hinge) for a, b in spans]
    opening = draw(75.0, 150.0)
    screen = _lid(generator, width * draw(0.97, 1.0), depth * draw(0.9, 1.02), lid, corner)
    turned = screen.rotate((opening - 90.0, 0.0, 0.0)).translate((0.0, *axis))
    return [Part("keyboard", union(keyboard, *barrels)), Part("screen", turned)]


def _base(generator: np.random.Generator, width: float, depth: float, thickness: float, corner: float) -> Manifold:
    """Return the lower half with rows of keys above a sunken touch pad."""
    body = slab(width, thickness, depth, (0.0, 0.0, 0.0), corner)
    rows, top = int(generator.integers(4, 7)), thickness / 2
    field = (0.84 * width, 0.46 * depth)
    pitch = field[1] / rows
    keys = [box((field[0], 0.04, 0.72 * pitch), (0.0, top, 0.4 * depth - (row + 0.5) * pitch)) for row in range(rows)]
    pad = box((generator.uniform(0.24, 0.36) * width, 0.04, 0.26 * depth), (0.0, top, -0.3 * depth))
    return union(body, *keys) - pad


def _lid(generator: np.random.Generator, width: float, height: float, thickness: float, corner: float) -> Manifold:
    """Return an upright lid that stands on the hinge axis, with the screen sunken on the user's side."""
    panel = slab(width, thickness, height, (0.0, 0.0, 0.0), corner).rotate((90.0, 0.0, 0.0))
    frame = generator.uniform(0.05, 0.12)
    sunken = box((width - 2 * frame, height - 2.4 * frame, 0.03), (0.0, 0.2 * frame, -thickness / 2))
    return (panel - sunken).translate((0.0, height / 2 - 0.02, 0.0))
