"""An estimate of the time that a run of many jobs still takes."""

from __future__ import annotations

from collections.abc import Mapping
from statistics import fmean

KNOWN_SHARE = 0.5
"""Of the jobs left, those of rules with a known duration. Below it there is no estimate: it would be a guess."""


class TimeLeft:
    """Weigh the jobs that are left by what jobs of their rules took.

    What a rule takes is the mean of its jobs in this run, else that in earlier runs, else that of a reference run on
    another machine, scaled by how long this run took for what both have done. A rule unknown to all of them counts as
    the mean of rules whose name begins with the same word (``figure_residue`` and ``figure_spheres``), else as the mean
    of all rules that are known.

    Times are seconds on any clock that runs evenly.

    Parameters
    ----------
    jobs
        Number of jobs of each rule.
    earlier
        Mean seconds of a job of each rule in earlier runs.
    reference
        The same of a run on another machine.
    """

    def __init__(
        self,
        jobs: Mapping[str, int],
        earlier: Mapping[str, float] | None = None,
        reference: Mapping[str, float] | None = None,
    ) -> None:
        self._waiting = dict(jobs)
        self._earlier = dict(earlier or {})
        self._reference = dict(reference or {})
        self._running: dict[int, tuple[str, float]] = {}
        self._measured: dict[str, list[float]] = {}
        self._began: float | None = None
        self._worked = 0.0

    def learn(self, earlier: Mapping[str, float], reference: Mapping[str, float] | None = None) -> None:
        """Add mean seconds of a job of each rule in earlier runs and in a reference run."""
        self._earlier.update(earlier)
        self._reference.update(reference or {})

    def start(self, job: int, rule: str, now: float) -> None:
        """Count a job as running."""
        self._began = now if self._began is None else self._began
        self._waiting[rule] = max(self._waiting.get(rule, 0) - 1, 0)
        self._running[job] = rule, now

    def finish(self, job: int, now: float, *, failed: bool = False) -> float:
        """Count a job as done, and return its seconds; those of a failed one say nothing on its rule."""
        rule, started = self._running.pop(job)
        seconds = now - started
        self._worked += seconds
        if not failed:
            self._measured.setdefault(rule, []).append(seconds)
        return seconds

    def seconds(self, now: float) -> float | None:
        """Return the estimate, or ``None`` while too little is known.

        The work left is divided by the number of jobs that ran side by side so far, on average; but it takes at least
        as long as the longest job that is left.
        """
        left = [(self._typical(rule), count) for rule, count in self._waiting.items() if count]
        left += [(self._rest(rule, now - started), 1) for rule, started in self._running.values()]
        total = sum(count for _, count in left)
        certain = sum(count for seconds, count in left if seconds is not None)
        if certain < KNOWN_SHARE * total:
            return None
        if not total:
            return 0.0
        others = self._of_all()
        weighed = [(others if seconds is None else seconds, count) for seconds, count in left]
        work = sum(seconds * count for seconds, count in weighed)
        return max(work / self._parallelism(now), max(seconds for seconds, _ in weighed))

    def _parallelism(self, now: float) -> float:
        """Return how many jobs ran side by side so far, on average."""
        worked = self._worked + sum(now - started for _, started in self._running.values())
        if self._began is None or now <= self._began or not worked:
            return max(len(self._running), 1)
        return worked / (now - self._began)

    def _rest(self, rule: str, elapsed: float) -> float | None:
        typical = self._typical(rule)
        return None if typical is None else max(typical - elapsed, 0.0)

    def _typical(self, rule: str) -> float | None:
        """Return what a job of a rule takes, or ``None`` if neither the rule nor one of its kind is known."""
        known = self._known()
        if rule in known:
            return known[rule]
        alike = [seconds for name, seconds in known.items() if name.split("_")[0] == rule.split("_")[0]]
        return fmean(alike) if alike else None

    def _of_all(self) -> float:
        """Return the mean of the rules that are known."""
        known = self._known()
        of_run = [seconds for rule, seconds in known.items() if rule in self._waiting]
        return fmean(of_run or known.values())

    def _known(self) -> dict[str, float]:
        measured = {rule: fmean(seconds) for rule, seconds in self._measured.items()}
        slowness = self._slowness()
        return {rule: slowness * seconds for rule, seconds in self._reference.items()} | self._earlier | measured

    def _slowness(self) -> float:
        """Return how many times as long as the reference this run took for the jobs that are done."""
        done = [(rule, seconds) for rule, seconds in self._measured.items() if self._reference.get(rule)]
        expected = sum(self._reference[rule] * len(seconds) for rule, seconds in done)
        return sum(sum(seconds) for _, seconds in done) / expected if expected else 1.0
