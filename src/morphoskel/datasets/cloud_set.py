"""The clouds of a split, normalised and of equal size, as networks are trained and tested on them."""

from __future__ import annotations

import zipfile
import zlib
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
from morphoskel.seeds import derive_generator
from morphoskel.shapes import FloatArray


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
    """

    ids: npt.NDArray[np.str_]
    labels: npt.NDArray[np.int64]
    class_names: npt.NDArray[np.str_]
    points: npt.NDArray[np.float32]
    centres: FloatArray
    scales: FloatArray

    def __len__(self) -> int:
        return len(self.ids)

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
    manifest: Path, split: str, *, dataset: Mapping[str, Any], points: int, seed: int, progress: bool = True
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
    progress
        Show a progress bar.

    Raises
    ------
    DatasetError
        If the manifest has no shape of the split.
    ShapeError
        If a cloud has too few points, naming it.
    """
    from tqdm import tqdm

    source = open_configured(dataset, seed=seed)
    class_names = np.array(sorted({record.category for record in read_manifest(manifest)}))
    records = read_manifest(manifest, split=split)
    normalised = []
    for record in tqdm(records, unit="cloud", desc=f"read {split}", disable=not progress):
        try:
            cloud = source.load(record.path).points
            normalised.append(normalise(_draw(cloud, points, derive_generator(seed, record.id, "network points"))))
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
    )


def _draw(cloud: FloatArray, points: int, generator: np.random.Generator) -> FloatArray:
    if len(cloud) < points:
        raise ShapeError(f"has {len(cloud)} points, {points} are wanted; lower sampling.points, or sample it denser")
    return cloud if len(cloud) == points else cloud[generator.choice(len(cloud), points, replace=False)]


def write_cloud_set(clouds: CloudSet, path: Path) -> None:
    """Write the clouds to an NPZ file, whole or not at all."""
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez(stream, **{field.name: getattr(clouds, field.name) for field in fields(CloudSet)})


def read_cloud_set(path: Path) -> CloudSet:
    """Read the file of :func:`write_cloud_set`.

    Raises
    ------
    InputError
        If it is absent or is not such a file.
    """
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            return CloudSet(**{field.name: stored[field.name] for field in fields(CloudSet)})
    except (OSError, EOFError, KeyError, TypeError, ValueError, zipfile.BadZipFile, zlib.error) as error:
        raise InputError(f"{path}: expected a file of clouds of this version ({error}); make it again") from error
