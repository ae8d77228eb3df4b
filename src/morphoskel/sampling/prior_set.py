"""How far the points of a split's clouds are from the skeletons of their shapes: what the skeleton prior is made of."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
import numpy.typing as npt

from morphoskel.atomic import atomic_file
from morphoskel.chain.status import read_status
from morphoskel.checksums import intact
from morphoskel.datasets.cloud_set import CloudSet
from morphoskel.errors import InputError, ShapeError
from morphoskel.formats import read_skeleton_ply
from morphoskel.formats.stored_arrays import Layout, read_arrays
from morphoskel.progress import track
from morphoskel.sampling.prior import local_feature_size

_LAYOUT: Layout = {"ids": ("U", "S"), "distances": ("f", "SN"), "reasons": ("U", "S")}

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class PriorSet:
    """Local feature sizes.

    Parameters
    ----------
    ids
        ``(S,)`` text, the shapes' ids.
    distances
        ``(S, N)`` float32, of each point of the normalised cloud to the nearest skeletal point; NaN for a shape without
        a skeleton.
    reasons
        ``(S,)`` text, why a shape has none; empty if it has one.
    """

    ids: npt.NDArray[np.str_]
    distances: npt.NDArray[np.float32]
    reasons: npt.NDArray[np.str_]


def measure_local_feature_sizes(clouds: CloudSet, folders: Sequence[Path], *, progress: bool = True) -> PriorSet:
    """Measure the distance of each point to its shape's skeleton.

    Parameters
    ----------
    clouds
        Of a split. Skeletons are moved and scaled like the clouds; the released program normalises the two together,
        which shows clouds to the task network otherwise than it was trained.
    folders
        The skeleton folders of all shards, with their ``status.csv``.
    progress
        Show a progress bar.

    Raises
    ------
    ShapeError
        If a shape of the split is in none of the folders.
    StorageError
        If a skeleton is damaged.
    """
    found = {row.id: (row, folder) for folder in folders for row in read_status(folder)}
    distances = np.full(clouds.points.shape[:2], np.nan, dtype=np.float32)
    reasons = []
    for number, shape in enumerate(track(clouds.ids, "local feature size", show=progress)):
        if shape not in found:
            raise ShapeError(f"{shape}: is in none of the {len(folders)} skeleton folders; build the skeletons again")
        status, folder = found[shape]
        if status.status == "failed":
            reasons.append(status.failure)
            continue
        skeleton = read_skeleton_ply(intact(folder / f"{shape}.ply")).points
        skeleton = (skeleton - clouds.centres[number]) / clouds.scales[number]
        distances[number] = local_feature_size(clouds.points[number].astype(np.float64), skeleton)
        reasons.append("")
    return PriorSet(clouds.ids, distances, np.array(reasons, dtype=np.str_))


def check_priors(priors: PriorSet, max_failed: int) -> None:
    """Log the shapes without a skeleton, and raise if there are more than tolerated.

    Raises
    ------
    ShapeError
        Naming the first of them.
    """
    failed = [f"{shape}: {reason}" for shape, reason in zip(priors.ids, priors.reasons, strict=True) if reason]
    for line in failed:
        logger.warning("failed: %s", line)
    if len(failed) > max_failed:
        raise ShapeError(
            f"{len(failed)} shapes have no skeleton, {max_failed} are tolerated (max_failed); the first: {failed[0]}\n"
            "Mend the input or the settings; or raise max_failed: such shapes are left out of the training and the "
            "tables state how many failed"
        )


def write_prior_set(priors: PriorSet, path: Path) -> None:
    """Write the distances to an NPZ file, whole or not at all."""
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez(stream, **{field.name: getattr(priors, field.name) for field in fields(PriorSet)})


def read_prior_set(path: Path, clouds: CloudSet) -> PriorSet:
    """Read the file of :func:`write_prior_set` that belongs to `clouds`.

    Raises
    ------
    InputError
        If it is absent, is not such a file, or belongs to other clouds.
    """
    arrays = read_arrays(path, _LAYOUT, "a file of local feature sizes")
    priors = PriorSet(**{name: arrays[name] for name in _LAYOUT})
    if priors.distances.shape != clouds.points.shape[:2] or not np.array_equal(priors.ids, clouds.ids):
        raise InputError(f"{path}: belongs to other clouds, {len(priors.ids)} instead of {len(clouds)}; make it again")
    return priors
