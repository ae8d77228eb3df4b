"""How long each rule of a run took, from the benchmark files of Snakemake."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

from morphoskel.errors import InputError


@dataclass(frozen=True)
class StageTime:
    """What the jobs of a rule took together.

    Parameters
    ----------
    rule
        Its name.
    jobs
        Number of jobs.
    seconds, longest
        Wall time of all jobs, which may have run side by side, and of the longest one.
    cpu_seconds
        Processor time; NaN if Snakemake measured none.
    memory
        Largest resident memory of a job in MB; NaN if Snakemake measured none.
    """

    rule: str
    jobs: int
    seconds: float
    longest: float
    cpu_seconds: float
    memory: float


def sum_benchmarks(folder: Path) -> list[StageTime]:
    """Sum up the benchmark files ``{rule}.tsv`` and ``{rule}/**/*.tsv`` in a folder.

    Parameters
    ----------
    folder
        May be absent.

    Returns
    -------
    list of StageTime
        The rule that took longest first.

    Raises
    ------
    InputError
        If a file is no benchmark.
    """
    jobs: dict[str, list[dict[str, float]]] = {}
    for path in sorted(folder.rglob("*.tsv")):
        rule = path.relative_to(folder).parts[0].removesuffix(".tsv")
        jobs.setdefault(rule, []).append(_read_benchmark(path))
    times = [_summed(rule, of_rule) for rule, of_rule in jobs.items()]
    return sorted(times, key=lambda time: (-time.seconds, time.rule))


def _summed(rule: str, jobs: list[dict[str, float]]) -> StageTime:
    # A job that is over before Snakemake first looks has no processor time and no memory.
    processor, memory = ([job[name] for job in jobs if not math.isnan(job[name])] for name in ("cpu_time", "max_rss"))
    return StageTime(
        rule,
        jobs=len(jobs),
        seconds=math.fsum(job["s"] for job in jobs),
        longest=max(job["s"] for job in jobs),
        cpu_seconds=math.fsum(processor) if processor else math.nan,
        memory=max(memory, default=math.nan),
    )


def _read_benchmark(path: Path) -> dict[str, float]:
    """Return seconds, processor seconds and memory of a job; NaN for what was not measured."""
    try:
        with path.open(encoding="utf-8", newline="") as stream:
            [row] = csv.DictReader(stream, delimiter="\t")
        values = {name: _number(row[name]) for name in ("s", "cpu_time", "max_rss")}
        if not values["s"] >= 0:
            raise ValueError(f"{row['s']} seconds")
    except (OSError, KeyError, TypeError, ValueError, csv.Error) as error:
        raise InputError(
            f"{path}: expected a benchmark of Snakemake, one row with the columns s, cpu_time and max_rss ({error}); "
            "remove the file, or run the job again"
        ) from error
    return values


def _number(text: str) -> float:
    return math.nan if text in ("NA", "-", "") else float(text)
