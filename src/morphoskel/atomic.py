"""Write files and folders so that they exist whole or not at all.

A killed job leaves at most a name ending in ``.partial`` beside the target, which the next attempt replaces.
"""

import fcntl
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path beside `path`; rename it to `path` when the block ends without an error."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f"{path.name}.partial")
    try:
        yield partial
        partial.replace(path)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise


@contextmanager
def atomic_folder(path: Path) -> Iterator[Path]:
    """Yield an empty temporary folder beside `path`; rename it to `path`, replacing what was there, at the end.

    The temporary folder is locked while the block runs. If a workflow was killed but one of its jobs lives on and
    still writes there, a new attempt waits until that job ends, instead of both writing into the same folder.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f"{path.name}.partial")
    lock = _claim(partial)
    try:
        yield partial
        shutil.rmtree(path, ignore_errors=True)
        partial.rename(path)
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)
        raise
    finally:
        os.close(lock)


def _claim(folder: Path) -> int:
    """Create `folder` and return a descriptor that holds its lock, removing what a dead job left there."""
    while True:
        try:
            folder.mkdir()
        except FileExistsError:
            _remove_when_free(folder)
            continue
        lock = os.open(folder, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        return lock


def _remove_when_free(folder: Path) -> None:
    try:
        lock = os.open(folder, os.O_RDONLY)
    except FileNotFoundError:
        return
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        # The job that held the lock may have renamed the folder to its final name meanwhile: leave that alone.
        if folder.exists() and folder.stat().st_ino == os.fstat(lock).st_ino:
            shutil.rmtree(folder)
    finally:
        os.close(lock)
