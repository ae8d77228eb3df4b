"""A line for every job of a run that starts or ends."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from morphoskel.durations import describe_roughly, describe_seconds
from morphoskel.run_progress.earlier_durations import earlier_durations, reference_durations
from morphoskel.run_progress.outcome import Job, describe_failures, describe_results
from morphoskel.run_progress.time_left import TimeLeft

_RUN = re.compile(r"results/([^/]+)/")


class JobLines:
    """Follow the jobs of one run and say what there is to say.

    Parameters
    ----------
    jobs
        Number of jobs of each rule.
    now
        The time at which the run began, in seconds on any clock that runs evenly, like all other times here.
    results
        Folder of all runs, where durations of earlier ones are looked up.
    """

    def __init__(self, jobs: Mapping[str, int], now: float, results: Path = Path("results")) -> None:
        self.total = sum(jobs.values())
        self.finished: list[Job] = []
        self._began = now
        self._results = results
        self._run: str | None = None
        self._left = TimeLeft(jobs)
        self._running: dict[int, Job] = {}
        self._failed: dict[int, Job] = {}

    def start(self, number: int, job: Job, now: float) -> str:
        """Return the line for a job that starts; a failed job that is tried again counts as not failed."""
        self._failed.pop(number, None)
        self._learn(job)
        self._running[number] = job
        self._left.start(number, job.rule, now)
        return f"{self._count()} started {job}"

    def is_running(self, number: int) -> bool:
        """Tell whether a job has started and not ended yet."""
        return number in self._running

    def finish(self, number: int, now: float) -> str:
        """Return the line for a job that has ended well.

        Raises
        ------
        KeyError
            If no such job runs.
        """
        job = self._running.pop(number)
        took = describe_seconds(self._left.finish(number, now))
        self.finished.append(job)
        left = self._left.seconds(now)
        parts = [
            f"{self._count()} {100 * len(self.finished) // max(self.total, 1)} %",
            describe_seconds(now - self._began),
            *([f"{describe_roughly(left)} left"] if left and len(self.finished) < self.total else []),
            f"{job} took {took}",
        ]
        return " · ".join(parts)

    def fail(self, number: int, now: float) -> str:
        """Return the line for a job that has failed.

        Raises
        ------
        KeyError
            If no such job runs.
        """
        job = self._failed[number] = self._running.pop(number)
        took = describe_seconds(self._left.finish(number, now, failed=True))
        return f"{self._count()} FAILED {job} after {took}"

    def end(self, command: str = "") -> list[str]:
        """Return what came of the run; `command` is what the user started it with, if that is known."""
        failures = describe_failures(list(self._failed.values()), len(self.finished), self.total, command)
        return [*describe_results(self.finished), *failures]

    def _count(self) -> str:
        return f"[{len(self.finished):{len(str(self.total))}}/{self.total}]"

    def _learn(self, job: Job) -> None:
        """Look up durations as soon as a path tells which run this is."""
        found = next((found for path in (*job.outputs, *job.logs) if (found := _RUN.match(path))), None)
        if self._run is None and found:
            self._run = found[1]
            self._left.learn(earlier_durations(self._results, self._run), reference_durations(self._results))
