"""How long jobs take that run several at a time and wait for each other."""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from morphoskel.planning.jobs import Job


def wall_seconds(jobs: Sequence[Job], seconds: Sequence[float], *, at_once: int) -> float:
    """Return the seconds until the last job ends, when a free place always takes the first job that waits for nothing.

    Parameters
    ----------
    jobs
        With inputs and outputs, by which they wait for each other.
    seconds
        Of each job.
    at_once
        Most jobs that run at a time.

    Returns
    -------
    float
        Without queueing and without the start of Snakemake.
    """
    maker = {path: index for index, job in enumerate(jobs) for path in job.outputs}
    waits_for = [{maker[path] for path in job.inputs if path in maker} for job in jobs]
    followers: list[list[int]] = [[] for _ in jobs]
    for index, needed in enumerate(waits_for):
        for other in needed:
            followers[other].append(index)
    open_needs = [len(needed) for needed in waits_for]
    ready = [index for index, count in enumerate(open_needs) if count == 0]
    heapq.heapify(ready)
    running: list[tuple[float, int]] = []
    now = 0.0
    while ready or running:
        while ready and len(running) < at_once:
            index = heapq.heappop(ready)
            heapq.heappush(running, (now + seconds[index], index))
        now, done = heapq.heappop(running)
        for follower in followers[done]:
            open_needs[follower] -= 1
            if open_needs[follower] == 0:
                heapq.heappush(ready, follower)
    return now
