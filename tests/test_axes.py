import numpy as np
import pytest

from morphoskel.datasets.axes import AS_THEY_ARE, axes_matrix
from morphoskel.errors import DatasetError

POINTS = np.array([[1.0, 2.0, 3.0], [-4.0, 5.0, 6.0]])


@pytest.mark.parametrize(
    ("axes", "turned"),
    [
        (AS_THEY_ARE, [[1, 2, 3], [-4, 5, 6]]),
        (("x", "z", "-y"), [[1, 3, -2], [-4, 6, -5]]),
        (("y", "z", "x"), [[2, 3, 1], [5, 6, -4]]),
        (("-x", "-y", "z"), [[-1, -2, 3], [4, -5, 6]]),
    ],
)
def test_axes_are_exchanged(axes, turned):
    matrix = axes_matrix(axes)
    assert np.array_equal(POINTS @ matrix, turned)
    assert np.array_equal(matrix @ matrix.T, np.eye(3))


@pytest.mark.parametrize("axes", [("x", "y"), ("x", "x", "z"), ("x", "y", "w"), ("x", "y", "z", "x")])
def test_three_different_axes_are_needed(axes):
    with pytest.raises(DatasetError, match=r"expected x, y and z in any order.*got x"):
        axes_matrix(axes)


@pytest.mark.parametrize("axes", [("y", "x", "z"), ("x", "y", "-z"), ("x", "z", "y")])
def test_shapes_are_not_mirrored(axes):
    with pytest.raises(DatasetError, match="would mirror the shapes"):
        axes_matrix(axes)
