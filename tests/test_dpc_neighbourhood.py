import numpy as np

from morphoskel.skeleton.dpc.neighbourhood import mean_spacing, neighbour_pairs, proximity


def test_pairs_match_all_distances():
    points = np.random.default_rng(0).random((60, 3))
    points[1] = points[0]  # coinciding points are neighbours, too
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    expected = np.argwhere((distances <= 0.3) & ~np.eye(60, dtype=bool))
    np.testing.assert_array_equal(np.column_stack(neighbour_pairs(points, 0.3)), expected)


def test_no_pairs():
    first, second = neighbour_pairs(np.eye(3), 0.1)
    assert len(first) == len(second) == 0


def test_spacing_of_a_grid_with_coinciding_points():
    grid = 0.25 * np.indices((4, 4, 1)).reshape(3, -1).T
    assert mean_spacing(np.vstack([grid, grid])) == 0.25


def test_proximity_falls_to_exp_minus_four():
    np.testing.assert_allclose(proximity(np.array([0.0, 1.0, 2.0]), 2.0), np.exp([0.0, -1.0, -4.0]))
