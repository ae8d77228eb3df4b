"""Generate one synthetic shape from its id."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from morphoskel.datasets.dataset import choose_categories
from morphoskel.datasets.synthetic.catalogue import CATEGORIES, PART_NAMES, find_builder, part_labels
from morphoskel.errors import DatasetError, ShapeError
from morphoskel.seeds import derive_generator
from morphoskel.shapes import MINIMUM_DISTINCT_POINTS, IntArray, Mesh, PointCloud

STAGE = "synthetic"
"""Name under which a shape's seed is derived."""


@dataclass(frozen=True, eq=False)
class SyntheticShape:
    """One shape with its ground truth.

    Parameters
    ----------
    cloud
        Points with outward unit normals and global part labels.
    mesh
        The watertight surface they lie on.
    triangle_labels
        ``(T,)`` int64, global part label of each triangle.
    """

    cloud: PointCloud
    mesh: Mesh
    triangle_labels: IntArray


def generate_shape(category: str, shape_id: str, *, seed: int, points: int = 2000) -> SyntheticShape:
    """Build and sample one shape.

    Parameters
    ----------
    category
        One of :data:`CATEGORIES`.
    shape_id
        Decides, together with `seed`, everything about the shape; nothing else does.
    seed
        The global seed.
    points
        Number of points drawn uniformly by area, at least four.

    Returns
    -------
    SyntheticShape
        Centred at the middle of its bounding box, farthest vertex at distance 1; y is up, the front faces negative z.
        All coordinates are representable in float32, so that the files hold exactly these numbers.

    Raises
    ------
    DatasetError
        If the category is unknown or `points` is too small.
    ShapeError
        If the parts do not form one connected surface, which would be a defect of the builder.
    """
    from morphoskel.datasets.synthetic.assembly import sample_surface, unite

    choose_categories([category], CATEGORIES)
    check_point_count(points)
    generator = derive_generator(seed, shape_id, STAGE)
    parts = find_builder(category)(generator)
    try:
        mesh, part_of_triangle = unite(parts)
    except ShapeError as error:
        raise ShapeError(f"synthetic shape {shape_id!r} (seed {seed}): {error}") from error
    names, labels = PART_NAMES[category], part_labels(category)
    label_of_part = np.array([labels[names.index(part.name)] for part in parts], dtype=np.int64)
    triangle_labels = label_of_part[part_of_triangle]
    return SyntheticShape(sample_surface(mesh, triangle_labels, points, generator), mesh, triangle_labels)


def check_point_count(points: int) -> None:
    """Raise :class:`DatasetError` if so few points cannot be a point cloud."""
    if points < MINIMUM_DISTINCT_POINTS:
        raise DatasetError(f"points: a cloud needs at least {MINIMUM_DISTINCT_POINTS} points, got {points}")
