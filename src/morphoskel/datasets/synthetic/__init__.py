"""The embedded data set: parametric shapes in 17 categories with exact surfaces, normals and part labels.

Each shape is an assembly of named solids, united to one watertight mesh. Nothing has to be fetched, and a shape
depends on nothing but the seed and its id.
"""

from morphoskel.datasets.synthetic.catalogue import CATEGORIES, PART_NAMES, part_labels
from morphoskel.datasets.synthetic.dataset import SyntheticDataset, write_shapes
from morphoskel.datasets.synthetic.generate import SyntheticShape, generate_shape

__all__ = [
    "CATEGORIES",
    "PART_NAMES",
    "SyntheticDataset",
    "SyntheticShape",
    "generate_shape",
    "part_labels",
    "write_shapes",
]
