import numpy as np
import pytest

from morphoskel.skeleton.mesh_distance import BLOCK, nearest_pieces, segment_distances

CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])


def dense(corners, steps):
    """Return a fine lattice on the segment or triangle with these corners."""
    if len(corners) == 2:
        weights = np.stack([np.arange(steps + 1), steps - np.arange(steps + 1)], axis=1)
    else:
        weights = np.array([(i, j, steps - i - j) for i in range(steps + 1) for j in range(steps + 1 - i)])
    return weights / steps @ corners


def test_exact_distances_lie_just_below_those_to_a_fine_lattice():
    generator = np.random.default_rng(0)
    points, vertices = generator.normal(size=(50, 3)), generator.normal(size=(9, 3))
    edges, triangles = np.array([[0, 1], [7, 8]]), np.array([[2, 3, 4], [3, 4, 5], [4, 6, 5]])
    distances, pieces = nearest_pieces(points, vertices, edges, triangles)
    lattices = [dense(vertices[piece], 120) for piece in (*edges, *triangles)]
    to_lattices = np.stack([np.linalg.norm(points[:, None] - own, axis=2).min(axis=1) for own in lattices], axis=1)
    excess = to_lattices.min(axis=1) - distances
    assert excess.min() >= -1e-12
    assert excess.max() < 0.02
    np.testing.assert_allclose(to_lattices[np.arange(50), pieces], distances, atol=0.02)
    assert set(pieces) == set(range(5))


@pytest.mark.parametrize(
    ("point", "distance"),
    [
        ((0.25, 0.25, 2), 2),  # above the interior
        ((-3, -4, 0), 5),  # nearest to a corner
        ((0.5, -0.5, 0), 0.5),  # nearest to a side
        ((1, 1, 0), np.sqrt(0.5)),  # beyond the long side
        ((0.2, 0.3, 0), 0),
    ],
)
def test_known_distances_to_a_triangle(point, distance):
    found, piece = nearest_pieces(np.array([point], dtype=float), CORNERS, np.empty((0, 2), int), np.array([[0, 1, 2]]))
    assert found[0] == pytest.approx(distance, abs=1e-12)
    assert piece[0] == 0


def test_of_equally_near_pieces_the_first():
    point = np.array([[0.5, 0.5, 1.0]])  # above the side that both triangles share
    _, piece = nearest_pieces(point, CORNERS, np.empty((0, 2), int), np.array([[1, 2, 3], [0, 1, 2]]))
    assert piece[0] == 0
    _, piece = nearest_pieces(point, CORNERS, np.array([[1, 2]]), np.array([[1, 2, 3]]))
    assert piece[0] == 0


def test_pieces_without_extent():
    vertices = np.array([[1.0, 0, 0], [1, 0, 0], [1, 0, 0], [3, 0, 0]])
    points = np.zeros((1, 3))
    assert segment_distances(points, vertices, np.array([[0, 1]]))[0, 0] == 1
    distances, _ = nearest_pieces(points, vertices, np.empty((0, 2), int), np.array([[0, 1, 2], [0, 1, 3]]))
    assert distances[0] == 1


def test_blocks_do_not_change_the_result():
    points = np.random.default_rng(0).normal(size=(2 * BLOCK + 3, 3))
    pieces = np.array([[0, 1]]), np.array([[1, 2, 3]])
    distances, nearest = nearest_pieces(points, CORNERS, *pieces)
    for i in (0, BLOCK - 1, BLOCK, len(points) - 1):
        alone = nearest_pieces(points[i : i + 1], CORNERS, *pieces)
        assert (distances[i], nearest[i]) == (alone[0][0], alone[1][0])
