"""How many cores this process may use, and how shapes share them."""

import os


def available_cores() -> int:
    """Return the number of cores that the scheduler grants this process, which may be fewer than the machine has."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def split_cores(cores: int, threads: int, shapes: int) -> tuple[int, int]:
    """Split the cores of a job between shapes and threads within a shape, so that their product is at most `cores`.

    Shapes side by side use cores best: some stages have one thread only. Threads within a shape save memory, and are
    all that is left where there are fewer shapes than cores.

    Parameters
    ----------
    cores
        Cores of the job.
    threads
        Threads wanted for each shape.
    shapes
        Shapes to process.

    Returns
    -------
    workers, threads
        Shapes side by side, and threads for each of them; both at least 1.
    """
    workers = max(min(cores // max(threads, 1), shapes), 1)
    return workers, max(cores // workers, 1)
