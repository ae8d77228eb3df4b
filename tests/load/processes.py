"""The processes of a run: what each of them is, and how much memory is resident in it."""

import re
import time
from contextlib import suppress
from pathlib import Path

import psutil

FORKSERVER = "multiprocessing.forkserver"
STAGE = re.compile(r"morphoskel\.chain\.(\w+)")


def snapshot(root):
    """Return a row (role, stage, pid, MB) for each process of the tree below `root` that does work.

    The roles are ``snakemake``, the main process; ``job``, the process of a script; and ``worker``, which computes one
    shape after the other. A worker's stage is what the server that it was forked from has loaded.
    """
    rows = []
    for process in _tree(root):
        with suppress(psutil.NoSuchProcess, psutil.ZombieProcess):
            role, stage = _describe(process)
            if role:
                rows.append((role, stage, process.pid, process.memory_info().rss / 1e6))
    return rows


def _tree(root):
    with suppress(psutil.NoSuchProcess):
        return [root, *root.children(recursive=True)]
    return []


def _describe(process):
    words = process.cmdline()
    text = " ".join(words)
    if FORKSERVER in text:
        parent = process.parent()
        forked = parent is not None and FORKSERVER in " ".join(parent.cmdline())
        return ("worker", STAGE.search(text)[1]) if forked and STAGE.search(text) else ("", "")
    if len(words) > 2 and words[1:3] == ["-m", "snakemake"]:
        return "snakemake", ""
    is_script = len(words) > 1 and "python" in Path(words[0]).name and words[1].endswith("run_stage.py")
    return ("job", "") if is_script else ("", "")


def survivors(processes, seconds):
    """Wait until the processes are gone, and return those that are not after so many seconds."""
    deadline = time.monotonic() + seconds
    while (alive := [process for process in processes if _lives(process)]) and time.monotonic() < deadline:
        time.sleep(0.5)
    return alive


def _lives(process):
    with suppress(psutil.NoSuchProcess):
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    return False
