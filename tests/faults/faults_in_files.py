"""Damage files, and make a disk that is soon full."""

import os
import subprocess
from contextlib import contextmanager


def _flip(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0x04
    path.write_bytes(content)


def _cut(path):
    os.truncate(path, path.stat().st_size // 2)


def _empty(path):
    os.truncate(path, 0)


DAMAGE = {"flip": _flip, "cut": _cut, "empty": _empty}
"""A bit in the middle is turned, the second half is lost, or all of it."""


@contextmanager
def mounted(folder, size):
    """Mount a file system in memory on `folder`, which needs the rights of root."""
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)], check=True)
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)
