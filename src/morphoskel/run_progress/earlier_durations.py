"""What jobs took in earlier runs, from the benchmark files of the workflow, and in the run that the repository records.

``python -m morphoskel.run_progress.earlier_durations`` records those of ``results/demo`` anew.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice
from pathlib import Path
from statistics import fmean

from morphoskel.atomic import atomic_file

MOST_FILES = 50
"""Files read of a rule and run: enough for a mean, and quick where there are thousands."""

REFERENCE = Path("reference") / "durations.csv"
"""In the folder of all runs: what jobs of the demo took, for the first run on a machine."""


def earlier_durations(results: Path, run: str) -> dict[str, float]:
    """Return the mean seconds of a job of each rule.

    Parameters
    ----------
    results
        Folder of all runs, with ``{run}/benchmarks/{rule}.tsv`` or ``{run}/benchmarks/{rule}/**/*.tsv``.
    run
        The name of the run that asks. Where it has files of a rule, other runs, whose settings are others, do not
        count; else they count alike.

    Returns
    -------
    dict
        Of the rules that have a file which can be read.
    """
    own = _of_run(results / run / "benchmarks")
    others: dict[str, list[float]] = {}
    for folder in sorted(results.glob("*/benchmarks")):
        for rule, seconds in _of_run(folder).items():
            others.setdefault(rule, []).append(seconds)
    return {rule: fmean(seconds) for rule, seconds in others.items()} | own


def reference_durations(results: Path) -> dict[str, float]:
    """Return the mean seconds of a job of each rule in the demo, as recorded in the repository.

    Empty where there is no record, or none that can be read: an estimate can do without.
    """
    try:
        rows = (results / REFERENCE).read_text(encoding="utf-8").splitlines()[1:]
        return {rule: float(seconds) for rule, seconds in (row.split(",") for row in rows)}
    except (OSError, ValueError):
        return {}


def record_reference(results: Path, run: str) -> None:
    """Replace the record by what jobs of a run took."""
    rows = [f"{rule},{seconds:.2f}\n" for rule, seconds in sorted(_of_run(results / run / "benchmarks").items())]
    with atomic_file(results / REFERENCE) as partial:
        partial.write_text("rule,seconds\n" + "".join(rows), encoding="utf-8")


def _of_run(folder: Path) -> dict[str, float]:
    """Return the mean seconds of a job of each rule of one run."""
    if not folder.is_dir():
        return {}
    means = {}
    for entry in sorted(folder.iterdir()):
        files: Iterable[Path] = islice(entry.rglob("*.tsv"), MOST_FILES) if entry.is_dir() else [entry]
        found = [seconds for file in files if (seconds := _read(file)) is not None]
        if found:
            means[entry.name.removesuffix(".tsv")] = fmean(found)
    return means


def _read(path: Path) -> float | None:
    """Return the seconds in a benchmark file, or ``None`` if it is damaged: an estimate can do without."""
    try:
        header, first, *_ = path.read_text(encoding="utf-8").splitlines()
        return float(first.split("\t")[header.split("\t").index("s")])
    except (OSError, ValueError, IndexError):
        return None


if __name__ == "__main__":
    record_reference(Path("results"), "demo")
