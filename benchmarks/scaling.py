"""How seconds and memory grow with the number of candidates."""

import logging
import tempfile
from pathlib import Path

import pandas as pd

from benchmarks.ms3d import measure
from benchmarks.surfaces import prepare_surfaces

logger = logging.getLogger(__name__)

COUNTS = [10**5, 3 * 10**5, 10**6, 3 * 10**6, 10**7, 3 * 10**7, 10**8]


def run(folder: Path) -> bool:
    """Write ``scaling.csv`` and ``scaling.png``; return whether cost grows at most linearly from a million on."""
    with tempfile.TemporaryDirectory() as scratch:
        name, surface = next(iter(prepare_surfaces(Path(scratch)).items()))
        rows = []
        for mode in ("grid", "random"):
            for count in COUNTS:
                row = {"mesh": name, "mode": mode, "candidates": count, **measure("ours", surface, mode, count)}
                row["us_per_candidate"] = 1e6 * row["seconds"] / count
                rows.append(row)
                logger.info("%s", "  ".join(f"{key}={value}" for key, value in row.items()))
    frame = pd.DataFrame(rows)
    frame.to_csv(folder / "scaling.csv", index=False, float_format="%.5g")
    _draw(frame, folder / "scaling.png")
    costs = frame[frame["candidates"] >= 10**6].pivot_table("us_per_candidate", "candidates", "mode")
    return bool((costs.loc[10**8] <= costs.loc[10**6]).all())


def _draw(frame, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for mode, rows in frame.groupby("mode"):
        axes[0].loglog(rows["candidates"], rows["seconds"], marker="o", label=mode)
        axes[1].loglog(rows["candidates"], rows["peak_mb"], marker="o", label=mode)
    counts = frame["candidates"].unique()
    line = frame["seconds"].max() * counts / counts.max()
    axes[0].loglog(counts, line, color="0.6", linestyle=":", label="proportional")
    for axis, label in zip(axes, ("seconds, 2 cores", "peak memory, MB"), strict=True):
        axis.set(xlabel="candidates in the box", ylabel=label)
        axis.grid(True, which="major", color="0.9")
        axis.legend(frameon=False)
    figure.suptitle(f"MS3D without surface reconstruction ({frame['mesh'].iloc[0]})", fontsize=10)
    figure.savefig(path, dpi=150)
