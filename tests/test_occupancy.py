import numpy as np
import pytest
from solids import ball, box

from morphoskel.errors import ShapeError
from morphoskel.volume import Candidates, SurfaceQuery, inner_points, occupancy


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_share_inside_is_the_share_of_volume(mode):
    mesh = ball()
    candidates = Candidates(*mesh.bounds, count=300_000, mode=mode, seed=2)
    mask = occupancy(SurfaceQuery(mesh), candidates)
    assert mask.shape == (len(candidates),)
    # Grid nodes stand for cells centred on them, so half a cell sticks out of the box on every side.
    box_share = 1 if mode == "random" else (1 - 1 / candidates.nodes_per_axis) ** 3
    assert mask.mean() == pytest.approx(np.pi / 6 * box_share, abs=0.005)


def test_inner_points_are_those_of_the_mask():
    mesh = box(2, 1, 1)
    candidates = Candidates(*(corner * 2 for corner in mesh.bounds), count=300_000, seed=2)
    mask = occupancy(SurfaceQuery(mesh), candidates)
    inner = inner_points(candidates, mask)
    assert np.array_equal(inner, np.concatenate(list(candidates.chunks()))[mask])
    assert (np.abs(inner) <= np.array([1, 0.5, 0.5]) + 1e-6).all()


def test_nothing_inside_is_an_error_that_helps():
    candidates = Candidates(np.full(3, 5.0), np.full(3, 6.0), count=1000)
    with pytest.raises(ShapeError, match=r"none of the 1,000 candidates.*skeleton\.candidates\.count"):
        occupancy(SurfaceQuery(ball()), candidates)
