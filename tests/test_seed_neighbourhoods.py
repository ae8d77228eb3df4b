from itertools import combinations

import numpy as np
import pytest
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Delaunay

from morphoskel.errors import InputError
from morphoskel.networks.seed_neighbourhoods import delaunay_graph, points_within_hops, seed_neighbourhoods


@pytest.fixture(scope="module")
def cloud():
    """Two plates of points that nearly touch."""
    generator = np.random.default_rng(0)
    return generator.uniform(size=(120, 3)) * (1, 1, 0.01) + (0, 0, 0.1) * (np.arange(120) % 2)[:, None]


def naive_neighbourhood(points, seed, neighbours, hops):
    """Walk breadth first over the edges of all tetrahedra, then take the nearest of what was reached."""
    edges = {frozenset(pair) for cell in Delaunay(points).simplices for pair in combinations(map(int, cell), 2)}
    reached, step = {seed}, 0
    while step < hops or len(reached) < neighbours:
        reached |= {end for edge in edges if edge & reached for end in edge}
        step += 1
    return sorted(reached, key=lambda index: (index != seed, np.sum((points[seed] - points[index]) ** 2), index))[
        :neighbours
    ]


@pytest.mark.parametrize(("neighbours", "hops"), [(9, 1), (30, 1), (60, 2), (9, 4)])
def test_neighbourhoods_are_those_of_the_naive_twin(cloud, neighbours, hops):
    seeds = np.array([0, 7, 50, 119])
    found = seed_neighbourhoods(cloud, seeds, neighbours, "delaunay", hops)
    assert found.shape == (4, neighbours)
    for seed, row in zip(seeds, found, strict=True):
        assert row.tolist() == naive_neighbourhood(cloud, seed, neighbours, hops)


def test_few_hops_bind_and_many_do_not(cloud):
    seeds = np.arange(20)
    nearest = seed_neighbourhoods(cloud, seeds, 12, "nearest", 1)
    distances = np.linalg.norm(cloud[seeds, None] - cloud, axis=-1)
    np.testing.assert_array_equal(nearest, np.argsort(distances, axis=1, kind="stable")[:, :12])
    np.testing.assert_array_equal(seed_neighbourhoods(cloud, seeds, 12, "delaunay", 20), nearest)
    assert not np.array_equal(seed_neighbourhoods(cloud, seeds, 12, "delaunay", 1), nearest)


def test_walks_grow_until_they_have_enough(cloud):
    graph, seeds = delaunay_graph(cloud), np.arange(10)
    one, two = (points_within_hops(graph, seeds, 1, hops) for hops in (1, 2))
    wanted = int(np.median(one.sum(axis=1)))
    grown = points_within_hops(graph, seeds, wanted, 1)
    short = one.sum(axis=1) < wanted
    assert 0 < short.sum() < 10
    np.testing.assert_array_equal(grown[~short], one[~short])
    np.testing.assert_array_equal(grown[short], two[short])
    assert points_within_hops(graph, seeds, len(cloud), 1).all()


@pytest.mark.parametrize("squash", [(1, 1, 0), (1, 0, 0), (0, 0, 0)])
def test_flat_clouds_have_neighbourhoods_too(cloud, squash):
    flat, seeds = cloud * squash, np.arange(30)
    found = seed_neighbourhoods(flat, seeds, 9, "delaunay", 5)
    np.testing.assert_array_equal(found[:, 0], seeds)
    assert all(len(set(row)) == 9 for row in found.tolist())
    np.testing.assert_array_equal(found, seed_neighbourhoods(flat, seeds, 9, "delaunay", 5))


def test_points_in_the_same_place_hang_together(cloud):
    twice = np.repeat(cloud[:40], 2, axis=0)
    graph = delaunay_graph(twice)
    assert connected_components(graph)[0] == 1
    assert (graph != graph.T).nnz == 0
    found = seed_neighbourhoods(twice, np.arange(80), 2, "delaunay", 3)
    assert found.tolist() == [[index, index ^ 1] for index in range(80)]


def test_too_few_points_are_refused(cloud):
    with pytest.raises(InputError, match="a neighbourhood of 9 points needs as many, got 8"):
        seed_neighbourhoods(cloud[:8], np.array([0]), 9, "nearest", 1)
    with pytest.raises(InputError, match="3 points without Delaunay tetrahedra"):
        seed_neighbourhoods(cloud[:3], np.array([0]), 3, "delaunay", 1)
