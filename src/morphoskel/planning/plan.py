"""Plan an experiment: its jobs, and what they will cost."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from morphoskel.config import Config, compose
from morphoskel.datasets.configured import count_shapes
from morphoskel.errors import InputError
from morphoskel.planning.estimate import estimate
from morphoskel.planning.extent import Extent
from morphoskel.planning.jobs import plan_jobs
from morphoskel.planning.measurements import Measured, measure_run, read_measurements
from morphoskel.planning.plan_table import plan_values

REFERENCE = Path("results") / "reference" / "plan" / "measurements.csv"
"""Measurements that come with the repository."""


def plan_experiment(
    repository: Path,
    targets: Sequence[str],
    overrides: Sequence[str],
    *,
    measured: Sequence[Path] = (),
    at_once: Sequence[int] = (1,),
    cores: int | None = None,
) -> dict[str, Any]:
    """Return what :func:`morphoskel.planning.plan_table.plan_values` tells of an experiment.

    Parameters
    ----------
    repository
        The clone with the workflow.
    targets, overrides
        As ``morphoskel run`` takes them.
    measured
        Runs, or files with measurements; by default those of :func:`default_measurements`.
    at_once
        Numbers of jobs at a time, for the wall time.
    cores
        Of a machine; by default as many as the largest job asks for.

    Raises
    ------
    InputError
        If there are no measurements.
    """
    config = compose(overrides, repository / "config")
    sources = list(measured) or [default_measurements(repository)]
    measurements = [each for source in sources for each in read_source(source)]
    jobs = plan_jobs(repository, targets, overrides, cores=cores or max(config.cores, config.trainer.threads))
    plan = estimate(jobs, planned_extent(config, repository), measurements)
    return plan_values(jobs, plan, at_once)


def planned_extent(config: Config, repository: Path) -> Extent:
    """Return the extent of a configuration; shapes on disk are counted, absent ones are as many as were published."""
    values = config.model_dump(mode="json")
    counts = {}
    for section in (values["dataset"], values["parts"]):
        if section:
            located = {**section, "root": str(repository / section["root"])}
            counts[section["name"]] = count_shapes(located, seed=config.seed)
    return Extent(values, counts)


def read_source(path: Path) -> list[Measured]:
    """Return the measurements of a run's folder or of a file."""
    return measure_run(path) if path.is_dir() else read_measurements(path)


def default_measurements(repository: Path) -> Path:
    """Return the newest run that has written a table, other than the smoke run; else the file that the repository has.

    Raises
    ------
    InputError
        If there is neither.
    """
    runs = [
        path.parent
        for path in (repository / "results").glob("*/config.yaml")
        if path.parent.name != "smoke" and any((path.parent / "tables").glob("*.csv"))
    ]
    if runs:
        return max(runs, key=lambda run: max(table.stat().st_mtime for table in (run / "tables").glob("*.csv")))
    if (repository / REFERENCE).is_file():
        return repository / REFERENCE
    raise InputError(
        f"{repository / 'results'}: no finished run to take times from; run `morphoskel run` first, or name a run with "
        "--measured"
    )
