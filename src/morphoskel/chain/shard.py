"""Run one stage on every shape of a shard."""

from __future__ import annotations

import functools
import importlib
import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from morphoskel.atomic import atomic_folder
from morphoskel.chain.status import Status, read_status, write_status
from morphoskel.chain.task import Details, Task
from morphoskel.cores import split_cores
from morphoskel.datasets.manifest import ShapeRecord, read_manifest
from morphoskel.errors import StorageError
from morphoskel.pool import Outcome, run_isolated
from morphoskel.progress import track
from morphoskel.seeds import derive_seed

logger = logging.getLogger(__name__)


def run_shard(
    stage: str,
    *,
    manifest: Path,
    split: str,
    shard: int,
    inputs: Mapping[str, Path],
    output: Path,
    settings: Mapping[str, Any],
    seed: int,
    cores: int,
    threads: int = 1,
    log: str = "",
) -> list[Status]:
    """Run `stage` on the shapes of a shard, side by side, and write one file a shape and ``status.csv``.

    A shape that failed at an earlier stage is not tried again; its row is carried on. A shape that fails here is
    retried once, alone, and then recorded as failed: the others are not affected. A full disk or a damaged file of an
    earlier stage is no failure of the shape, and fails the whole job: nothing is recorded, and a rerun tries again.

    Parameters
    ----------
    stage
        The name of a rule, and a module of this package with a function ``run(task) -> Details``.
        It may name ``HEAVY_IMPORTS``, libraries that are imported once and shared by all workers of the job.
    manifest
        The data set's manifest.
    split, shard
        Which shapes.
    inputs
        Folders of the earlier stages, by name.
    output
        Folder to make; appears only when complete.
    settings
        Configuration sections of the stage.
    seed
        The global seed.
    cores
        Cores of the job.
    threads
        Threads for each shape, see :func:`morphoskel.cores.split_cores`.
    log
        Where the job logs; noted in the status of each shape.

    Returns
    -------
    list of Status
        One a shape.

    Raises
    ------
    StorageError
        If a file of an earlier stage is damaged, or one of this stage cannot be written.
    """
    records = {record.id: record for record in read_manifest(manifest, split=split, shard=shard)}
    earlier = [row for folder in inputs.values() for row in read_status(folder)]
    rows = {row.id: row for row in earlier if row.status == "failed"}
    before: dict[str, float] = {}
    for row in earlier:  # each stage counts those before it, so the last one counts them all
        before[row.id] = max(before.get(row.id, 0.0), row.seconds_so_far)
    module = importlib.import_module(f"morphoskel.chain.{stage}")
    preload = [module.__name__, *getattr(module, "HEAVY_IMPORTS", ())]
    with atomic_folder(output) as folder:
        waiting = [record for record in records.values() if record.id not in rows]
        workers, threads = split_cores(cores, threads, len(waiting))
        tasks = {
            record.id: Task(record, inputs, folder, settings, derive_seed(seed, record.id, stage), threads)
            for record in waiting
        }
        work = functools.partial(_run_stage, stage)
        outcomes = run_isolated(work, tasks, workers=workers, preload=preload)
        for outcome in track(outcomes, stage, total=len(tasks)):
            rows[outcome.key] = _status(records[outcome.key], stage, outcome, before.get(outcome.key, 0.0), log)
            if outcome.reason:
                _remove_files(folder, outcome.key)
            logger.info("%d/%d %s", len(rows), len(records), _describe(rows[outcome.key]))
        write_status(folder, rows.values())
    return list(rows.values())


def _run_stage(stage: str, task: Task) -> Details:
    """Run a stage on a shape, and tell what the disk refuses from what the shape is to blame for."""
    try:
        details: Details = importlib.import_module(f"morphoskel.chain.{stage}").run(task)
    except StorageError as error:
        raise StorageError(f"{task.record.id} at {stage}: {error}") from error
    except OSError as error:  # what a user's file does is an InputError already
        raise StorageError(
            f"{task.record.id} at {stage}: a file in {task.output} cannot be written ({error}); "
            "check that the disk is writable and has space left, then run again"
        ) from error
    return details


def _remove_files(folder: Path, shape: str) -> None:
    """Remove what a shape left that died while its file was written."""
    for path in folder.iterdir():
        if Path(path.name.removesuffix(".partial")).stem == shape:
            path.unlink()


def _status(record: ShapeRecord, stage: str, outcome: Outcome[Details], before: float, log: str) -> Status:
    details = ";".join(f"{name}={value}" for name, value in (outcome.result or {}).items())
    status = "failed" if outcome.reason else "ok"
    return Status(
        id=record.id,
        category=record.category,
        status=status,
        stage=stage,
        reason=outcome.reason,
        attempts=outcome.attempts,
        seconds=outcome.seconds,
        seconds_so_far=before + outcome.seconds,
        details=details,
        log=log,
    )


def _describe(row: Status) -> str:
    if row.status == "failed":
        return f"{row.id}: FAILED at {row.stage} after {row.attempts} attempts: {row.reason}"
    return f"{row.id}: {row.seconds:.2f} s {row.details}"
