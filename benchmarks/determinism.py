"""What other machines would compute: the same outputs with other instruction sets, compared with this machine's."""

import logging
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

logger = logging.getLogger(__name__)

REPOSITORY = Path(__file__).resolve().parents[1]

ALONE = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""What the first of two runs has, which the second has otherwise."""

ELSEWHERE = {
    "OMP_NUM_THREADS": "2",
    "OPENBLAS_NUM_THREADS": "2",
    "MKL_NUM_THREADS": "2",
    "PYTHONHASHSEED": "12345",
    "LC_ALL": "tr_TR.UTF-8",
    "LANG": "tr_TR.UTF-8",
    "TZ": "Pacific/Kiritimati",
}


def machines() -> dict[str, dict[str, str]]:
    """Return the environment variables that emulate each machine; those of the processor's kind change one library."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    dispatched = " ".join(name for name in __cpu_dispatch__ if __cpu_features__.get(name))
    single = {
        "torch without vectors": {"ATEN_CPU_CAPABILITY": "default", "DNNL_MAX_CPU_ISA": "SSE41"},
        "MKL in compatible mode": {"MKL_CBWR": "COMPATIBLE"},
        "OpenBLAS for Prescott": {"OPENBLAS_CORETYPE": "Prescott"},
        "OpenBLAS for Haswell": {"OPENBLAS_CORETYPE": "Haswell"},
        "NumPy without dispatch": {"NPY_DISABLE_CPU_FEATURES": dispatched},
        "Numba for any x86-64": {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""},
    }
    old = {key: value for name, values in single.items() if "Haswell" not in name for key, value in values.items()}
    return {"same machine": {}, **single, "all of these": old}


def outputs(file: Path, variables: dict[str, str], *arguments: str) -> dict[str, np.ndarray]:
    """Compute the outputs in a process with these environment variables.

    Parameters
    ----------
    file
        NPZ file to write.
    variables
        Beside those of this process.
    arguments
        Of ``benchmarks.determinism_outputs``, after the file.
    """
    paths = os.pathsep.join([str(REPOSITORY), str(REPOSITORY / "src")])
    command = [sys.executable, "-m", "benchmarks.determinism_outputs", str(file), *arguments]
    subprocess.run(command, env={**os.environ, **ALONE, "PYTHONPATH": paths, **variables}, cwd=file.parent, check=True)
    with np.load(file, allow_pickle=False) as stored:
        return dict(stored)


def differences(first: dict[str, np.ndarray], second: dict[str, np.ndarray]) -> pd.DataFrame:
    """Return how two sets of outputs differ: one row an output.

    Returns
    -------
    pandas.DataFrame
        ``output``; ``equal``, bit by bit; ``changed``, share of values that differ; ``largest``, largest difference
        beside the largest value, NaN where even the number of values differs.
    """
    rows = []
    for name, one in first.items():
        other = second[name]
        if one.shape != other.shape:
            rows.append((name, False, 1.0, np.nan))
            continue
        gap = np.abs(one.astype(np.float64) - other.astype(np.float64))
        largest = gap.max() / max(np.abs(one).max(), np.finfo(float).tiny)
        rows.append((name, one.tobytes() == other.tobytes(), (gap > 0).mean(), largest))
    return pd.DataFrame(rows, columns=["output", "equal", "changed", "largest"])


def run(folder: Path) -> bool:
    """Write ``determinism.csv``; return whether everything that has to be bit-equal is."""
    frames = []
    with tempfile.TemporaryDirectory() as scratch:
        reference = outputs(Path(scratch) / "reference.npz", {})
        for machine, variables in machines().items():
            cache = {"NUMBA_CACHE_DIR": f"{scratch}/kernels"} if "NUMBA_CPU_NAME" in variables else {}
            found = differences(reference, outputs(Path(scratch) / "other.npz", {**variables, **cache}))
            frames.append(found.assign(machine=machine))
            logger.info("%s: %d of %d outputs are bit-equal", machine, found["equal"].sum(), len(found))
    frame = pd.concat(frames)[["machine", "output", "equal", "changed", "largest"]]
    frame.to_csv(folder / "determinism.csv", index=False, float_format="%.3g")
    same = frame[frame["machine"] == "same machine"]
    return bool(same["equal"].all())
