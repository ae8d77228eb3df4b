"""ModelNet40 as clouds of 10 000 oriented points (``modelnet40_normal_resampled``).

Source: Wu et al., *3D ShapeNets*, CVPR 2015; resampled for Qi et al., *PointNet++*, NeurIPS 2017.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.datasets.dataset import check_root, choose_categories, read_lines
from morphoskel.datasets.manifest import Entry
from morphoskel.errors import ConfigError, DatasetError, InputError

if TYPE_CHECKING:
    from morphoskel.shapes import PointCloud

URL = "https://shapenet.cs.stanford.edu/media/modelnet40_normal_resampled.zip"
"""Public archive of the data set; it unpacks to one folder of the same name."""

CATEGORIES = (
    *("airplane", "bathtub", "bed", "bench", "bookshelf", "bottle", "bowl", "car", "chair", "cone"),
    *("cup", "curtain", "desk", "door", "dresser", "flower_pot", "glass_box", "guitar", "keyboard", "lamp"),
    *("laptop", "mantel", "monitor", "night_stand", "person", "piano", "plant", "radio", "range_hood", "sink"),
    *("sofa", "stairs", "stool", "table", "tent", "toilet", "tv_stand", "vase", "wardrobe", "xbox"),
)
"""The 40 classes in the order of ``modelnet40_shape_names.txt``, which is the order of their class numbers."""

SPLIT_LISTS = {"train": "modelnet40_train.txt", "test": "modelnet40_test.txt"}
"""List file of each split."""


class ModelNet40Dataset:
    """ModelNet40, normal resampled, in its original layout.

    ``root`` holds ``<class>/<class>_<number>.txt`` with lines ``x,y,z,nx,ny,nz`` and
    ``modelnet40_{train,test}.txt`` with a line ``<class>_<number>`` for each shape.

    Parameters
    ----------
    root
        Folder of the data set.
    categories
        Classes to keep; ``None`` keeps all 40.
    points
        Read only this many points, the first ones of the file, as the published classifiers do; ``None`` reads all.

    Raises
    ------
    DatasetError
        If a category is unknown.
    ConfigError
        If `points` is less than 4.
    """

    def __init__(self, root: Path | str, categories: Sequence[str] | None = None, points: int | None = None) -> None:
        if points is not None and points < 4:
            raise ConfigError(f"dataset.points: expected at least 4 points, or null for all, got {points}")
        self.root = Path(root)
        self.categories = choose_categories(categories, CATEGORIES)
        self.points = points

    @property
    def how_to_get(self) -> str:
        """What to fetch, from where, and where to put it."""
        return (
            f"Fetch {URL} and unpack it so that {self.root / SPLIT_LISTS['train']} exists; or set "
            "dataset.root to where it is."
        )

    def list_shapes(self) -> list[Entry]:
        """Return all shapes of all splits; reads the split lists only."""
        return [
            Entry(name, category, split, self.root / category / f"{name}.txt")
            for split in SPLIT_LISTS
            for category, name in self._listed(split)
        ]

    def counts(self) -> dict[str, int]:
        """Return the number of shapes of each split, counted in the split lists."""
        return {split: len(self._listed(split)) for split in SPLIT_LISTS}

    def load(self, path: Path) -> PointCloud:
        """Read one cloud with its normals, or only its first `points` points."""
        from morphoskel.formats import read_point_cloud
        from morphoskel.shapes import PointCloud

        cloud = read_point_cloud(path)
        if self.points is None:
            return cloud
        if len(cloud) < self.points:
            raise InputError(f"{path}: dataset.points asks for {self.points} points, but the file has {len(cloud)}")
        normals = None if cloud.normals is None else cloud.normals[: self.points]
        return PointCloud(cloud.points[: self.points], normals)

    def _listed(self, split: str) -> list[tuple[str, str]]:
        """Return (class, id) of the split's shapes in the chosen classes."""
        check_root(self.root, self.how_to_get, SPLIT_LISTS[split])
        path = self.root / SPLIT_LISTS[split]
        listed: list[tuple[str, str]] = []
        for name in read_lines(path):
            category, _, number = name.rpartition("_")
            if category not in CATEGORIES or not number.isdecimal():
                raise DatasetError(f"{path}: expected lines <class>_<number> with a class of ModelNet40, got {name!r}")
            if category in self.categories:
                listed.append((category, name))
        return listed
