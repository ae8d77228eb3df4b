"""MS3D against the released computation: seconds and peak memory, in turn, each in a process of its own."""

import json
import logging
import os
import subprocess
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pandas as pd

from benchmarks.agreement import TOLERANCE, compare
from benchmarks.surfaces import REPOSITORY, prepare_surfaces
from morphoskel.precompile import precompile

logger = logging.getLogger(__name__)

CANDIDATES = 10_000_000
REPEATS = 3
"""Runs of each computation, in turn; the median counts."""


def measure(name, surface, mode, count, answer="-"):
    """Run a computation in a process of its own and return what it measured."""
    command = [sys.executable, "-m", "benchmarks.computations", name, str(surface), mode, str(count), str(answer)]
    done = subprocess.run(command, cwd=REPOSITORY, env=os.environ, check=True, capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def run(folder: Path) -> bool:
    """Write ``ms3d.csv`` and ``agreement.csv``; return whether all answers agree."""
    precompile()
    rows, agreements = [], []
    with tempfile.TemporaryDirectory() as scratch:
        surfaces = prepare_surfaces(Path(scratch))
        for name, surface in surfaces.items():
            for mode in ("grid", "random"):
                row, agreement = _compare(name, surface, mode, Path(scratch), REPEATS if name == "dragon" else 1)
                rows.append(row)
                agreements.append(agreement)
                pd.DataFrame(rows).to_csv(folder / "ms3d.csv", index=False, float_format="%.4g")
                pd.DataFrame(agreements).to_csv(folder / "agreement.csv", index=False)
                logger.info("%s", "  ".join(f"{key}={value}" for key, value in row.items()))
    frame = pd.DataFrame(agreements)
    return bool((frame["unexplained"] == 0).all() and (frame["largest_udf_difference"] <= TOLERANCE).all())


def _compare(name, surface, mode, scratch, repeats):
    answers = {which: scratch / f"{which}.npz" for which in ("released", "ours")}
    runs = {which: [] for which in answers}
    for number in range(repeats):
        for which, answer in answers.items():
            runs[which].append(measure(which, surface, mode, CANDIDATES, answer if number == 0 else "-"))
    agreement = compare(*(dict(np.load(answer, allow_pickle=False)) for answer in answers.values()))
    seconds = {which: float(np.median([run["seconds"] for run in found])) for which, found in runs.items()}
    row = {
        "mesh": name,
        "mode": mode,
        "candidates": CANDIDATES,
        "inside": runs["ours"][0]["inside"],
        "seconds_released": round(seconds["released"], 3),
        "seconds_ours": round(seconds["ours"], 3),
        "ratio": round(seconds["released"] / seconds["ours"], 2),
        "peak_mb_released": round(max(run["peak_mb"] for run in runs["released"])),
        "peak_mb_ours": round(max(run["peak_mb"] for run in runs["ours"])),
    }
    return row, {"mesh": name, "mode": mode, **asdict(agreement)}
