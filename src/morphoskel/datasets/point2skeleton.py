"""The benchmark of Point2Skeleton: ShapeNet clouds of 2000 oriented points in eight categories.

Source: Lin et al., *Point2Skeleton: Learning Skeletal Representations from Point Clouds*, CVPR 2021.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.datasets.dataset import check_root, choose_categories, read_lines
from morphoskel.datasets.manifest import Entry
from morphoskel.errors import DatasetError

if TYPE_CHECKING:
    from morphoskel.shapes import PointCloud

CATEGORIES = {
    "02691156": "Airplane",
    "03001627": "Chair",
    "04379243": "Table",
    "03636649": "Lamp",
    "03467517": "Guitar",
    "03261776": "Earphone",
    "03797390": "Mug",
    "04090263": "Rifle",
}
"""WordNet offset (the folder's name) and name of each category, in the order of the paper's tables."""

SPLIT_LISTS = {"train": "data-split/all-train.txt", "test": "data-split/all-test.txt"}
"""List file of each split."""


class Point2SkeletonDataset:
    """The Point2Skeleton benchmark in its original layout.

    ``root`` holds ``pointclouds/<offset>/<id>.ply`` and ``data-split/all-{train,test}.txt`` with a line
    ``<offset>/<id>`` for each shape. An entry's id is ``<offset>-<id>``, since ShapeNet may file one model under two
    categories.

    Parameters
    ----------
    root
        Folder of the data set.
    categories
        Names to keep, for example ``["Chair", "Lamp"]``; ``None`` keeps all eight.

    Raises
    ------
    DatasetError
        If a category is unknown.
    """

    def __init__(self, root: Path | str, categories: Sequence[str] | None = None) -> None:
        self.root = Path(root)
        self.categories = choose_categories(categories, CATEGORIES.values())

    @property
    def how_to_get(self) -> str:
        """What to fetch, from where, and where to put it."""
        return (
            "Point2Skeleton has no direct download: follow the link to the data on the project's page "
            "(https://github.com/clinplayer/Point2Skeleton), accept its terms, fetch the archive by hand and unpack it "
            f"so that {self.root / 'pointclouds'} and {self.root / 'data-split'} exist; or set dataset.root to where "
            "it is."
        )

    def list_shapes(self) -> list[Entry]:
        """Return all shapes of all splits; reads the split lists only."""
        return [
            Entry(f"{offset}-{name}", CATEGORIES[offset], split, self.root / "pointclouds" / offset / f"{name}.ply")
            for split in SPLIT_LISTS
            for offset, name in self._listed(split)
        ]

    def counts(self) -> dict[str, int]:
        """Return the number of shapes of each split, counted in the split lists."""
        return {split: len(self._listed(split)) for split in SPLIT_LISTS}

    def load(self, path: Path) -> PointCloud:
        """Read one cloud with its normals."""
        from morphoskel.formats import read_point_cloud

        return read_point_cloud(path)

    def _listed(self, split: str) -> list[tuple[str, str]]:
        """Return (offset, id) of the split's shapes in the chosen categories."""
        check_root(self.root, self.how_to_get, "pointclouds", SPLIT_LISTS[split])
        path = self.root / SPLIT_LISTS[split]
        listed: list[tuple[str, str]] = []
        for line in read_lines(path):
            offset, slash, name = line.partition("/")
            if offset not in CATEGORIES or not slash or not name:
                raise DatasetError(
                    f"{path}: expected lines <offset>/<id> with an offset among {', '.join(CATEGORIES)}, got {line!r}"
                )
            if CATEGORIES[offset] in self.categories:
                listed.append((offset, name.removesuffix(".ply")))
        return listed
