"""The categories, their part names and the global part labels, in ShapeNetPart's order.

Rifle is no category of ShapeNetPart, but one of Point2Skeleton; its labels follow at the end.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from morphoskel.datasets.synthetic.assembly import Part

PART_NAMES: dict[str, tuple[str, ...]] = {
    "Airplane": ("body", "wing", "tail", "engine"),
    "Bag": ("handle", "body"),
    "Cap": ("crown", "peak"),
    "Car": ("roof", "hood", "wheel", "body"),
    "Chair": ("back", "seat", "leg", "arm"),
    "Earphone": ("earcup", "headband", "wire"),
    "Guitar": ("head", "neck", "body"),
    "Knife": ("blade", "handle"),
    "Lamp": ("base", "shade", "canopy", "pole"),
    "Laptop": ("keyboard", "screen"),
    "Motorbike": ("tank", "seat", "wheel", "handle", "light", "body"),
    "Mug": ("handle", "body"),
    "Pistol": ("barrel", "grip", "trigger"),
    "Rocket": ("body", "fin", "nose"),
    "Skateboard": ("wheel", "deck", "truck"),
    "Table": ("top", "leg", "support"),
    "Rifle": ("barrel", "stock", "receiver"),
}
"""Names of the parts of each category.

The number of parts of each category, and with it every label, is ShapeNetPart's. Where its owners give no name, the
name is ours: a lamp's canopy is the plate that holds it to the ceiling; a table's support is what lies between top
and legs (drawers, stretchers, shelves); a rifle's receiver includes grip, magazine, trigger and sight.
"""

CATEGORIES = tuple(PART_NAMES)
"""Names of the categories, in the order of their labels."""


def part_labels(category: str) -> range:
    """Return the global labels of a category's parts, for example ``range(12, 16)`` for ``Chair``."""
    first = 0
    for name, parts in PART_NAMES.items():
        if name == category:
            return range(first, first + len(parts))
        first += len(parts)
    raise KeyError(category)


def find_builder(category: str) -> Callable[[np.random.Generator], list[Part]]:
    """Return the function that builds the parts of a random shape of `category`."""
    module = importlib.import_module(f"morphoskel.datasets.synthetic.categories.{category.lower()}")
    builder: Callable[[np.random.Generator], list[Part]] = getattr(module, f"build_{category.lower()}")
    return builder
