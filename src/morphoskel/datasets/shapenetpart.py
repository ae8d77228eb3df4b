"""ShapeNetPart: clouds of 16 categories whose points carry one of 50 part labels.

Source: Yi et al., *A Scalable Active Framework for Region Annotation in 3D Shape Collections*, SIGGRAPH Asia 2016.
"""

from __future__ import annotations

import json
import logging
from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.datasets.axes import axes_matrix
from morphoskel.datasets.dataset import check_root, choose_categories
from morphoskel.datasets.manifest import Entry
from morphoskel.errors import DatasetError, InputError

if TYPE_CHECKING:
    from morphoskel.shapes import IntArray, PointCloud

URL = "https://shapenet.cs.stanford.edu/media/shapenetcore_partanno_segmentation_benchmark_v0_normal.zip"
"""Public archive of the layout with normals."""

CATEGORIES = {
    "02691156": "Airplane",
    "02773838": "Bag",
    "02954340": "Cap",
    "02958343": "Car",
    "03001627": "Chair",
    "03261776": "Earphone",
    "03467517": "Guitar",
    "03624134": "Knife",
    "03636649": "Lamp",
    "03642806": "Laptop",
    "03790512": "Motorbike",
    "03797390": "Mug",
    "03948459": "Pistol",
    "04099429": "Rocket",
    "04225987": "Skateboard",
    "04379243": "Table",
}
"""WordNet offset (the folder's name) and name of each category."""

PARTS = {
    "Airplane": range(4),
    "Bag": range(4, 6),
    "Cap": range(6, 8),
    "Car": range(8, 12),
    "Chair": range(12, 16),
    "Earphone": range(16, 19),
    "Guitar": range(19, 22),
    "Knife": range(22, 24),
    "Lamp": range(24, 28),
    "Laptop": range(28, 30),
    "Motorbike": range(30, 36),
    "Mug": range(36, 38),
    "Pistol": range(38, 41),
    "Rocket": range(41, 44),
    "Skateboard": range(44, 47),
    "Table": range(47, 50),
}
"""Labels of the parts of each category, in the numbering 0 to 49 over all categories."""

SPLIT_LISTS = {split: f"train_test_split/shuffled_{split}_file_list.json" for split in ("train", "val", "test")}
"""List file of each split."""

_LOGGER = logging.getLogger(__name__)


