"""Seconds that the stages of MS3D take for more and more candidates in the same closed surface."""

from __future__ import annotations

import time
from collections.abc import Sequence
from itertools import pairwise, product
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.checksums import checked_file
from morphoskel.csv_frame import read_csv_frame, write_csv_frame
from morphoskel.errors import InputError
from morphoskel.morphology import dilation
from morphoskel.progress import track
from morphoskel.seeds import derive_seed
from morphoskel.shapes import Mesh
from morphoskel.volume import Candidates, SurfaceDistance, occupancy

if TYPE_CHECKING:
    import pandas as pd

SCALED_STAGES = ("occupancy", "udf", "dilation")
"""The stages that see every candidate; the selection after them takes milliseconds."""

SCALING_COLUMNS = ("candidates", "repeat", "stage", "seconds", "inside", "threads")
"""Columns of the measurements: `inside` is the number of candidates inside the surface."""


def measure_scaling(
    mesh: Mesh, counts: Sequence[int], *, k: int, seed: int, repeats: int, threads: int
) -> pd.DataFrame:
    """Time the stages for growing numbers of random candidates in the surface's bounding box.

    The smallest number is run once beforehand and dropped: it pays for imports and compilation. Then all numbers are
    run in turn, and again, so that a disturbance of the machine does not fall on one number alone.

    Parameters
    ----------
    mesh
        A closed surface.
    counts
        Numbers of candidates.
    k
        Size of the structuring element.
    seed
        The global seed; every repetition scatters other candidates.
    repeats
        Measurements of each number.
    threads
        Native threads.

    Returns
    -------
    pandas.DataFrame
        Columns :data:`SCALING_COLUMNS`, one row a number, repetition and stage.

    Raises
    ------
    InputError
        If there is no number, one is not positive or appears twice, or `repeats` is not positive.
    ShapeError
        If the surface is not closed, or none of the candidates is inside.
    """
    import pandas as pd

    _check(counts, repeats)
    _time_once(mesh, min(counts), k, derive_seed(seed, "scaling", "warm-up"), threads)
    rows: list[dict[str, object]] = []
    for repeat, count in track(list(product(range(repeats), sorted(counts))), "time stages", unit="measurement"):
        of_run = derive_seed(seed, "scaling", str(count), str(repeat))
        inside, seconds = _time_once(mesh, count, k, of_run, threads)
        rows += [
            {"candidates": count, "repeat": repeat, "stage": stage, "seconds": seconds[stage], "inside": inside,
             "threads": threads}
            for stage in SCALED_STAGES
        ]  # fmt: skip
    return pd.DataFrame(rows, columns=list(SCALING_COLUMNS))


def write_scaling(
    mesh: Mesh, path: Path, counts: Sequence[int], *, k: int, seed: int, repeats: int, threads: int
) -> None:
    """Measure a closed surface, and write the rows to the CSV file `path`.

    Parameters and errors are those of :func:`measure_scaling`.
    """
    frame = measure_scaling(mesh, counts, k=k, seed=seed, repeats=repeats, threads=threads)
    with checked_file(path) as partial:
        write_csv_frame(frame, partial)


def read_scaling(path: Path) -> pd.DataFrame:
    """Read what :func:`write_scaling` wrote.

    Raises
    ------
    InputError
        If the file is absent, has other columns or no row, or holds illegal numbers or stages.
    """
    types = {**dict.fromkeys(SCALING_COLUMNS, "int64"), "stage": "str", "seconds": "float64"}
    frame = read_csv_frame(path, SCALING_COLUMNS, exactly=True, dtype=types)
    problems = {
        f"unknown stage; expected one of {', '.join(SCALED_STAGES)}": ~frame["stage"].isin(SCALED_STAGES),
        "expected at least one candidate": ~(frame["candidates"] >= 1),
        "expected a positive number of seconds": ~frame["seconds"].between(0, float("inf"), inclusive="neither"),
        "a second time; expected one a number, repetition and stage": frame.duplicated(list(SCALING_COLUMNS[:3])),
    }
    for problem, concerned in problems.items():
        if concerned.any():
            raise InputError(f"{path}, line {int(concerned.to_numpy().argmax()) + 2}: {problem}")
    if frame.empty:
        raise InputError(f"{path}: expected at least one measurement, got none")
    return frame


def _time_once(mesh: Mesh, count: int, k: int, seed: int, threads: int) -> tuple[int, dict[str, float]]:
    """Return the number of candidates inside, and the seconds of each stage."""
    candidates = Candidates(*mesh.bounds, count, seed=seed)
    marks = [time.perf_counter()]
    inner = occupancy(mesh, candidates, threads=threads).inner_points(threads=threads)
    marks.append(time.perf_counter())
    udf = SurfaceDistance(mesh)(inner, threads=threads)
    marks.append(time.perf_counter())
    dilation(inner, udf, k, threads=threads)
    marks.append(time.perf_counter())
    seconds = [end - start for start, end in pairwise(marks)]
    return len(inner), dict(zip(SCALED_STAGES, seconds, strict=True))


def _check(counts: Sequence[int], repeats: int) -> None:
    """Raise unless there is something to measure."""
    if not counts or min(counts) < 1 or len(set(counts)) < len(counts):
        raise InputError(f"counts: expected different numbers of candidates, each at least 1, got {list(counts)}")
    if repeats < 1:
        raise InputError(f"repeats: expected at least 1, got {repeats}")
