"""Describe faults, and the environment of a process in which they happen."""

import json
import os
from pathlib import Path

from conftest import REPOSITORY

INJECTED = Path(__file__).with_name("injected")


def fault(module, function, action, *, shape=None, marker=None):
    """Return a fault for :func:`environment`; with a marker file it happens once, without at every call."""
    name = f"morphoskel.{module}"
    return {"module": name, "function": function, "action": action, "shape": shape, "marker": marker and str(marker)}


def environment(folder, faults, source=REPOSITORY / "src"):
    """Return the environment of a process in which the faults happen."""
    described = folder / "faults.json"
    described.write_text(json.dumps(faults))
    paths = [INJECTED, source, REPOSITORY / "tests", INJECTED.parent]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, paths)), "MORPHOSKEL_FAULTS": str(described)}