class ShapeNetPartDataset:
    """ShapeNetPart in either of its original layouts, told apart by what is in `root`.

    ================  =========================================================  ===============================
    layout            shapes                                                     labels in the file
    ================  =========================================================  ===============================
    with normals      ``<offset>/<id>.txt``: x y z nx ny nz label                0 to 49 over all categories
    raw               ``<offset>/points/<id>.pts``: x y z,                       counted from 1 in each category
                      ``<offset>/points_label/<id>.seg``: label
    ================  =========================================================  ===============================

    Both have ``train_test_split/shuffled_{train,val,test}_file_list.json``. Whatever the layout, :meth:`load` returns
    labels of :data:`PARTS`. An entry's id is ``<offset>-<id>``.

    Parameters
    ----------
    root
        Folder of the data set.
    categories
        Names to keep; ``None`` keeps all 16.
    allow_missing
        Leave out, with a warning in the log, shapes that a split list names but that are not on disk, and splits whose
        list is absent. By default both are errors.
    axes
        Which axes of the files become x, y and z, for example ``("x", "z", "-y")``.

    Attributes
    ----------
    part_labels : dict of range
        Labels of the parts of each category, :data:`PARTS`.

    Raises
    ------
    DatasetError
        If a category is unknown, or the axes are not three different ones.
    """

    def __init__(
        self,
        root: Path | str,
        categories: Sequence[str] | None = None,
        allow_missing: bool = False,
        axes: Sequence[str] = ("x", "y", "z"),
    ) -> None:
        self.root = Path(root)
        self.categories = choose_categories(categories, CATEGORIES.values())
        self.allow_missing = allow_missing
        self.turn = axes_matrix(axes)
        self.part_labels = PARTS

    @property
    def how_to_get(self) -> str:
        """What to fetch, from where, and where to put it."""
        return (
            f"Fetch {URL} and unpack it so that {self.root / SPLIT_LISTS['train']} exists; or set "
            "dataset.root to where it is. The older archive without normals is understood, too."
        )

    def list_shapes(self) -> list[Entry]:
        """Return all shapes of all splits; reads the split lists and the folders only."""
        return [entry for entries in self._entries.values() for entry in entries]

    def counts(self) -> dict[str, int]:
        """Return the number of shapes of each split that has a list."""
        return {split: len(entries) for split, entries in self._entries.items()}

    def load(self, path: Path) -> PointCloud:
        """Read one cloud with the labels of :data:`PARTS`, and with normals if the layout has them."""
        from morphoskel.formats import read_point_cloud
        from morphoskel.shapes import PointCloud

        cloud = read_point_cloud(path)
        raw = path.suffix == ".pts"
        offset = (path.parent.parent if raw else path.parent).name
        if offset not in CATEGORIES:
            raise InputError(f"{path}: {offset!r} is no folder of ShapeNetPart; expected {', '.join(CATEGORIES)}")
        parts = PARTS[CATEGORIES[offset]]
        source = path.parent.parent / "points_label" / f"{path.stem}.seg" if raw else path
        labels = _read_raw_labels(source, len(cloud)) if raw else cloud.labels
        if labels is None:
            raise InputError(f"{path}: expected 7 columns x y z nx ny nz label; fetch the file again")
        shift = parts.start - 1 if raw else 0
        if labels.min() < parts.start - shift or labels.max() >= parts.stop - shift:
            raise InputError(
                f"{source}: the labels of {CATEGORIES[offset]} are {parts.start - shift} to {parts.stop - 1 - shift}, "
                f"but the shape has {labels.min()} to {labels.max()}; fetch the file again"
            )
        normals = None if cloud.normals is None else cloud.normals @ self.turn
        return PointCloud(cloud.points @ self.turn, normals, labels + shift)

    @cached_property
    def _entries(self) -> dict[str, list[Entry]]:
        """The shapes of each split."""
        check_root(self.root, self.how_to_get, "train_test_split")
        listed = {split: self._read_list(split) for split in SPLIT_LISTS if self._has_list(split)}
        _check_once(self.root, listed)
        raw = any((self.root / offset / "points").is_dir() for offset in CATEGORIES)
        present = self._list_files(raw)
        entries: dict[str, list[Entry]] = {}
        for split, shapes in listed.items():
            wanted = [(offset, name) for offset, name in shapes if CATEGORIES[offset] in self.categories]
            absent = [shape for shape in wanted if shape not in present]
            if absent:
                self._report_missing(split, absent)
            entries[split] = [self._entry(split, *shape, raw) for shape in wanted if shape in present]
        return entries

    def _has_list(self, split: str) -> bool:
        """Whether the split's list is there; if not, this is an error or logged."""
        path = self.root / SPLIT_LISTS[split]
        if path.is_file():
            return True
        if not self.allow_missing:
            raise DatasetError(
                f"{path}: the list of the split {split!r} is missing. {self.how_to_get} To go on without this split, "
                "set dataset.allow_missing=true"
            )
        _LOGGER.warning("%s: list is missing, the split %r is left out", path, split)
        return False

    def _read_list(self, split: str) -> list[tuple[str, str]]:
        """Return (offset, id) of all shapes of a split list."""
        path = self.root / SPLIT_LISTS[split]
        try:
            listed = json.loads(path.read_text(encoding="utf-8"))
            shapes = [tuple(str(item).split("/")[-2:]) for item in listed]
        except (OSError, ValueError, TypeError, RecursionError) as error:
            raise DatasetError(f"{path}: expected a JSON list of shapes ({error}); fetch it again") from error
        for shape in shapes:
            if len(shape) != 2 or shape[0] not in CATEGORIES:
                raise DatasetError(f"{path}: expected 'shape_data/<offset>/<id>', got {'/'.join(shape)!r}")
        return [(offset, name) for offset, name in shapes]

    def _list_files(self, raw: bool) -> set[tuple[str, str]]:
        """Return (offset, id) of the shapes on disk; one listing a folder is far cheaper than one query a file."""
        folder, suffix = ("points", ".pts") if raw else ("", ".txt")
        return {
            (offset, path.stem)
            for offset in CATEGORIES
            if (self.root / offset / folder).is_dir()
            for path in (self.root / offset / folder).iterdir()
            if path.suffix == suffix
        }

    def _report_missing(self, split: str, absent: list[tuple[str, str]]) -> None:
        """Raise, or log if that was asked for."""
        text = f"{self.root}: {len(absent)} shapes of the split {split!r} are not on disk, first {'/'.join(absent[0])}"
        if not self.allow_missing:
            raise DatasetError(f"{text}. {self.how_to_get} To go on without them, set dataset.allow_missing=true")
        _LOGGER.warning("%s; they are left out", text)

    def _entry(self, split: str, offset: str, name: str, raw: bool) -> Entry:
        folder = self.root / offset
        category = CATEGORIES[offset]
        if raw:
            labels = folder / "points_label" / f"{name}.seg"
            return Entry(f"{offset}-{name}", category, split, folder / "points" / f"{name}.pts", (labels,))
        return Entry(f"{offset}-{name}", category, split, folder / f"{name}.txt")


def _check_once(root: Path, listed: dict[str, list[tuple[str, str]]]) -> None:
    """Raise if a shape is listed twice, in one split or in two, which would leak test shapes into training."""
    times = Counter(shape for shapes in listed.values() for shape in shapes)
    repeated = [shape for shape, count in times.items() if count > 1]
    if repeated:
        where = [split for split, shapes in listed.items() for shape in shapes if shape == repeated[0]]
        raise DatasetError(
            f"{root / SPLIT_LISTS[where[0]]}: {len(repeated)} shapes are listed more than once, first "
            f"{'/'.join(repeated[0])} in {', '.join(where)}; fetch the lists again"
        )


def _read_raw_labels(labels_path: Path, points: int) -> IntArray:
    """Return the labels beside a raw cloud, as they are."""
    try:
        labels = np.array(labels_path.read_text(encoding="ascii").split(), dtype=np.int64)
    except OSError as error:
        raise InputError(f"{labels_path}: the labels of the shape cannot be read ({error.strerror})") from error
    except (ValueError, OverflowError) as error:
        raise InputError(f"{labels_path}: expected one whole number a line ({error}); fetch the file again") from error
    if len(labels) != points:
        raise InputError(f"{labels_path}: holds {len(labels)} labels for {points} points; fetch both files again")
    return labels
