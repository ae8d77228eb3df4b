"""The comparison that the benchmark relies on must notice a wrong answer."""

import numpy as np
import pytest
from solids import torus

from benchmarks.agreement import compare
from benchmarks.computations import ours, released
from morphoskel.formats import write_mesh_ply

NAMES = ("inner", "udf", "residues", "kept")


@pytest.fixture(scope="module")
def surface(tmp_path_factory):
    path = tmp_path_factory.mktemp("surface") / "torus.ply"
    write_mesh_ply(path, torus())
    return path


def answer(compute, surface, mode):
    return dict(zip(NAMES, compute(surface, mode, 40_000)[1:], strict=True))


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_both_computations_agree(surface, mode):
    agreement = compare(answer(released, surface, mode), answer(ours, surface, mode))
    assert agreement.unexplained == 0
    assert agreement.largest_udf_difference < 1e-6
    assert agreement.kept_by_both > 900


def test_a_wrong_selection_is_noticed(surface):
    first, second = answer(released, surface, "random"), answer(ours, surface, "random")
    second["kept"] = np.argsort(second["residues"])[100:1124]
    assert compare(first, second).unexplained > 50


def test_a_wrong_residue_is_noticed(surface):
    first, second = answer(released, surface, "random"), answer(ours, surface, "random")
    second["residues"] = second["residues"] + np.where(second["residues"] < 0.001, np.float32(1), np.float32(0))
    second["kept"] = np.argsort(second["residues"])[:1024]
    assert compare(first, second).unexplained > 50
