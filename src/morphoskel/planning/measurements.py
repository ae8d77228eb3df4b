"""What the jobs of a finished run took and wrote."""

from __future__ import annotations

import csv
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import yaml

from morphoskel.atomic import atomic_file
from morphoskel.chain.status import read_status
from morphoskel.csv_lines import QUOTED_ENDS, LineFeeds
from morphoskel.errors import InputError
from morphoskel.planning.extent import Extent
from morphoskel.planning.work import WORK, Work, fingerprint


@dataclass(frozen=True)
class Measured:
    """All jobs of a run that are comparable with each other.

    Parameters
    ----------
    rule
        Their rule.
    kind
        The value of the wildcard by which the rule is measured apart; empty if there is none.
    settings
        What a planned job must agree in, see :func:`morphoskel.planning.work.fingerprint`.
    jobs
        How many.
    held
        Core-seconds that the jobs held: their seconds times their cores, whether these were at work or waiting. Too
        large if other work was on the machine.
    worked
        Core-seconds of the processor. Too small for short jobs: Snakemake looks at their processes now and then only.
    amount
        Of work, in the rule's unit.
    size, files, shapes
        Bytes and number of files that they wrote, and of how many shapes; 0 shapes if nothing is left of it.
    written_amount
        The amount of work of the jobs whose files are still there.
    source
        The run.
    """

    rule: str
    kind: str
    settings: str
    jobs: int
    held: float
    worked: float
    amount: float
    size: int
    files: int
    shapes: int
    written_amount: float
    source: str


def measure_run(folder: Path) -> list[Measured]:
    """Read the benchmarks of a run, and the size of what it wrote.

    Parameters
    ----------
    folder
        ``results/{run}``, with ``config.yaml`` and ``benchmarks``.

    Returns
    -------
    list of Measured
        Benchmarks of which the number of shapes is not known, or whose name tells another layout, are left out.

    Raises
    ------
    InputError
        If the folder is not of a run.
    """
    path = folder / "config.yaml"
    if not path.is_file() or not (folder / "benchmarks").is_dir():
        raise InputError(
            f"{folder}: holds no config.yaml and benchmarks; name the folder of a finished run, as results/demo"
        )
    config = yaml.safe_load(path.read_text(encoding="utf-8"))
    extent = Extent(config, count_run(folder, config))
    groups: dict[tuple[str, str, str], list[tuple[float, float, float, int, int, int]]] = defaultdict(list)
    for rule, work in WORK.items():
        for wildcards, seconds, worked in _benchmarks(folder, rule, work):
            try:
                amount = work.amount(extent, wildcards)
            except (InputError, KeyError, TypeError):
                continue  # of a data set or a method that the configuration no longer names
            if amount <= 0:
                continue
            cores = int(extent.setting(work.threads, {}) or 1) if work.threads else 1
            size, files = _written(folder, work, wildcards)
            shapes = extent.shapes(wildcards) if files else 0
            key = (rule, wildcards.get(work.by, ""), fingerprint(work, extent, wildcards))
            groups[key].append((seconds * cores, worked, amount, size, files, shapes))
    return [_together(key, rows, folder.name) for key, rows in groups.items()]


def _together(key: tuple[str, str, str], rows: list[tuple[float, float, float, int, int, int]], run: str) -> Measured:
    held, worked, amount, size, files, shapes = (sum(column) for column in zip(*rows, strict=True))
    written = sum(row[2] for row in rows if row[4])
    return Measured(*key, len(rows), held, worked, amount, int(size), int(files), int(shapes), written, run)


def count_run(folder: Path, config: Mapping[str, Any]) -> dict[str, dict[str, int]]:
    """Return the number of shapes of each data set and split that a run worked on, as its shards list them."""
    shards: dict[tuple[str, str], dict[str, int]] = defaultdict(dict)
    for kind, depth in (("surfaces", 4), ("skeletons", 5)):
        for path in (folder / kind).glob("/".join(["*"] * depth + ["status.csv"])):
            parts = path.relative_to(folder / kind).parts
            shards[parts[0], parts[1]][parts[-2]] = len(read_status(path.parent))
    counts: dict[str, dict[str, int]] = defaultdict(dict)
    for section in (config.get("dataset"), config.get("parts")):
        if section and section["kind"] == "synthetic" and section["categories"]:
            categories = len(section["categories"])
            counts[section["name"]] = {split: count * categories for split, count in section["per_category"].items()}
    for (dataset, split), sizes in shards.items():
        counts[dataset][split] = sum(sizes.values())
    return dict(counts)


def write_measurements(path: Path, measurements: Sequence[Measured]) -> None:
    """Write measurements as CSV, so that plans can be made without the run that they are of."""
    with atomic_file(path) as partial, partial.open("w", newline="") as stream:
        writer = csv.DictWriter(LineFeeds(stream), [each.name for each in fields(Measured)], lineterminator=QUOTED_ENDS)
        writer.writeheader()
        for measured in measurements:
            values = asdict(measured)
            writer.writerow(
                {key: f"{value:.6g}" if isinstance(value, float) else value for key, value in values.items()}
            )


def read_measurements(path: Path) -> list[Measured]:
    """Read the file of :func:`write_measurements`.

    Raises
    ------
    InputError
        If it is no such file.
    """
    kinds = {"jobs": int, "size": int, "files": int, "shapes": int,
             "held": float, "worked": float, "amount": float, "written_amount": float}  # fmt: skip
    try:
        with path.open(newline="") as stream:
            rows = [{key: kinds.get(key, str)(value) for key, value in row.items()} for row in csv.DictReader(stream)]
        return [Measured(**row) for row in rows]
    except (OSError, TypeError, ValueError) as error:
        raise InputError(
            f"{path}: expected measurements that `morphoskel plan --save` wrote ({error}); name such a file, or the "
            "folder of a run"
        ) from error


def _benchmarks(folder: Path, rule: str, work: Work) -> Iterator[tuple[dict[str, str], float, float]]:
    """Yield the wildcards, the seconds and the seconds of the processor of each benchmark of a rule."""
    root = folder / "benchmarks"
    if not work.layout:
        paths = [root / f"{rule}.tsv"]
        pattern = re.compile(re.escape(rule))
    else:
        paths = sorted((root / rule).rglob("*.tsv"))
        groups = re.sub(r"\\{(\w+)\\}", r"(?P<\1>[^/]+?)", re.escape(work.layout))
        ratio = "(?:/all|/(?P<ratio>[0-9]+)/(?P<seed>[0-9]+))" if rule == "train_sampler" else ""
        pattern = re.compile(f"{re.escape(rule)}/{groups}{ratio}")
    for path in paths:
        found = pattern.fullmatch(path.relative_to(root).with_suffix("").as_posix())
        if found and path.is_file():
            wildcards = {name: value for name, value in found.groupdict().items() if value is not None}
            with path.open(newline="") as stream:
                [row] = csv.DictReader(stream, delimiter="\t")
            yield wildcards, float(row["s"]), _number(row["cpu_time"])


def _written(folder: Path, work: Work, wildcards: Mapping[str, str]) -> tuple[int, int]:
    """Return bytes and number of the files that a job wrote and that are still there."""
    if not work.output:
        return 0, 0
    path = folder / work.output.format(**wildcards)
    files = [path] if path.is_file() else [each for each in path.rglob("*") if each.is_file()]
    return sum(each.stat().st_size for each in files), len(files)


def _number(text: str) -> float:
    """Return the number, or 0 of a job so short that Snakemake could not look at it."""
    try:
        return float(text)
    except ValueError:
        return 0.0
