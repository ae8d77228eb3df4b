"""A data set of the size and layout of ModelNet40, of small clouds."""

import numpy as np

from morphoskel.atomic import atomic_folder
from morphoskel.datasets.modelnet40 import CATEGORIES, SPLIT_LISTS
from morphoskel.seeds import derive_generator

COUNTS = {"train": 9843, "test": 2468}
"""Shapes of each split of ModelNet40."""

POINTS = 256
SEED = 20250325


def split_counts(shapes):
    """Return how many of so many shapes each split has, in ModelNet40's proportion."""
    test = max(1, round(shapes * COUNTS["test"] / sum(COUNTS.values())))
    return {"train": shapes - test, "test": test}


def superellipsoid(generator):
    """Return (POINTS, 6): points of a superellipsoid between a box and an ellipsoid, and outward normals."""
    directions = generator.normal(size=(POINTS, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    axes, exponent = generator.uniform(0.4, 1.0, 3), generator.uniform(0.4, 1.0)
    points = axes * np.sign(directions) * np.abs(directions) ** exponent
    normals = np.sign(directions) * np.abs(directions) ** (2 - exponent) / axes
    return np.hstack([points, normals / np.linalg.norm(normals, axis=1, keepdims=True)])


def write_clouds(root, shapes):
    """Write so many shapes in ModelNet40's layout, whole or not at all."""
    with atomic_folder(root) as folder:
        for category in CATEGORIES:
            (folder / category).mkdir()
        number = 0
        for split, count in split_counts(shapes).items():
            names = []
            for _ in range(count):
                category = CATEGORIES[number % len(CATEGORIES)]
                number += 1
                names.append(f"{category}_{number:05d}")
                rows = superellipsoid(derive_generator(SEED, names[-1], "load"))
                np.savetxt(folder / category / f"{names[-1]}.txt", rows, fmt="%.6f", delimiter=",")
            (folder / SPLIT_LISTS[split]).write_text("\n".join(names) + "\n", encoding="utf-8")
