"""Seconds that each stage takes for one shape, measured in one process, never from cached results."""

from __future__ import annotations

import logging
import time
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import ShapeRecord, read_manifest
from morphoskel.errors import MorphoSkelError
from morphoskel.morphology import dilation
from morphoskel.morphology.residue import residue
from morphoskel.progress import track
from morphoskel.seeds import derive_seed
from morphoskel.shapes import PointCloud
from morphoskel.skeleton.coverage import coverage_skeleton, typical_radius
from morphoskel.skeleton.selection import skeleton_of
from morphoskel.stages import TIMED_STAGES
from morphoskel.surface import reconstruct, watertight
from morphoskel.volume import Candidates, SurfaceDistance, occupancy

if TYPE_CHECKING:
    import pandas as pd

logger = logging.getLogger(__name__)


def time_stages(
    manifest: Path,
    *,
    split: str,
    surface: str,
    sections: Mapping[str, Any],
    seed: int,
    shapes_per_category: int,
    threads: int,
) -> pd.DataFrame:
    """Time every stage on the first shapes of each category.

    The first shape is run once beforehand and dropped: it pays for imports and compilation. Reading and writing files
    is not timed, as in the paper.

    Parameters
    ----------
    manifest
        The data set's manifest.
    split
        Which shapes to take from.
    surface
        Name of the reconstruction.
    sections
        The configuration sections ``dataset``, ``reconstruction``, ``watertight`` and ``skeleton``.
    seed
        The global seed.
    shapes_per_category
        Shapes timed in each category.
    threads
        Native threads of the stages after the watertight conversion; the two stages before it use one.

    Returns
    -------
    pandas.DataFrame
        ``id, category, surface, stage, seconds, threads``; seconds are empty from the stage on that failed.
    """
    import pandas as pd

    source = open_configured(sections["dataset"], seed=seed)
    chosen = _choose(read_manifest(manifest, split=split), shapes_per_category)
    rows = []
    for number, record in enumerate(track([chosen[0], *chosen], f"time {surface}")):
        seconds = _time_shape(source.load(record.path), record, surface, sections, seed, threads)
        if number > 0:
            rows += [
                {"id": record.id, "category": record.category, "surface": surface, "stage": stage,
                 "seconds": seconds.get(stage), "threads": threads}
                for stage in TIMED_STAGES
            ]  # fmt: skip
    return pd.DataFrame(rows)


def _choose(records: Sequence[ShapeRecord], shapes_per_category: int) -> list[ShapeRecord]:
    taken: dict[str, int] = defaultdict(int)
    chosen = []
    for record in records:
        taken[record.category] += 1
        if taken[record.category] <= shapes_per_category:
            chosen.append(record)
    return chosen


def _time_shape(
    cloud: PointCloud, record: ShapeRecord, surface: str, sections: Mapping[str, Any], seed: int, threads: int
) -> dict[str, float]:
    """Return the seconds of each stage that ended well."""
    seconds: dict[str, float] = {}
    settings = sections["skeleton"]
    try:
        with _clock(seconds, "reconstruct"):
            seed_of_sites = derive_seed(seed, record.id, "reconstruct")
            mesh = reconstruct(cloud, surface, seed=seed_of_sites, **sections["reconstruction"])
        with _clock(seconds, "watertight"):
            closed = watertight(mesh, seed=derive_seed(seed, record.id, "watertight"), **sections["watertight"])
        box = Candidates(*closed.bounds, **settings["candidates"], seed=derive_seed(seed, record.id, "occupancy"))
        with _clock(seconds, "occupancy"):
            inner = occupancy(closed, box, threads=threads).inner_points(threads=threads)
        with _clock(seconds, "udf"):
            udf = SurfaceDistance(closed)(inner, threads=threads)
        with _clock(seconds, "dilation"):
            dilated = dilation(inner, udf, settings["k"], threads=threads)
        with _clock(seconds, "select_skeleton"):
            skeleton_of(inner, udf, dilated, settings["points"])
        with _clock(seconds, "cover_skeleton"):
            coverage_skeleton(
                inner,
                udf,
                residue(udf, dilated),
                cloud.points,
                points=settings["points"],
                element_radius=typical_radius(box, settings["k"]),
                threads=threads,
                **settings["coverage"],
            )
    except MorphoSkelError as error:
        logger.warning("%s: not timed further: %s", record.id, error)
    return seconds


@contextmanager
def _clock(seconds: dict[str, float], stage: str) -> Iterator[None]:
    """Record the wall time of the block, unless it raises."""
    start = time.perf_counter()
    yield
    seconds[stage] = time.perf_counter() - start
