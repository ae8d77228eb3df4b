"""The jobs of an experiment, as Snakemake plans them without running any."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from morphoskel.errors import MorphoSkelError
from morphoskel.workflow_run import snakemake_command

PLUGINS = Path("workflow") / "plugins"
"""Folder of the logger through which Snakemake tells its jobs, in the repository."""


@dataclass(frozen=True)
class Job:
    """One planned job.

    Parameters
    ----------
    rule
        Its name.
    wildcards
        Their values by name.
    threads
        Cores that it holds.
    gpus
        Graphics cards that it holds.
    inputs, outputs
        Paths, relative to the repository.
    """

    rule: str
    wildcards: Mapping[str, str]
    threads: int
    gpus: int
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


def plan_jobs(repository: Path, targets: Sequence[str], overrides: Sequence[str], *, cores: int) -> list[Job]:
    """Return every job that builds `targets` from nothing, whatever is finished already.

    Parameters
    ----------
    repository
        The clone with the workflow.
    targets
        Names of rules or files; none for everything.
    overrides
        Of the configuration.
    cores
        Of the machine on which each job runs; a job never holds more.

    Returns
    -------
    list of Job
        Those that write something.

    Raises
    ------
    MorphoSkelError
        If Snakemake cannot plan, with what it said.
    """
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "jobs.jsonl"
        options = ["--dry-run", "--forceall", "--quiet", "all", f"--cores={cores}"]
        options += ["--logger", "jobs", "--logger-jobs-path", str(path)]
        command = snakemake_command(targets, overrides, options)
        folders = [repository / PLUGINS, repository / "src", *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(str(folder) for folder in folders if str(folder))}
        done = subprocess.run(command, cwd=repository, env=environment, capture_output=True, text=True, check=False)
        if done.returncode != 0 or not path.exists():
            said = (done.stderr + done.stdout).strip()[-3000:]
            raise MorphoSkelError(
                f"{repository}: Snakemake could not plan the jobs (exit code {done.returncode}): {said}"
            )
        return read_jobs(path)


def read_jobs(path: Path) -> list[Job]:
    """Read the lines of the logger ``jobs``; jobs that only gather others are left out."""
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    return [
        Job(row["rule"], row["wildcards"], row["threads"], row["gpus"], tuple(row["inputs"]), tuple(row["outputs"]))
        for row in rows
        if row["outputs"]
    ]
