"""What a run was made with: date, commit, package versions and machine, without the names of its user and host."""

from __future__ import annotations

import json
import os
import platform
import re
import subprocess
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path
from typing import Any

from morphoskel.atomic import atomic_file
from morphoskel.cores import available_cores
from morphoskel.errors import InputError
from morphoskel.provenance import PACKAGE, PACKAGE_FOLDER

KEYS = ("date", "version", "commit", "dirty", "python", "packages", "machine")
"""Keys of the provenance of a run, in order."""


def collect_provenance() -> dict[str, Any]:
    """Return what the results that this process makes are made with, as plain values.

    Returns
    -------
    dict
        ``date``, ISO 8601 in UTC; ``version`` of this package; ``commit``, 40 hexadecimal digits, and ``dirty``,
        whether files that Git knows were edited since, both ``None`` outside a clone; ``python``, its version;
        ``packages``, the version of each direct dependency; and ``machine`` with ``system`` and ``processor`` (text),
        ``cores`` (those granted to this process) and ``memory`` (bytes).
    """
    commit, dirty = git_state(PACKAGE_FOLDER)
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "version": version(PACKAGE),
        "commit": commit,
        "dirty": dirty,
        "python": platform.python_version(),
        "packages": dependency_versions(),
        "machine": {
            "system": _system(),
            "processor": _processor(),
            "cores": available_cores(),
            "memory": _memory(),
        },
    }


def write_provenance(path: Path) -> None:
    """Write :func:`collect_provenance` as JSON."""
    with atomic_file(path) as partial:
        partial.write_text(json.dumps(collect_provenance(), indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def read_provenance(path: Path) -> dict[str, Any]:
    """Read the file of :func:`write_provenance`.

    Raises
    ------
    InputError
        If it is absent or is not such a file.
    """
    try:
        values = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{path}: expected the provenance of a run as JSON ({error}); make it again") from error
    if not isinstance(values, dict) or tuple(values) != KEYS:
        raise InputError(f"{path}: expected an object with the keys {', '.join(KEYS)}; make it again")
    return values


def git_state(folder: Path) -> tuple[str | None, bool | None]:
    """Return the commit that a folder of sources belongs to, and whether a file that Git knows was edited since.

    Both are ``None`` if Git is absent or does not know the sources, as those of an installed package.
    """
    known = _git(folder, "ls-files", "--", ".")
    commit = _git(folder, "rev-parse", "HEAD") if known else None
    if not commit:
        return None, None
    changes = _git(folder, "status", "--porcelain", "--untracked-files=no")
    return commit, None if changes is None else bool(changes)


def dependency_versions() -> dict[str, str]:
    """Return the version of each package that this one names as its dependency, by name; of those installed."""
    try:
        named = requires(PACKAGE) or []
    except PackageNotFoundError:  # run from the sources
        named = []
    names = [re.split(r"[^\w.-]", text, maxsplit=1)[0] for text in named if "extra ==" not in text]
    versions = {}
    for name in sorted(set(names), key=str.lower):
        try:
            versions[name] = version(name)
        except PackageNotFoundError:  # for another platform
            continue
    return versions


def _git(folder: Path, *words: str) -> str | None:
    """Return what Git prints, or ``None`` if it fails."""
    try:
        done = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True, check=False)
    except OSError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def _system() -> str:
    try:
        name = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):  # not Linux
        name = platform.system()
    return f"{name}, {platform.system()} {platform.release()}, {platform.machine()}"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.processor() or platform.machine()


def _memory() -> int | None:
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):  # not POSIX
        return None
