"""The synthetic data set: which shapes it holds, where they lie, and how they are written."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.atomic import atomic_folder
from morphoskel.datasets.dataset import check_root, choose_categories
from morphoskel.datasets.manifest import SAFE_NAME, Entry
from morphoskel.datasets.synthetic.catalogue import CATEGORIES, part_labels
from morphoskel.datasets.synthetic.generate import check_point_count, generate_shape
from morphoskel.errors import DatasetError, ShapeError
from morphoskel.pool import run_isolated
from morphoskel.progress import track

if TYPE_CHECKING:
    from morphoskel.shapes import PointCloud

DESCRIPTION = "synthetic.json"
"""File in the root that tells what the shapes were generated from."""


class SyntheticDataset:
    """Parametric shapes in 17 categories, generated from a seed.

    ``root`` holds ``clouds/<category>/<id>.ply`` (points, normals, part labels), ``meshes/<category>/<id>.ply`` (the
    watertight surfaces) and ``synthetic.json``; :func:`write_shapes` makes it.

    Parameters
    ----------
    root
        Folder of the data set.
    categories
        Names to keep, for example ``["Chair", "Lamp"]``; ``None`` keeps all.
    per_category
        Number of shapes of each category by split, for example ``{"train": 8, "test": 4}``.
    points
        Number of points of a cloud.
    seed
        The global seed.

    Attributes
    ----------
    part_labels : dict of range
        Labels of the parts of each category, in one numbering over all categories.

    Raises
    ------
    DatasetError
        If a category is unknown, or a number is too small.
    """

    def __init__(
        self,
        root: Path | str,
        categories: Sequence[str] | None = None,
        per_category: Mapping[str, int] | None = None,
        points: int = 2000,
        seed: int = 0,
    ) -> None:
        self.root = Path(root)
        self.categories = choose_categories(categories, CATEGORIES)
        self.per_category = dict({"train": 8, "test": 4} if per_category is None else per_category)
        self.points = points
        self.seed = seed
        self.part_labels = {category: part_labels(category) for category in CATEGORIES}
        check_point_count(points)
        for split, count in self.per_category.items():
            if not SAFE_NAME.fullmatch(split):
                raise DatasetError(f"per_category: split {split!r} must be made of letters, digits and _ . + - only")
            if count < 0:
                raise DatasetError(f"per_category.{split}: expected at least 0 shapes, got {count}")

    @property
    def how_to_get(self) -> str:
        """How to make the data set; nothing has to be fetched."""
        return (
            f"The synthetic shapes are generated, not fetched: the workflow does it by itself, or call "
            f"morphoskel.datasets.synthetic.write_shapes, which fills {self.root}."
        )

    def plan_shapes(self) -> list[Entry]:
        """Return all shapes of all splits, generated or not."""
        return [
            Entry(name, category, split, self.root / "clouds" / category / f"{name}.ply")
            for split, count in self.per_category.items()
            for category in self.categories
            for name in (f"{category.lower()}-{split}-{index:04d}" for index in range(count))
        ]

    def list_shapes(self) -> list[Entry]:
        """Return all shapes of all splits.

        Raises
        ------
        DatasetError
            If they have not been generated, or with another seed or number of points.
        """
        check_root(self.root, self.how_to_get, DESCRIPTION, "clouds")
        path = self.root / DESCRIPTION
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
            made_with = {key: found[key] for key in self._description()}
        except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
            raise DatasetError(f"{path}: is damaged ({error}); delete {self.root} and generate it again") from error
        if made_with != self._description():
            raise DatasetError(
                f"{path}: the shapes were generated from {made_with}, but {self._description()} is asked for; delete "
                f"{self.root} and generate it again, or choose another dataset.root"
            )
        return self.plan_shapes()

    def counts(self) -> dict[str, int]:
        """Return the number of shapes of each split; pure arithmetic."""
        return {split: count * len(self.categories) for split, count in self.per_category.items()}

    def load(self, path: Path) -> PointCloud:
        """Read the cloud whose entry has this `path`.

        Raises
        ------
        InputError
            If the file is broken.
        """
        from morphoskel.formats.read import read_point_cloud

        return read_point_cloud(path)

    def _description(self) -> dict[str, int]:
        return {"seed": self.seed, "points": self.points}


def write_shapes(dataset: SyntheticDataset, *, workers: int = 1, progress: bool = False) -> None:
    """Generate every shape of `dataset` and write it under its root, whole or not at all.

    Parameters
    ----------
    dataset
        What to generate. A data set that was generated there before is replaced.
    workers
        Number of processes; the files do not depend on it.
    progress
        Show a progress bar.

    Raises
    ------
    DatasetError
        If there is nothing to generate, or the root holds something else.
    ShapeError
        If a shape cannot be built, which would be a defect of its builder.
    """
    if workers < 1:
        raise DatasetError(f"workers: expected at least 1 process, got {workers}")
    entries = dataset.plan_shapes()
    if not entries:
        raise DatasetError(f"per_category: {dataset.per_category} asks for no shape at all; set a number above 0")
    root = dataset.root
    if root.exists() and not (root / DESCRIPTION).is_file() and (not root.is_dir() or any(root.iterdir())):
        raise DatasetError(
            f"{root}: holds something other than generated shapes and would be replaced; choose another dataset.root, "
            "or empty the folder yourself"
        )
    with atomic_folder(root) as partial:
        tasks = {entry.id: _Task(entry.category, entry.id, dataset.seed, dataset.points, partial) for entry in entries}
        for kind in ("clouds", "meshes"):
            for category in dataset.categories:
                (partial / kind / category).mkdir(parents=True)
        outcomes = run_isolated(_write_shape, tasks, workers=min(workers, len(tasks)), preload=[__name__])
        for outcome in track(outcomes, "generate", total=len(tasks), show=progress):
            if outcome.reason:
                raise ShapeError(f"{outcome.key}: could not be built: {outcome.reason}")
        text = json.dumps(dataset._description(), indent=2)
        (partial / DESCRIPTION).write_text(f"{text}\n", encoding="utf-8")


@dataclass(frozen=True)
class _Task:
    """What a worker needs to know to write one shape."""

    category: str
    shape_id: str
    seed: int
    points: int
    folder: Path


def _write_shape(task: _Task) -> None:
    from morphoskel.formats.write import write_cloud_ply, write_mesh_ply

    shape = generate_shape(task.category, task.shape_id, seed=task.seed, points=task.points)
    name = f"{task.shape_id}.ply"
    write_cloud_ply(task.folder / "clouds" / task.category / name, shape.cloud)
    write_mesh_ply(task.folder / "meshes" / task.category / name, shape.mesh)
