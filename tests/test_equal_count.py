import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.shapes import Skeleton
from morphoskel.skeleton.equal_count import bring_to_count

LINE = Skeleton(np.column_stack([np.linspace(0, 1, 11), np.zeros((11, 2))]), np.linspace(1, 2, 11), np.arange(11.0))


def generator():
    return np.random.default_rng(0)


def test_a_ranked_skeleton_is_cut_off():
    cut = bring_to_count(LINE, 3, generator(), ranked=True)
    assert np.array_equal(cut.points, LINE.points[:3])
    assert np.array_equal(cut.residues, LINE.residues[:3])


def test_any_other_is_spread():
    spread = bring_to_count(LINE, 3, generator(), ranked=False)
    assert np.array_equal(spread.points[:, 0], [0, 1, 0.5])
    assert np.array_equal(spread.radii, [1, 2, 1.5])


def test_what_has_enough_balls_stays():
    assert bring_to_count(LINE, 11, generator(), ranked=False) is LINE


def test_missing_balls_lie_on_the_curves():
    curve = Skeleton(LINE.points[[0, -1]], np.array([1.0, 2.0]), edges=[[0, 1]])
    filled = bring_to_count(curve, 50, generator(), ranked=False)
    assert len(filled) == 50
    assert filled.radii == pytest.approx(1 + filled.points[:, 0])


def test_missing_balls_cannot_be_made_up():
    with pytest.raises(InputError, match="has 11 balls"):
        bring_to_count(LINE, 12, generator(), ranked=True)
