"""A copy of the repository that a test may edit, and the workflow run in it as a user runs it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from conftest import REPOSITORY


def copy_repository(target: Path) -> Path:
    target.mkdir(parents=True)
    for name in ("workflow", "config", "profiles", "src"):
        shutil.copytree(REPOSITORY / name, target / name, ignore=shutil.ignore_patterns("*.pyc"))
    for name in ("Snakefile", "environment.yml"):
        shutil.copy(REPOSITORY / name, target)
    return target


def environment(repository: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(repository / "src"), "PYTHONDONTWRITEBYTECODE": "1"}


def run(repository: Path, *words: str, check: bool = True) -> str:
    """Call ``morphoskel run`` and return all it printed."""
    command = [sys.executable, "-m", "morphoskel.cli", "run", *words]
    done = subprocess.run(
        command,
        cwd=repository,
        env=environment(repository),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert (done.returncode == 0) is check, done.stdout[-6000:]
    return done.stdout
