"""What the load test asks: is every shape complete, and does memory stay where it was?"""

import json
from collections import Counter

import numpy as np
import pandas as pd

from morphoskel.chain.status import read_status
from morphoskel.errors import MorphoSkelError
from morphoskel.formats.skeleton_file import read_skeleton
from morphoskel.run_provenance import collect_provenance, read_provenance
from tests.load.clouds import split_counts
from tests.load.run import COPIED_FROM

WARM_UP = 0.25
"""Share of the looks at a series that are left out: libraries are still being loaded, caches and heaps filled."""

FEWEST = 20
"""Looks that a series must have after the warm-up to say anything about growth."""

LEAST_RUN = 2000
"""Shapes that a run must pass after the warm-up for its processes to be judged from job to job."""

LEAST_LIFE = 100
"""The same of a worker in its life."""

MAIN_BOUND = 2.0
"""MB that Snakemake's main process may grow in 1,000 shapes. It remembers each finished job."""

WORKER_BOUND = 2.0
"""MB that the largest worker of a stage may grow in 1,000 shapes of the run, from job to job."""

LIFE_BOUND = 20.0
"""MB that a worker of a stage may grow in 1,000 shapes of its own, while it lives, which is for one job."""

MOST = 2000
"""Looks of a series that are compared with each other; of more, every second, third, ... one."""


def growth(shapes, megabytes, least):
    """Return the slope of a series after its warm-up in MB in 1,000 shapes, or None if it spans fewer than `least`.

    The slope is the median of the slopes between all pairs of looks (Theil and Sen), which single peaks do not move.
    """
    order = np.argsort(shapes, kind="stable")[int(len(shapes) * WARM_UP) :: 1 + len(shapes) // MOST]
    shapes, megabytes = np.asarray(shapes, float)[order], np.asarray(megabytes, float)[order]
    if len(shapes) < FEWEST or np.ptp(shapes) < least:
        return None
    earlier, later = np.triu_indices(len(shapes), 1)
    apart = shapes[later] - shapes[earlier]
    slopes = (megabytes[later] - megabytes[earlier])[apart > 0] / apart[apart > 0]
    return float(np.median(slopes)) * 1000


def check_memory(memory, load):
    """Return a row (what, looks, median MB, largest MB, slope, bound) for each series whose memory must not grow.

    Parameters
    ----------
    memory
        All looks, as ``memory.csv`` has them.
    load
        Of which run. In the mean, ``load.shapes / load.jobs`` shapes pass all stages for each finished job.
    """
    memory = memory.assign(shapes=memory["jobs"] * load.shapes / load.jobs)
    series = [(f"main process, attempt {attempt}", rows, MAIN_BOUND, LEAST_RUN)
              for attempt, rows in memory[memory["role"] == "snakemake"].groupby("attempt")]  # fmt: skip
    workers = memory[memory["role"] == "worker"]
    for stage, rows in workers.groupby("stage", sort=False):
        ordered = _in_order(rows, load.shapes)
        largest = ordered.groupby(["attempt", "seconds"], as_index=False).agg({"megabytes": "max", "shapes": "max"})
        series.append((f"largest worker, {stage}", largest, WORKER_BOUND, LEAST_RUN))
        series.append((f"worker in its life, {stage}", _lives(rows, load.shard_size), LIFE_BOUND, LEAST_LIFE))
    return [
        {
            "series": name,
            "looks": len(rows),
            "median_mb": round(float(rows["megabytes"].median()), 1),
            "largest_mb": round(float(rows["megabytes"].max()), 1),
            "mb_in_1000_shapes": growth(rows["shapes"], rows["megabytes"], least),
            "bound": bound,
        }
        for name, rows, bound, least in series
    ]


def _in_order(rows, shapes):
    """Return the looks at a stage's workers with the shapes that earlier ones had done, as a worker does one shard."""
    order = rows.groupby(["attempt", "pid"], sort=False).ngroup()
    return rows.assign(shapes=shapes * order / (order.max() + 1))


def _lives(rows, shard_size):
    """Return the looks at workers with the shapes that each of them had done by then, as its age tells."""
    seconds = rows.groupby(["attempt", "pid"])["seconds"]
    age, life = rows["seconds"] - seconds.transform("min"), seconds.transform("max") - seconds.transform("min")
    return rows.assign(shapes=shard_size * age / life).dropna()


def check_shapes(load):
    """Return the number of shapes by state: complete, failed, unreadable, lost, or listed twice."""
    expected = {
        name
        for split in split_counts(load.shapes)
        for name in (load.repository / "clouds" / f"modelnet40_{split}.txt").read_text().split()
    }
    states, found = Counter(), Counter()
    for path in (load.results / "skeletons").rglob("status.csv"):
        for row in read_status(path.parent):
            found[row.id] += 1
            states[_state(path.parent, row)] += 1
    states["lost"] = len(expected - found.keys())
    states["listed twice"] = sum(1 for count in found.values() if count > 1)
    return dict(states)


def _state(folder, row):
    if row.status != "ok":
        return "failed"
    try:
        return "complete" if len(read_skeleton(folder / f"{row.id}.ply")) else "unreadable"
    except (MorphoSkelError, OSError):
        return "unreadable"


def summarise(load, attempts):
    """Write and return the summary: what was run, on what, how it went, and which demands were missed."""
    shapes = check_shapes(load)
    memory = check_memory(pd.read_csv(load.folder / "memory.csv", keep_default_na=False), load)
    sent = [attempt for attempt in attempts if attempt.ended in ("SIGINT", "SIGKILL")]
    missed = [f"{row['series']}: grows by {row['mb_in_1000_shapes']:.2f} MB in 1,000 shapes, not {row['bound']} at most"
              for row in memory if (row["mb_in_1000_shapes"] or 0.0) > row["bound"]]  # fmt: skip
    missed += [f"{count} shapes {state}" for state, count in shapes.items() if count and state != "complete"]
    if shapes.get("complete", 0) != load.shapes:
        missed.append(f"{shapes.get('complete', 0)} shapes complete, {load.shapes} expected")
    missed += [f"{attempt.survivors} processes outlived {attempt.ended}" for attempt in sent if attempt.survivors]
    missed += [f"{name} was not tried" for name in ("SIGINT", "SIGKILL") if name not in {each.ended for each in sent}]
    if attempts[-1].ended != "finished":
        missed.append(f"the last attempt ended with exit code {attempts[-1].exit_code}, see run.log")
    provenance = collect_provenance()
    summary = {
        "date": provenance["date"],
        "commit": read_provenance(load.repository / COPIED_FROM)["commit"],
        "machine": provenance["machine"],
        "shapes": load.shapes,
        "shard_size": load.shard_size,
        "jobs": load.jobs,
        "states": shapes,
        "attempts": [vars(attempt) for attempt in attempts],
        "memory": memory,
        "missed": missed,
    }
    (load.folder / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
    return summary
