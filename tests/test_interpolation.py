import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.shapes import Skeleton
from morphoskel.skeleton.interpolation import edges_outside_triangles, interpolate_balls


def generator():
    return np.random.default_rng(0)


@pytest.fixture
def sheet_and_curve():
    """Return a unit square of two triangles, a curve of length 2 and a single ball."""
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [5, 0, 0], [5, 2, 0], [9, 9, 9]])
    return Skeleton(
        points, np.array([0.1, 0.2, 0.3, 0.2, 1, 2, 7]), edges=[[4, 5], [1, 0]], triangles=[[0, 1, 2], [0, 2, 3]]
    )


def test_count_and_shares(sheet_and_curve):
    """The square has area 1 and the curve counts as 2 * 2 / 2 = 2; the single ball is kept."""
    drawn = interpolate_balls(sheet_and_curve, 901, generator())
    assert len(drawn) == 901
    assert drawn.points[0].tolist() == [9, 9, 9]
    assert drawn.radii[0] == 7
    assert (drawn.points[1:301, 0] <= 1).all()
    assert (drawn.points[301:, 0] == 5).all()


def test_centre_and_radius_are_linear(sheet_and_curve):
    drawn = interpolate_balls(sheet_and_curve, 301, generator())
    x, y, z = drawn.points[1:101].T
    np.testing.assert_allclose(drawn.radii[1:101], 0.1 + 0.1 * x + 0.1 * y, atol=1e-12)
    assert (z == 0).all()
    np.testing.assert_allclose(drawn.radii[101:], 1 + drawn.points[101:, 1] / 2, atol=1e-12)


def test_balls_are_uniform_on_sheets_and_curves(sheet_and_curve):
    """Mean and covariance of the uniform distribution on the unit square; the quadrants hold a quarter each."""
    drawn = interpolate_balls(sheet_and_curve, 30_001, generator())
    square, curve = drawn.points[1:10_001, :2], drawn.points[10_001:, 1]
    np.testing.assert_allclose(square.mean(axis=0), 0.5, atol=0.01)
    np.testing.assert_allclose(np.cov(square.T), np.eye(2) / 12, atol=0.003)
    assert np.mean((square < 0.5).all(axis=1)) == pytest.approx(0.25, abs=0.02)
    np.testing.assert_allclose(np.histogram(curve, 10, (0, 2))[0], 2000, rtol=0.1)


def test_each_piece_gets_what_is_due_to_it():
    """Areas 1 : 3 share 40 balls as 10 : 30, lengths 1 : 3 too, whatever the random numbers are."""
    points = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0], [10, 0, 0], [12, 0, 0], [10, 3, 0]])
    sheets = Skeleton(points, np.ones(6), triangles=[[0, 1, 2], [3, 4, 5]])
    line = Skeleton(np.array([[0.0, 0, 0], [1, 0, 0], [4, 0, 0]]), np.ones(3), edges=[[0, 1], [1, 2]])
    for seed in range(5):
        drawn = interpolate_balls(sheets, 40, np.random.default_rng(seed))
        assert (drawn.points[:, 0] < 5).sum() == 10
        assert (interpolate_balls(line, 40, np.random.default_rng(seed)).points[:, 0] < 1).sum() == 10


def test_sides_of_triangles_and_repeated_edges_are_no_curves():
    skeleton = Skeleton(np.eye(5, 3), np.ones(5), edges=[[3, 4], [4, 3], [2, 1], [0, 1]], triangles=[[2, 0, 1]])
    assert edges_outside_triangles(skeleton).tolist() == [[3, 4]]


def test_the_generator_decides(sheet_and_curve):
    first, again = (interpolate_balls(sheet_and_curve, 50, generator()) for _ in range(2))
    other = interpolate_balls(sheet_and_curve, 50, np.random.default_rng(1))
    np.testing.assert_array_equal(first.points, again.points)
    assert not np.array_equal(first.points, other.points)


def test_without_pieces_some_of_the_balls_are_drawn():
    balls = Skeleton(np.arange(30.0).reshape(10, 3), np.arange(10.0))
    drawn = interpolate_balls(balls, 4, generator())
    assert len(set(drawn.radii)) == 4
    assert (np.diff(drawn.radii) > 0).all()
    np.testing.assert_array_equal(drawn.points, balls.points[drawn.radii.astype(int)])
    np.testing.assert_array_equal(interpolate_balls(balls, 10, generator()).points, balls.points)


def test_what_cannot_be_drawn_is_refused(sheet_and_curve):
    balls = Skeleton(np.eye(3), np.ones(3))
    with pytest.raises(InputError, match="4 balls cannot be drawn from 3: the skeleton has no edges or triangles"):
        interpolate_balls(balls, 4, generator())
    with pytest.raises(InputError, match="1 balls are too few for 1 isolated"):
        interpolate_balls(sheet_and_curve, 1, generator())
    with pytest.raises(InputError, match="at least 1 ball"):
        interpolate_balls(sheet_and_curve, 0, generator())


def test_pieces_without_extent_share_equally():
    skeleton = Skeleton(np.zeros((5, 3)), np.array([1.0, 1, 1, 2, 2]), edges=[[3, 4]], triangles=[[0, 1, 2]])
    drawn = interpolate_balls(skeleton, 10, generator())
    assert drawn.radii.tolist() == pytest.approx([1] * 5 + [2] * 5)
