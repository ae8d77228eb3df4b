import itertools

import numpy as np
import pytest

from morphoskel.skeleton.skeletal_mesh import curve_edges, graph_triangles, induced_loops, skeletal_mesh

NO_POINTS = np.zeros((1, 3)) + 100


def graph(count, *links):
    matrix = np.zeros((count, count), dtype=bool)
    for a, b in links:
        matrix[a, b] = matrix[b, a] = True
    return matrix


def ring(count):
    return graph(count, *((i, (i + 1) % count) for i in range(count)))


def circle(count):
    angles = np.arange(count) / count * 2 * np.pi
    return np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=1)


def random_graph(count, density, seed):
    upper = np.triu(np.random.default_rng(seed).random((count, count)) < density, 1)
    return upper | upper.T


@pytest.mark.parametrize("seed", range(5))
def test_triangles_and_curves_equal_the_definitions(seed):
    links = random_graph(12, 0.35, seed)
    triangles = [
        triple
        for triple in itertools.combinations(range(12), 3)
        if all(links[pair] for pair in itertools.combinations(triple, 2))
    ]
    in_triangles = {pair for triple in triangles for pair in itertools.combinations(triple, 2)}
    curves = [pair for pair in itertools.combinations(range(12), 2) if links[pair] and pair not in in_triangles]
    found = graph_triangles(links)
    assert [tuple(row) for row in found.tolist()] == triangles
    assert [tuple(row) for row in curve_edges(links, found).tolist()] == curves


@pytest.mark.parametrize(("seed", "length"), list(itertools.product(range(3), (4, 5, 6, 7))))
def test_loops_equal_the_induced_cycles(seed, length):
    """A set of points carries an induced cycle just if each has two links within the set and they hang together."""
    links = random_graph(11, 0.3, seed)
    open_links = links & random_graph(11, 0.6, seed + 100)
    expected = set()
    for points in itertools.combinations(range(11), length):
        own = links[np.ix_(points, points)]
        reached = np.linalg.matrix_power(own.astype(int) + np.eye(length, dtype=int), length)[0]
        open_count = open_links[np.ix_(points, points)].sum() // 2
        if (own.sum(axis=1) == 2).all() and reached.all() and open_count >= 3:
            expected.add(points)
    found = list(induced_loops(links, length, open_links, 3))
    assert len(found) == len(expected)
    assert {tuple(sorted(loop)) for loop in found} == expected
    for loop in found:
        assert all(links[pair] for pair in zip(loop, loop[1:] + loop[:1], strict=True))


def test_a_ring_stays_a_curve_without_evidence():
    links = ring(6)
    edges, triangles = skeletal_mesh(circle(6), NO_POINTS, links, links)
    assert len(triangles) == 0
    assert len(edges) == 6


def test_surface_points_over_a_hole_fill_it():
    links = ring(6)
    surface = np.random.default_rng(0).uniform(-0.3, 0.3, (20, 3))
    edges, triangles = skeletal_mesh(circle(6), surface, links, links)
    assert len(edges) == 0
    assert len(triangles) == 4  # a disc with six corners
    assert set(triangles.ravel()) == set(range(6))


def test_a_predicted_link_across_a_hole_fills_it():
    links = ring(5)
    edges, triangles = skeletal_mesh(circle(5), NO_POINTS, links, links | graph(5, (1, 3)))
    assert len(edges) == 0
    assert len(triangles) >= 3


@pytest.mark.parametrize(("length", "filled"), [(8, True), (9, False)])
def test_the_longest_hole(length, filled):
    surface = np.random.default_rng(0).uniform(-0.3, 0.3, (20, 3))
    _, triangles = skeletal_mesh(circle(length), surface, ring(length), ring(length))
    assert (len(triangles) > 0) == filled


def test_predicted_links_join_ends_of_curves_and_boundaries_of_sheets_only():
    # Two curves 0-1-2 and 3-4-5, and two triangles 6-7-8 and 9-10-11. A corner of a lone triangle is an end, too.
    links = graph(12, (0, 1), (1, 2), (3, 4), (4, 5), (6, 7), (7, 8), (6, 8), (9, 10), (10, 11), (9, 11))
    predicted = links | graph(12, (2, 3), (1, 4), (8, 9), (0, 6), (1, 7))
    centres = np.random.default_rng(0).normal(size=(12, 3))
    edges, triangles = skeletal_mesh(centres, NO_POINTS, links, predicted)
    assert triangles.tolist() == [[6, 7, 8], [9, 10, 11]]
    assert edges.tolist() == [[0, 1], [0, 6], [1, 2], [2, 3], [3, 4], [4, 5], [8, 9]]


def test_a_graph_without_links_has_no_mesh():
    edges, triangles = skeletal_mesh(circle(4), NO_POINTS, graph(4), graph(4))
    assert edges.shape == (0, 2)
    assert triangles.shape == (0, 3)
