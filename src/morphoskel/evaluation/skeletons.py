"""Evaluate the skeletons of a split against the clouds that they were made from."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.chain.status import Status, read_status
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import ShapeRecord, read_manifest
from morphoskel.errors import ShapeError
from morphoskel.evaluation.sphere_metrics import sphere_distances
from morphoskel.formats import read_skeleton_ply

if TYPE_CHECKING:
    import pandas as pd

logger = logging.getLogger(__name__)

LISTED_FAILURES = 20


def evaluate_skeletons(
    manifest: Path,
    folders: Sequence[Path],
    *,
    split: str,
    dataset: Mapping[str, Any],
    seed: int,
    surface: str,
    method: str = "ms3d",
) -> pd.DataFrame:
    """Measure the distances between cloud and balls for every shape of a split.

    Parameters
    ----------
    manifest
        The data set's manifest.
    folders
        The skeleton folders of all shards, with their ``status.csv``.
    split
        The split.
    dataset, seed
        The configuration's data set section and the global seed, to read the clouds.
    surface, method
        Written into the rows.

    Returns
    -------
    pandas.DataFrame
        One row a shape: id, category, surface, method, status, reason, and the fields of ``SphereDistances``
        (empty where the shape failed).

    Raises
    ------
    ShapeError
        If a shape of the split is in none of the folders.
    """
    import pandas as pd
    from tqdm import tqdm

    source = open_configured(dataset, seed=seed)
    statuses = {row.id: (row, folder) for folder in folders for row in read_status(folder)}
    records = read_manifest(manifest, split=split)
    missing = [record.id for record in records if record.id not in statuses]
    if missing:
        raise ShapeError(f"{len(missing)} shapes of split {split!r} have no skeleton, the first is {missing[0]}")
    rows = []
    for record in tqdm(records, unit="shape", desc="evaluate"):
        status, folder = statuses[record.id]
        row = {"id": record.id, "category": record.category, "surface": surface, "method": method}
        rows.append({**row, **_evaluate(record, status, folder, source)})
    return pd.DataFrame(rows)


def _evaluate(record: ShapeRecord, status: Status, folder: Path, source: Any) -> dict[str, Any]:
    if status.status == "failed":
        return {"status": "failed", "reason": f"{status.stage}: {status.reason}"}
    skeleton = read_skeleton_ply(folder / f"{record.id}.ply")
    distances = sphere_distances(source.load(record.path).points, skeleton.points, skeleton.radii)
    return {"status": "ok", "reason": "", **asdict(distances)}


def check_failures(rows: Iterable[Mapping[str, Any]], max_failed: int) -> None:
    """Log the failed shapes, and raise if there are more than tolerated.

    Parameters
    ----------
    rows
        With ``id``, ``status`` and ``reason``.
    max_failed
        Number of failures that a run tolerates.

    Raises
    ------
    ShapeError
        Naming the shapes and their reasons.
    """
    failed = [f"{row['id']}: {row['reason']}" for row in rows if row["status"] == "failed"]
    for line in failed:
        logger.warning("failed: %s", line)
    if len(failed) > max_failed:
        shown = "\n  ".join(failed[:LISTED_FAILURES])
        more = f"\n  and {len(failed) - LISTED_FAILURES} more" if len(failed) > LISTED_FAILURES else ""
        raise ShapeError(
            f"{len(failed)} shapes failed, {max_failed} are tolerated (max_failed):\n  {shown}{more}\n"
            "Mend the input or the settings; or raise max_failed, and the tables state how many failed"
        )
