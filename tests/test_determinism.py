"""What `docs/determinism.md` promises of one machine; other instruction sets are a benchmark of their own."""

import numpy as np
import pytest

from benchmarks.determinism import ELSEWHERE, differences, machines, outputs

KINDS = ["surface", "ms3d", "ms3d_coverage", "coverage_axis", "l1_medial", "dpc", "evaluation", "sampling"]


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    return outputs(tmp_path_factory.mktemp("reference") / "outputs.npz", {"PYTHONHASHSEED": "1", "LC_ALL": "C"})


def test_outputs_of_every_kind_are_compared(reference):
    for kind in KINDS:
        for shape in ("ellipsoid", "tube"):
            found = [array for name, array in reference.items() if name.startswith(f"{kind}, {shape}: ")]
            assert found, kind
            assert all(array.size and np.isfinite(array).all() for array in found)
    assert {"table: files", "training: classifier", "edge convolution: gradients"} <= reference.keys()


def test_neither_threads_nor_the_surroundings_of_a_process_change_a_bit(reference, tmp_path):
    """Threads of the chain, of BLAS and of OpenMP, the seed of hashes, the locale, the time zone, and the folder."""
    elsewhere = tmp_path / "another folder"
    elsewhere.mkdir()
    again = outputs(tmp_path / "outputs.npz", ELSEWHERE, "--threads", "2", "--folder", str(elsewhere))
    assert again.keys() == reference.keys()
    found = differences(reference, again)
    assert found.loc[~found["equal"], "output"].tolist() == []


def test_differences_are_found_and_measured():
    first = {"same": np.ones(4), "one": np.array([1.0, 2, 4, 8]), "shape": np.ones(3), "nan": np.array([np.nan, 1])}
    second = {**first, "one": np.array([1.0, 2, 4, 8.5]), "shape": np.ones(2)}
    found = differences(first, second).set_index("output")
    assert found["equal"].to_dict() == {"same": True, "one": False, "shape": False, "nan": True}
    assert found.loc["one", "changed"] == 0.25
    assert found.loc["one", "largest"] == 0.5 / 8
    assert np.isnan(found.loc["shape", "largest"])


def test_every_emulated_machine_changes_something_but_the_first():
    emulated = machines()
    assert next(iter(emulated.values())) == {}
    assert all(all(isinstance(value, str) for value in variables.values()) for variables in emulated.values())
    assert all(list(emulated.values())[1:])
