"""Run the chain to its end, interrupted twice, and write down the memory of its processes."""

import csv
import logging
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import psutil

from morphoskel.run_provenance import write_provenance
from tests.load.clouds import split_counts, write_clouds
from tests.load.processes import snapshot, survivors

logger = logging.getLogger(__name__)

REPOSITORY = Path(__file__).resolve().parents[2]
STAGES = 6
INTERVAL = 1.0
"""Seconds between two looks at the processes."""

INTERRUPTS = ((0.10, signal.SIGINT), (0.25, signal.SIGKILL))
"""The share of the jobs after which the whole process group gets which signal; SIGINT is what Ctrl-C sends."""

PATIENCE = 120.0
"""Seconds that the processes of a run have to end after a signal."""

COPIED_FROM = "copied_from.json"
"""The provenance of the code that runs, in its folder: the repository may go on meanwhile."""

MEMORY_COLUMNS = ("seconds", "attempt", "jobs", "role", "stage", "pid", "megabytes")


@dataclass(frozen=True)
class Load:
    """What is run, and where everything of it lies."""

    folder: Path
    shapes: int
    shard_size: int

    @property
    def repository(self):
        return self.folder / "repository"

    @property
    def results(self):
        return self.repository / "results" / "load"

    @property
    def jobs(self):
        """The number of jobs of the chain."""
        return STAGES * sum(-(-count // self.shard_size) for count in split_counts(self.shapes).values())

    def finished_jobs(self):
        return sum(1 for _ in (self.results / "benchmarks").rglob("*.tsv"))

    def command(self):
        overrides = {
            "run": "load",
            "dataset": "modelnet40",
            "dataset.root": "clouds",
            "surface": "[poisson]",
            "surface.poisson.depth": 5,
            "watertight.resolution": 200,
            "skeleton": "[ms3d]",
            "skeleton.selection": "[residue]",
            "skeleton.candidates.count": 5000,
            "skeleton.points": 64,
            "medial_axis.surface": "poisson",
            "sampler": "[]",
            "shard_size": self.shard_size,
            "cores": 1,
            "keep_intermediates": "false",
        }
        words = [f"{key}={value}" for key, value in overrides.items()]
        return [sys.executable, "-m", "morphoskel.cli", "run", "skeletons", *words, "--", "--quiet", "rules"]


@dataclass(frozen=True)
class Attempt:
    """One start of the run: how long it went, how it ended, and how many jobs were finished by then."""

    attempt: int
    ended: str
    exit_code: int
    seconds: float
    jobs: int
    seconds_to_end: float
    survivors: int


def prepare(load):
    """Copy the repository, so that it can be worked on during the hour, and write the clouds."""
    if not load.repository.exists():
        partial = load.folder / "repository.partial"
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        for name in ("workflow", "config", "profiles", "src"):
            shutil.copytree(REPOSITORY / name, partial / name, ignore=shutil.ignore_patterns("*.pyc"))
        for name in ("Snakefile", "environment.yml"):
            shutil.copy2(REPOSITORY / name, partial)
        write_provenance(partial / COPIED_FROM)
        partial.rename(load.repository)
    if not (load.repository / "clouds").exists():
        logger.info("writing %d clouds", load.shapes)
        write_clouds(load.repository / "clouds", load.shapes)


def run_to_end(load):
    """Start the run, interrupt it, start it again, until it ends by itself; return all attempts, earlier ones too."""
    attempts = read_attempts(load)
    while not attempts or attempts[-1].ended != "finished":
        sent = {attempt.ended for attempt in attempts}
        waiting = [(share, number) for share, number in INTERRUPTS if number.name not in sent]
        attempt = _attempt(load, len(attempts) + 1, waiting[0] if waiting else None)
        logger.info("attempt %d: %s after %.0f s, %d of %d jobs", attempt.attempt, attempt.ended, attempt.seconds,
                    attempt.jobs, load.jobs)  # fmt: skip
        attempts.append(attempt)
        _append(load.folder / "attempts.csv", [field.name for field in fields(Attempt)], [asdict(attempt).values()])
        if attempt.ended == "failed":
            break
    return attempts


def read_attempts(load):
    """Return the attempts so far."""
    path = load.folder / "attempts.csv"
    if not path.exists():
        return []
    with path.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    kinds = {"attempt": int, "exit_code": int, "jobs": int, "survivors": int, "seconds": float, "seconds_to_end": float}
    return [Attempt(**{key: kinds.get(key, str)(value) for key, value in row.items()}) for row in rows]


def _attempt(load, number, interrupt):
    """Run until the end or the interrupt, if there is one, and look at the processes meanwhile."""
    environment = {**os.environ, "PYTHONPATH": str(load.repository / "src")}
    start, seen, ended, to_end = time.monotonic(), {}, "", 0.0
    with (load.folder / "run.log").open("a") as log:
        run = subprocess.Popen(
            load.command(), cwd=load.repository, env=environment, stdout=log, stderr=log, start_new_session=True
        )
        try:
            root = psutil.Process(run.pid)
            while run.poll() is None:
                jobs = load.finished_jobs()
                _look(load, root, (time.monotonic() - start, number, jobs), seen)
                if interrupt and jobs >= interrupt[0] * load.jobs:
                    ended = interrupt[1].name
                    os.killpg(run.pid, interrupt[1])
                    signalled = time.monotonic()
                    run.wait(PATIENCE)
                    break
                time.sleep(INTERVAL)
            left = survivors(seen.values(), PATIENCE)
            to_end = time.monotonic() - signalled if ended else 0.0
        finally:
            with suppress(ProcessLookupError):
                os.killpg(run.pid, signal.SIGKILL)
    ended = ended or ("finished" if run.returncode == 0 else "failed")
    return Attempt(number, ended, run.wait(), round(time.monotonic() - start, 1), load.finished_jobs(),
                   round(to_end, 1), len(left))  # fmt: skip


def _look(load, root, when, seen):
    rows = snapshot(root)
    for _, _, pid, _ in rows:
        if pid not in seen:
            with suppress(psutil.NoSuchProcess):
                seen[pid] = psutil.Process(pid)
    seconds, attempt, jobs = when
    _append(
        load.folder / "memory.csv",
        MEMORY_COLUMNS,
        [
            (f"{seconds:.1f}", attempt, jobs, role, stage, pid, f"{megabytes:.1f}")
            for role, stage, pid, megabytes in rows
        ],
    )


def _append(path, columns, rows):
    new = not path.exists()
    with path.open("a", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        if new:
            writer.writerow(columns)
        writer.writerows(rows)
