from dataclasses import replace

import numpy as np
import pytest
from illustrated import illustrated

from morphoskel.errors import InputError


@pytest.fixture
def box():
    return illustrated("box")


def test_residues_and_skeleton_follow_from_the_arrays(box):
    assert np.array_equal(box.residues, box.dilated - box.udf)
    skeleton = box.skeleton
    assert len(skeleton) == 50
    assert np.array_equal(skeleton.points, box.inner[box.selected])
    assert np.array_equal(skeleton.radii, box.udf[box.selected])
    assert (np.diff(skeleton.residues) >= 0).all()


def test_the_spacing_is_that_of_a_cubic_lattice_as_dense_as_the_points_kept():
    grid = illustrated("box", "grid")
    lower, upper = grid.surface.bounds
    assert grid.spacing**3 * len(grid.inner) == pytest.approx(
        np.prod(upper - lower) * grid.inner_count / grid.candidate_count
    )


CHANGES = {
    "mode: expected random or grid": lambda box: {"mode": "regular"},
    "inner: expected shape": lambda box: {"inner": box.inner[:, :2]},
    "udf: expected shape": lambda box: {"udf": box.udf[1:]},
    "udf: expected finite": lambda box: {"udf": np.full_like(box.udf, np.nan)},
    "0 <= udf <= dilated": lambda box: {"dilated": box.udf - 1},
    "inside: unexpected kind": lambda box: {"inside": box.inside.astype(float)},
    "at least one, and distinct, of the rows": lambda box: {"selected": box.selected[[0, 0]]},
    "of the rows 0 to": lambda box: {"selected": np.array([len(box.inner)])},
    "selected: expected at least one": lambda box: {"selected": box.selected[:0]},
    "residue_edges: expected increasing": lambda box: {"residue_edges": box.residue_edges[::-1].copy()},
    "residue_counts: expected the sum": lambda box: {"residue_counts": box.residue_counts + 1},
    "no part to be larger": lambda box: {"candidate_count": 7},
}


@pytest.mark.parametrize("message", CHANGES)
def test_contradictions_are_refused(box, message):
    with pytest.raises(InputError, match=message):
        replace(box, **CHANGES[message](box))
