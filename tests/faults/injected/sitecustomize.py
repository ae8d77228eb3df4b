"""Break chosen functions of the library, in every Python process that has this folder on its path.

The library knows nothing of it. The file that ``MORPHOSKEL_FAULTS`` names lists faults: the module and the function,
the shape at which it breaks (or none), the action, and a marker file for a fault that happens only once.
"""

import contextlib
import ctypes
import functools
import importlib.util
import json
import os
import signal
import sys
from pathlib import Path


def _break(fault, function, args, kwargs):
    if fault["action"] == "segfault":
        ctypes.string_at(0)  # what a wild pointer in a native library does
    function(*args, **kwargs)
    for path in args[0].output.glob(f"{args[0].record.id}*") if fault["shape"] else ():
        os.truncate(path, path.stat().st_size // 2)  # as if killed in the middle of writing
    os.kill(os.getpid(), signal.SIGKILL)


def _wrap(fault, function):
    @functools.wraps(function)
    def broken(*args, **kwargs):
        if fault["shape"] is None or args[0].record.id == fault["shape"]:
            with contextlib.suppress(FileExistsError):
                if fault["marker"]:
                    Path(fault["marker"]).touch(exist_ok=False)
                _break(fault, function, args, kwargs)
        return function(*args, **kwargs)

    return broken


class _Finder:
    """Find the modules with faults as usual, and break them once they are loaded."""

    def __init__(self, faults):
        self.faults = faults

    def find_spec(self, name, path=None, target=None):
        faults = [fault for fault in self.faults if fault["module"] == name]
        if not faults:
            return None
        self.faults = [fault for fault in self.faults if fault["module"] != name]
        spec = importlib.util.find_spec(name)
        load = spec.loader.exec_module

        def load_and_break(module):
            load(module)
            for fault in faults:
                *owner, function = fault["function"].split(".")
                holder = functools.reduce(getattr, owner, module)
                setattr(holder, function, _wrap(fault, getattr(holder, function)))

        spec.loader.exec_module = load_and_break
        return spec


if "MORPHOSKEL_FAULTS" in os.environ:
    sys.meta_path.insert(0, _Finder(json.loads(Path(os.environ["MORPHOSKEL_FAULTS"]).read_text())))
