"""Call Snakemake with overrides in place: the front door to the workflow."""

from __future__ import annotations

import json
import logging
import os
import shlex
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from morphoskel.config import compose
from morphoskel.config.workflow_path import check_clone_path
from morphoskel.cores import available_cores
from morphoskel.errors import MorphoSkelError

logger = logging.getLogger(__name__)

CORE_OPTIONS = ("--cores", "-c", "--jobs", "-j", "--profile")
"""Snakemake options that decide the number of jobs; without one of them, all cores are used."""


def run_workflow(
    targets: Sequence[str], overrides: Sequence[str] = (), options: Sequence[str] = (), *, start: Path | None = None
) -> int:
    """Build targets of the workflow.

    Parameters
    ----------
    targets
        Names of rules or files; none builds everything.
    overrides
        Configuration overrides, checked before Snakemake starts.
    options
        Passed to Snakemake as they are.
    start
        Folder from which the repository is searched upward; by default the current one.

    Returns
    -------
    int
        Snakemake's exit code.

    Raises
    ------
    MorphoSkelError
        If this is no copy of the repository or one under an impossible path, a run is at work in it already, or the
        configuration is wrong.
    """
    repository = find_repository(start or Path.cwd())
    check_clone_path(repository)
    compose(overrides, repository / "config")
    release_stale_lock(repository)
    command = snakemake_command(targets, overrides, options)
    # The display of progress tells how to go on after a failure.
    environment = {**os.environ, "MORPHOSKEL_COMMAND": typed_command(targets, overrides, options)}
    with subprocess.Popen(command, cwd=repository, env=environment) as process:
        return wait_patiently(process)


def wait_patiently(process: subprocess.Popen[bytes]) -> int:
    """Return the exit code of a process that gets Ctrl-C, too, and then has to clean up before it ends."""
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:
            continue


def typed_command(targets: Sequence[str], overrides: Sequence[str], options: Sequence[str]) -> str:
    """Return what the user typed, to be shown to them."""
    return shlex.join(["morphoskel", "run", *targets, *overrides, *(["--", *options] if options else [])])


def snakemake_command(targets: Sequence[str], overrides: Sequence[str], options: Sequence[str]) -> list[str]:
    """Return the command line that builds `targets`; Snakemake's ``--config`` cannot carry dotted keys by itself."""
    command = [sys.executable, "-m", "snakemake", *targets]
    if not any(option.startswith(CORE_OPTIONS) for option in options):
        command += ["--cores", str(available_cores())]
    if overrides:
        # Snakemake reads this as YAML, which does not know JSON's way to write letters as two escapes.
        command += ["--config", f"overrides={json.dumps(list(overrides), ensure_ascii=False)}"]
    return [*command, *options]


def find_repository(start: Path) -> Path:
    """Return the nearest folder, from `start` upward, that holds the workflow.

    Raises
    ------
    MorphoSkelError
        If there is none.
    """
    for folder in (start, *start.parents):
        if (folder / "Snakefile").is_file() and (folder / "config" / "config.yaml").is_file():
            return folder
    raise MorphoSkelError(
        f"{start}: neither this folder nor one above it holds the workflow (Snakefile and config/config.yaml); "
        "change to your clone of the repository. To skeletonize shapes without it, use `morphoskel skeletonize`"
    )


def release_stale_lock(repository: Path) -> None:
    """Remove the lock that a killed run left behind.

    Raises
    ------
    MorphoSkelError
        If the run that holds it is alive.
    """
    locks = repository / ".snakemake" / "locks"
    if not locks.is_dir() or not any(locks.iterdir()):
        return
    alive = _running_snakemakes(repository)
    if alive:
        raise MorphoSkelError(
            f"{repository}: a run is at work here (process {', '.join(map(str, alive))}); "
            "wait for it, or stop it and try again"
        )
    logger.warning("a run was killed here before; its lock is removed, and what it left half done is made again")
    for lock in locks.iterdir():
        lock.unlink()


def _running_snakemakes(repository: Path) -> list[int]:
    """Return the processes that run Snakemake in this folder."""
    import psutil

    found = []
    for process in psutil.process_iter(["pid", "cmdline", "cwd"]):
        words = process.info["cmdline"] or []
        is_snakemake = any(Path(word).name == "snakemake" for word in words[:3])
        if is_snakemake and process.info["cwd"] == str(repository.resolve()):
            found.append(int(process.info["pid"]))
    return found
