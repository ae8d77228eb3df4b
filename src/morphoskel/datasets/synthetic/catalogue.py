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

_MODULES: dict[str, str] = {
    "Airplane": "morphoskel.datasets.synthetic.categories.airplane",
    "Bag": "morphoskel.datasets.synthetic.categories.bag",
    "Cap": "morphoskel.datasets.synthetic.categories.cap",
    "Car": "morphoskel.datasets.synthetic.categories.car",
    "Chair": "morphoskel.datasets.synthetic.categories.chair",
    "Earphone": "morphoskel.datasets.synthetic.categories.earphone",
    "Guitar": "morphoskel.datasets.synthetic.categories.guitar",
    "Knife": "morphoskel.datasets.synthetic.categories.knife",
    "Lamp": "morphoskel.datasets.synthetic.categories.lamp",
    "Laptop": "morphoskel.datasets.synthetic.categories.laptop",
    "Motorbike": "morphoskel.datasets.synthetic.categories.motorbike",
    "Mug": "morphoskel.datasets.synthetic.categories.mug",
    "Pistol": "morphoskel.datasets.synthetic.categories.pistol",
    "Rocket": "morphoskel.datasets.synthetic.categories.rocket",
    "Skateboard": "morphoskel.datasets.synthetic.categories.skateboard",
    "Table": "morphoskel.datasets.synthetic.categories.table",
    "Rifle": "morphoskel.datasets.synthetic.categories.rifle",
}
"""Module of each category's builder; in full, so that a change of a builder is seen as a change of the data."""


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
    module = importlib.import_module(_MODULES[category])
    builder: Callable[[np.random.Generator], list[Part]] = getattr(module, f"build_{category.lower()}")
    return builder
