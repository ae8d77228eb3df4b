"""Evaluate the skeletons of a split against the clouds that they were made from, and against reference axes."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.chain.status import Status, read_status
from morphoskel.checksums import intact
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import ShapeRecord, read_manifest
from morphoskel.errors import MorphoSkelError, ShapeError
from morphoskel.evaluation.sphere_metrics import sphere_distances
from morphoskel.formats import read_skeleton_ply
from morphoskel.methods import RANKED
from morphoskel.progress import track
from morphoskel.seeds import derive_seed
from morphoskel.shapes import FloatArray, Skeleton
from morphoskel.skeleton.equal_count import bring_to_count
from morphoskel.skeleton.interpolation import interpolate_balls

if TYPE_CHECKING:
    import pandas as pd

logger = logging.getLogger(__name__)

LISTED_FAILURES = 20

AS_IS = "as is"
"""The method's own balls."""

DENSE = "dense"
"""Balls interpolated on the skeletal mesh, as the results of Point2Skeleton are published."""


@dataclass(frozen=True)
class Balls:
    """Which balls of a skeleton are evaluated, beside its own.

    Parameters
    ----------
    equal_counts
        Numbers of balls to which the skeleton is brought, see :func:`~morphoskel.skeleton.equal_count.bring_to_count`.
    dense
        Number of balls interpolated on the skeletal mesh; ``None`` for methods that have none.
    """

    equal_counts: Sequence[int] = ()
    dense: int | None = None


def evaluate_skeletons(
    manifest: Path,
    folders: Sequence[Path],
    axes: Sequence[Path],
    *,
    split: str,
    dataset: Mapping[str, Any],
    seed: int,
    surface: str,
    method: str,
    balls: Balls,
) -> pd.DataFrame:
    """Measure the distances between cloud and balls, and between axis and centres, for every shape of a split.

    Parameters
    ----------
    manifest
        The data set's manifest.
    folders
        The skeleton folders of all shards, with their ``status.csv``.
    axes
        The folders of the reference medial axes of all shards; none if there are no axes.
    split
        The split.
    dataset, seed
        The configuration's data set section and the global seed, to read the clouds.
    surface, method
        Names of the configuration.
    balls
        What is evaluated.

    Returns
    -------
    pandas.DataFrame
        One row a shape and kind of balls: id, category, surface, method, balls, status, reason, seconds (of all stages
        from the cloud to the skeleton, for the method's own balls only), the fields of ``SphereDistances``, and the
        same with the prefix ``axis_``, where the points of the axis take the place of the cloud and all radii are 0.
        What could not be measured is empty, with the reason.

    Raises
    ------
    ShapeError
        If a shape of the split is in none of the folders.
    StorageError
        If a skeleton or an axis is damaged.
    """
    import pandas as pd

    source = open_configured(dataset, seed=seed)
    records = read_manifest(manifest, split=split)
    statuses = _statuses(folders, records)
    axis_statuses = _statuses(axes, records) if axes else {}
    rows = []
    for record in track(records, f"evaluate {method} on {surface}"):
        status, folder = statuses[record.id]
        own: dict[str, Any] = {"id": record.id, "category": record.category, "surface": surface, "method": method}
        if status.status == "failed":
            kinds = [AS_IS, *([DENSE] if balls.dense else []), *map(str, balls.equal_counts)]
            failed = {"status": "failed", "reason": status.failure}
            rows += [{**own, "balls": kind, **failed} for kind in kinds]
            continue
        skeleton = read_skeleton_ply(intact(folder / f"{record.id}.ply"))
        cloud = source.load(record.path).points
        axis = _read_axis(record, axis_statuses)
        generator = np.random.default_rng(derive_seed(seed, record.id, "equal counts"))
        for kind, evaluated in _kinds(skeleton, balls, method in RANKED, generator):
            seconds = {"seconds": status.seconds_so_far} if kind == AS_IS else {}
            rows.append({**own, "balls": kind, **_measure(evaluated, cloud, axis), **seconds})
    return pd.DataFrame(rows)


def _kinds(
    skeleton: Skeleton, balls: Balls, ranked: bool, generator: np.random.Generator
) -> Iterator[tuple[str, Skeleton | str]]:
    """Yield the name of each kind of balls, and the balls or why there are none."""
    yield AS_IS, skeleton
    if balls.dense:
        yield DENSE, interpolate_balls(skeleton, balls.dense, generator)
    for count in balls.equal_counts:
        try:
            yield str(count), bring_to_count(skeleton, count, generator, ranked=ranked)
        except MorphoSkelError as error:
            yield str(count), f"equal count: {error}"


def _measure(skeleton: Skeleton | str, cloud: FloatArray, axis: FloatArray | str) -> dict[str, Any]:
    """Return the distances of one skeleton, or why there are none."""
    if isinstance(skeleton, str):
        return {"status": "failed", "reason": skeleton}
    found: dict[str, Any] = {
        "status": "ok",
        "reason": "",
        **asdict(sphere_distances(cloud, skeleton.points, skeleton.radii)),
    }
    if isinstance(axis, str):
        return {**found, "reason": axis}
    to_axis = sphere_distances(axis, skeleton.points, np.zeros(len(skeleton)))
    return {**found, **{f"axis_{name}": value for name, value in asdict(to_axis).items()}}


def _read_axis(record: ShapeRecord, statuses: Mapping[str, tuple[Status, Path]]) -> FloatArray | str:
    """Return the points of the shape's reference axis, or why there is none; empty if none is wanted."""
    if not statuses:
        return ""
    status, folder = statuses[record.id]
    if status.status == "failed":
        return f"reference axis: {status.failure}"
    return read_skeleton_ply(intact(folder / f"{record.id}.ply")).points


def _statuses(folders: Sequence[Path], records: Sequence[ShapeRecord]) -> dict[str, tuple[Status, Path]]:
    """Return status and folder of every shape."""
    statuses = {row.id: (row, folder) for folder in folders for row in read_status(folder)}
    missing = [record.id for record in records if record.id not in statuses]
    if missing:
        raise ShapeError(f"{len(missing)} shapes are in none of {len(folders)} folders, the first is {missing[0]}")
    return statuses


def check_failures(rows: Iterable[Mapping[str, Any]], max_failed: int) -> None:
    """Log the shapes without a skeleton, and raise if there are more than tolerated.

    Parameters
    ----------
    rows
        With ``id``, ``balls``, ``status`` and ``reason``.
    max_failed
        Number of failures that a run tolerates.

    Raises
    ------
    ShapeError
        Naming the shapes and their reasons.
    """
    failed = [f"{row['id']}: {row['reason']}" for row in rows if row["status"] == "failed" and row["balls"] == AS_IS]
    for line in failed:
        logger.warning("failed: %s", line)
    if len(failed) > max_failed:
        shown = "\n  ".join(failed[:LISTED_FAILURES])
        more = f"\n  and {len(failed) - LISTED_FAILURES} more" if len(failed) > LISTED_FAILURES else ""
        raise ShapeError(
            f"{len(failed)} shapes failed, {max_failed} are tolerated (max_failed):\n  {shown}{more}\n"
            "Mend the input or the settings; or raise max_failed, and the tables state how many failed. "
            "They are tried again only when something changed that a stage depends on, or when asked for: "
            "morphoskel run ... -- --forcerun STAGE"
        )
