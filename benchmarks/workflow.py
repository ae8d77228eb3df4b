"""What the workflow costs beside the work: start-up of its jobs, and planning."""

import hashlib
import json
import logging
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pandas as pd

from benchmarks.surfaces import REPOSITORY

logger = logging.getLogger(__name__)

SHAPES_A_CATEGORY = 8
CHAIN = [
    "experiment=demo",
    "surface=[poisson]",
    "skeleton.candidates.count=1000000",
    "dataset.name=synthetic_bench",
    f"dataset.per_category={{train: 1, test: {SHAPES_A_CATEGORY}}}",
]
DRY_RUNS = {
    "dry run: all tables, 1184 shapes": ("all", ["experiment=paper"]),
    "dry run: skeletons of Point2Skeleton, 7088 shapes, 3 surfaces": ("skeletons", ["experiment=paper"]),
    "dry run: skeletons of ModelNet40, 12311 shapes": (
        "skeletons",
        ["experiment=paper", "dataset=modelnet40", "surface=[poisson]"],
    ),
}


def run(folder: Path) -> bool:
    """Write ``workflow.csv``; return whether both ways gave the same skeletons."""
    rows, same = [], True
    with tempfile.TemporaryDirectory() as scratch:
        same = _chain(rows, Path(scratch))
        for what, (target, overrides) in DRY_RUNS.items():
            rows.append({"what": what, "seconds": _snakemake(Path(scratch), target, overrides, "--dry-run")})
    frame = pd.DataFrame(rows)
    frame.to_csv(folder / "workflow.csv", index=False, float_format="%.4g")
    for row in rows:
        logger.info("%-65s %s", row["what"], {key: value for key, value in row.items() if key != "what"})
    return same


def _chain(rows, scratch):
    """Time 64 shapes in one process and through Snakemake, in turn, and compare the skeletons."""
    shapes = 8 * SHAPES_A_CATEGORY
    manifest = "resources/manifest/synthetic_bench.csv"
    skeletons = Path("results/demo/skeletons/synthetic_bench/test/poisson/00000")
    _snakemake(scratch, manifest, CHAIN)
    single = scratch / "single"
    single.mkdir()
    call = "import sys; from benchmarks.chain import main; main(sys.argv[1:])"  # workers import the module by its name
    command = [sys.executable, "-c", call, str(scratch / manifest), str(single), *CHAIN]
    start = time.perf_counter()
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY)}
    subprocess.run(command, cwd=scratch, env=environment, check=True, stdout=subprocess.DEVNULL)
    alone = time.perf_counter() - start
    through = _snakemake(scratch, str(skeletons), CHAIN)
    rows.append({"what": f"chain of {shapes} shapes, 1e6 candidates: one process pool", "seconds": alone})
    rows.append(
        {"what": f"chain of {shapes} shapes, 1e6 candidates: Snakemake", "seconds": through, "ratio": through / alone}
    )
    return _digest(single) == _digest(scratch / skeletons)


def _snakemake(folder, target, overrides, *options):
    """Run the workflow in `folder` and return the seconds from start to end."""
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(REPOSITORY / "Snakefile"), "--cores", "2"]
    command += ["--directory", str(folder), target, *options, "--quiet", "all"]
    command += ["--workflow-profile", str(REPOSITORY / "profiles" / "default")]
    command += ["--config", f"overrides={json.dumps(overrides)}"]
    start = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stdout}\n{done.stderr}")
    return time.perf_counter() - start


def _digest(folder):
    return [hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.glob("*.ply"))]
