"""Any tree ``<class>/{train,val,test}/<file>``: ModelNet10 or ModelNet40 meshes, or clouds made from them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.datasets.dataset import check_root, choose_categories
from morphoskel.datasets.manifest import Entry
from morphoskel.errors import DatasetError

if TYPE_CHECKING:
    from morphoskel.shapes import PointCloud

SPLITS = ("train", "val", "test")
"""Names of the folders below a class that are splits."""


class ClassTreeDataset:
    """A tree of classes and splits in any of the supported file formats.

    An entry's id is the file's name without suffix if that starts with ``<class>_``, as in ModelNet, else
    ``<class>-<split>-<name>``.

    Parameters
    ----------
    root
        Folder that holds the classes. Hidden files, and files of other formats, are passed over.
    categories
        Classes to keep; ``None`` keeps all folders that hold a split.
    points
        Number of points drawn from each mesh; clouds are read whole.
    seed
        Global seed of the sampling; each shape has its own stream.
    """

    def __init__(
        self, root: Path | str, categories: Sequence[str] | None = None, points: int = 10_000, seed: int = 0
    ) -> None:
        self.root = Path(root)
        self.categories = categories
        self.points = points
        self.seed = seed

    @property
    def how_to_get(self) -> str:
        """What to fetch, from where, and where to put it."""
        return (
            f"Put the shapes below {self.root} as <class>/train/<file> and <class>/test/<file>, in any supported "
            "format (ModelNet10 and ModelNet40 come so from https://modelnet.cs.princeton.edu); or set dataset.root to "
            "where they are."
        )

    def list_shapes(self) -> list[Entry]:
        """Return all shapes of all splits; reads folders only."""
        return [
            Entry(_identify(path), category, path.parent.name, path)
            for category in self._chosen()
            for path in self._files(category)
        ]

    def counts(self) -> dict[str, int]:
        """Return the number of shapes of each split that occurs."""
        counts = dict.fromkeys(SPLITS, 0)
        for category in self._chosen():
            for path in self._files(category):
                counts[path.parent.name] += 1
        return {split: count for split, count in counts.items() if count}

    def load(self, path: Path) -> PointCloud:
        """Read a cloud, or sample a mesh uniformly by area with a stream of its own."""
        from morphoskel.formats import read_cloud
        from morphoskel.seeds import derive_generator

        return read_cloud(path, samples=self.points, generator=derive_generator(self.seed, _identify(path), "sample"))

    def _chosen(self) -> tuple[str, ...]:
        """Return the classes to use."""
        check_root(self.root, self.how_to_get)
        found = sorted(
            folder.name
            for folder in self.root.iterdir()
            if not folder.name.startswith(".") and any((folder / split).is_dir() for split in SPLITS)
        )
        if not found:
            raise DatasetError(f"{self.root}: holds no folder <class>/{{{','.join(SPLITS)}}}. {self.how_to_get}")
        return choose_categories(self.categories, found)

    def _files(self, category: str) -> Iterator[Path]:
        """Yield the shapes of one class."""
        from morphoskel.formats import SUPPORTED_SUFFIXES

        for split in SPLITS:
            folder = self.root / category / split
            for path in sorted(folder.iterdir()) if folder.is_dir() else ():
                if path.suffix.lower() in SUPPORTED_SUFFIXES and not path.name.startswith("."):
                    yield path


def _identify(path: Path) -> str:
    """Return the id of the shape in ``<class>/<split>/<file>``."""
    category = path.parent.parent.name
    return path.stem if path.stem.startswith(f"{category}_") else f"{category}-{path.parent.name}-{path.stem}"
