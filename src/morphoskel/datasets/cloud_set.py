"""The clouds of a split, normalised and of equal size, as networks are trained and tested on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.atomic import atomic_file
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import read_manifest
from morphoskel.errors import InputError, ShapeError
from morphoskel.formats.stored_arrays import Layout, read_arrays
from morphoskel.progress import track
from morphoskel.seeds import derive_generator
from morphoskel.shapes import FloatArray, IntArray, PointCloud

_LAYOUT: Layout = {
    "ids": ("U", "S"),
    "labels": ("i", "S"),
    "class_names": ("U", "C"),
    "points": ("f", "SN3"),
    "centres": ("f", "S3"),
    "scales": ("f", "S"),
}
_LAYOUT_OF_PARTS: Layout = {**_LAYOUT, "parts": ("i", "SN"), "part_classes": ("i", "P")}
_WHAT = "a file of clouds of this version"


@dataclass(frozen=True, eq=False)
class CloudSet:
    """Clouds with their classes.

    Parameters
    ----------
    ids
        ``(S,)`` text, the shapes' ids.
    labels
        ``(S,)`` int64, positions in `class_names`.
    class_names
        ``(C,)`` text, the classes of all splits of the data set, sorted.
    points
        ``(S, N, 3)`` float32: centroid 0 and largest distance from it 1.
    centres, scales
        ``(S, 3)`` and ``(S,)`` float64: a normalised point is (original - centre) / scale.
    parts
        ``(S, N)`` int64, the part that each point belongs to, -1 for a point that repeats an earlier one; ``None`` for
        a data set without parts.
    part_classes
        ``(P,)`` int64, the label of the class to which each of all P parts belongs, -1 for a class that the set lacks;
        ``None`` likewise.

    Notes
    -----
    A cloud with fewer than N points has all of them, in order, again and again: point i is a copy of i modulo their
    number.
    """

    ids: npt.NDArray[np.str_]
    labels: npt.NDArray[np.int64]
    class_names: npt.NDArray[np.str_]
    points: npt.NDArray[np.float32]
    centres: FloatArray
    scales: FloatArray
    parts: npt.NDArray[np.int64] | None = None
    part_classes: npt.NDArray[np.int64] | None = None

    def __len__(self) -> int:
        return len(self.ids)

    @property
    def lengths(self) -> npt.NDArray[np.int64]:
        """Return the number of different points of each cloud, ``(S,)``; the others repeat them."""
        shapes, available = self.points.shape[:2]
        return np.full(shapes, available) if self.parts is None else np.sum(self.parts >= 0, axis=1, dtype=np.int64)

    @property
    def categories(self) -> npt.NDArray[np.str_]:
        """Return the class name of each shape, ``(S,)``."""
        return self.class_names[self.labels]

    def check_classes(self, names: Sequence[str]) -> None:
        """Refuse the names of a classifier's classes if they are others, or in another order.

        Raises
        ------
        InputError
            Saying how they differ.
        """
        if list(names) != self.class_names.tolist():
            raise InputError(
                f"expected a classifier of the {len(self.class_names)} classes {', '.join(self.class_names)}, got one "
                f"of {', '.join(names)}; train one on this data set"
            )


def normalise(points: FloatArray) -> tuple[npt.NDArray[np.float32], FloatArray, float]:
    """Move the centroid to the origin and scale the largest distance from it to 1.

    Parameters
    ----------
    points
        ``(N, 3)`` float64.

    Returns
    -------
    tuple
        The points as float32, the centre ``(3,)`` and the scale, both float64.

    Raises
    ------
    ShapeError
        If all points are the same.
    """
    if not np.ptp(points, axis=0).max() > 0:  # the rounded mean of equal points may differ from them
        raise ShapeError(f"all {len(points)} points are the same; expected a cloud with an extent")
    centre = points.mean(axis=0)
    scale = float(np.linalg.norm(points - centre, axis=1).max())
    return ((points - centre) / scale).astype(np.float32), centre, scale


def gather_clouds(
    manifest: Path,
    split: str,
    *,
    dataset: Mapping[str, Any],
    points: int,
    seed: int,
    repeat: bool = False,
    progress: bool = True,
) -> CloudSet:
    """Read the clouds of a split and bring them to the same number of points.

    Parameters
    ----------
    manifest
        The data set's manifest.
    split
        The split.
    dataset, seed
        The configuration's data set section and the global seed.
    points
        Points of each cloud, drawn at random without replacement; a cloud with just as many keeps them in their order.
    repeat
        Repeat the points of clouds that have too few, as often as needed.
    progress
        Show a progress bar.

    Raises
    ------
    DatasetError
        If the manifest has no shape of the split.
    ShapeError
        If a cloud has too few points, or no part labels though the data set has parts, naming it.
    """
    source = open_configured(dataset, seed=seed)
    part_labels = getattr(source, "part_labels", None)
    class_names = np.array(sorted({record.category for record in read_manifest(manifest)}))
    records = read_manifest(manifest, split=split)
    normalised, parts = [], []
    for record in track(records, f"read {split}", unit="cloud", show=progress):
        try:
            cloud = source.load(record.path)
            generator = derive_generator(seed, record.id, "network points")
            drawn = _draw(len(cloud), points, generator, repeat)
            normalised.append(normalise(cloud.points[drawn]))
            if part_labels:
                parts.append(_parts(cloud, drawn))
        except ShapeError as error:
            raise ShapeError(f"{record.id} ({record.path}): {error}") from error
    clouds, centres, scales = zip(*normalised, strict=True)
    return CloudSet(
        ids=np.array([record.id for record in records]),
        labels=np.searchsorted(class_names, [record.category for record in records]).astype(np.int64),
        class_names=class_names,
        points=np.stack(clouds),
        centres=np.stack(centres),
        scales=np.array(scales),
        parts=np.stack(parts) if part_labels else None,
        part_classes=_part_classes(part_labels, class_names.tolist()) if part_labels else None,
    )


def _draw(available: int, points: int, generator: np.random.Generator, repeat: bool) -> IntArray:
    """Return the indices of the points to use."""
    if available < points and not repeat:
        raise ShapeError(f"has {available} points, {points} are wanted; lower sampling.points, or sample it denser")
    if available <= points:
        return np.arange(points) % available
    return generator.choice(available, points, replace=False)


def _parts(cloud: PointCloud, drawn: IntArray) -> IntArray:
    """Return the parts of the points, -1 for repeated ones."""
    if cloud.labels is None:
        raise ShapeError("has no part labels, though its data set has parts")
    return np.where(np.arange(len(drawn)) < len(cloud), cloud.labels[drawn], -1)


def _part_classes(part_labels: Mapping[str, range], class_names: list[str]) -> IntArray:
    """Return the class of each part, -1 for the parts of classes that are left out."""
    classes = np.full(max(parts.stop for parts in part_labels.values()), -1, dtype=np.int64)
    for label, name in enumerate(class_names):
        classes[part_labels[name].start : part_labels[name].stop] = label
    return classes


def write_cloud_set(clouds: CloudSet, path: Path) -> None:
    """Write the clouds to an NPZ file, whole or not at all."""
    with atomic_file(path) as partial, partial.open("wb") as stream:
        values = {field.name: getattr(clouds, field.name) for field in fields(CloudSet)}
        np.savez(stream, **{name: value for name, value in values.items() if value is not None})


def read_cloud_set(path: Path) -> CloudSet:
    """Read the file of :func:`write_cloud_set`.

    Raises
    ------
    InputError
        If it is absent or is not such a file.
    """
    arrays = read_arrays(path, _LAYOUT, _WHAT)
    if not arrays.keys() <= _LAYOUT_OF_PARTS.keys():
        raise InputError(f"{path}: expected {_WHAT} (it holds {', '.join(arrays)}); make it again")
    if arrays.keys() != _LAYOUT.keys():
        arrays = read_arrays(path, _LAYOUT_OF_PARTS, _WHAT)
    labels, classes = arrays["labels"], len(arrays["class_names"])
    if len(labels) and not (labels.min() >= 0 and labels.max() < classes):
        raise InputError(f"{path}: labels: expected 0 to {classes - 1}, got {labels.min()} to {labels.max()}")
    return CloudSet(**arrays)
