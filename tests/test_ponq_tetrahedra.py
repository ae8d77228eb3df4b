import numpy as np
import pytest
import scipy.spatial
from solids import sphere_cloud

from morphoskel.errors import ShapeError
from morphoskel.surface.ponq.tetrahedra import (
    INSIDE,
    OUTSIDE,
    UNDECIDED,
    Tetrahedra,
    circumcentres,
    repair_tags,
    tag_tetrahedra,
    tetrahedralise,
)


def random_vertices(count, seed):
    generator = np.random.default_rng(seed)
    directions = generator.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return directions * generator.uniform(0.6, 0.9, size=(count, 1)), directions


def touches_a_corner(tetrahedra):
    return (tetrahedra.vertices >= len(tetrahedra.positions) - 8).any(axis=1)


def test_the_circumcentre_is_equally_far_from_all_corners():
    corners = np.random.default_rng(0).normal(size=(200, 4, 3))
    distances = np.linalg.norm(corners - circumcentres(corners)[:, None], axis=2)
    assert np.allclose(distances, distances[:, :1], rtol=1e-6)


def test_a_flat_tetrahedron_has_its_barycentre_for_a_circumcentre():
    flat = np.array([[[0, 0, 1], [1, 0, 1], [0, 1, 1], [3, 3, 1.0]]])
    assert np.array_equal(circumcentres(flat), [[1, 1, 1]])


def test_the_tetrahedra_fill_the_cube():
    tetrahedra = tetrahedralise(random_vertices(100, 1)[0])
    a, b, c, d = np.moveaxis(tetrahedra.positions[tetrahedra.vertices], 1, 0)
    volumes = np.abs(np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a))) / 6
    assert volumes.sum() == pytest.approx(8)
    # Beyond the hull there is nothing, and at the hull only the corners of the cube.
    assert touches_a_corner(tetrahedra)[(tetrahedra.neighbours == -1).any(axis=1)].all()


def test_a_failure_of_qhull_is_an_error_of_the_shape(monkeypatch):
    def fail(points):
        raise scipy.spatial.QhullError("QH6154 initial simplex is flat")

    monkeypatch.setattr(scipy.spatial, "Delaunay", fail)
    with pytest.raises(ShapeError, match="no Delaunay tetrahedra of 28 points: QH6154 initial simplex is flat"):
        tetrahedralise(random_vertices(20, 0)[0])


def test_tags_are_those_of_a_loop_over_the_vertices():
    positions, normals = random_vertices(60, 2)
    tetrahedra = tetrahedralise(positions)
    tags = tag_tetrahedra(tetrahedra, normals)
    for tag, vertices in zip(tags, tetrahedra.vertices, strict=True):
        if vertices.max() >= 60:
            assert tag == OUTSIDE
            continue
        corners = positions[vertices]
        # The circumcentre solves 2 (v_i - v_0) . c = |v_i|^2 - |v_0|^2.
        squares = (corners**2).sum(axis=1)
        centre = np.linalg.solve(2 * (corners[1:] - corners[0]), squares[1:] - squares[0])
        count = sum((corner - centre) @ normals[v] > 0 for corner, v in zip(corners, vertices, strict=True))
        height = np.mean(
            [(corners.mean(axis=0) - corner) @ normals[v] for corner, v in zip(corners, vertices, strict=True)]
        )
        withdrawn = (count == OUTSIDE and height < 0) or (count == INSIDE and height > 0)
        assert tag == (UNDECIDED if withdrawn else count)
    assert {OUTSIDE, INSIDE} < set(tags)


def test_what_is_inside_a_sphere_is_tagged_so():
    positions = sphere_cloud(300).points * 0.9
    tetrahedra = tetrahedralise(positions)
    tags = tag_tetrahedra(tetrahedra, positions / 0.9)
    corner = touches_a_corner(tetrahedra)
    assert (tags[corner] == OUTSIDE).all()
    assert (tags[~corner] != OUTSIDE).all()
    assert (tags[~corner] == INSIDE).mean() > 0.5


def test_normals_that_leave_nothing_inside_are_refused():
    positions = sphere_cloud(300).points * 0.9
    with pytest.raises(ShapeError, match="is inside by the normals of its vertices; they point inward or contradict"):
        tag_tetrahedra(tetrahedralise(positions), -positions)


def repair_naively(tetrahedra, tags, reach):
    inner = len(tetrahedra.positions) - 8
    repaired = tags.copy()
    for missing, present in ((INSIDE, OUTSIDE), (OUTSIDE, INSIDE)):
        for vertex in range(inner):
            incident = np.flatnonzero((tetrahedra.vertices == vertex).any(axis=1))
            if (tags[incident] == missing).any() or not (tags[incident] == present).any():
                continue
            spreads = {}
            for t in incident:
                corners = tetrahedra.positions[tetrahedra.vertices[t]]
                if tetrahedra.vertices[t].max() < inner:
                    spreads[t] = ((corners - corners.mean(axis=0)) ** 2).sum(axis=1).mean()
            if spreads and min(spreads.values()) < reach:
                repaired[min(spreads, key=spreads.get)] = missing
    return repaired


@pytest.mark.parametrize("reach", [0.0, 0.05, 0.2, 10.0])
def test_the_repair_is_that_of_a_loop_over_the_vertices(reach):
    tetrahedra = tetrahedralise(random_vertices(60, 3)[0])
    tags = np.random.default_rng(0).choice([OUTSIDE, 1, 2, 3, INSIDE], size=len(tetrahedra.vertices))
    tags = np.where(np.random.default_rng(1).random(len(tags)) < 0.6, UNDECIDED, tags)
    tags[touches_a_corner(tetrahedra)] = OUTSIDE
    repaired = repair_tags(tetrahedra, tags, reach=reach)
    assert np.array_equal(repaired, repair_naively(tetrahedra, tags, reach))
    assert (repaired[touches_a_corner(tetrahedra)] == OUTSIDE).all()
    assert np.array_equal(repaired, tags) == (reach == 0.0)


@pytest.mark.parametrize(("present", "missing"), [(OUTSIDE, INSIDE), (INSIDE, OUTSIDE)])
def test_both_verdicts_are_repaired(present, missing):
    tetrahedra = tetrahedralise(random_vertices(60, 4)[0])
    inner = np.flatnonzero(~touches_a_corner(tetrahedra))
    tags = np.full(len(tetrahedra.vertices), UNDECIDED)
    tags[inner[0]] = present
    repaired = repair_tags(tetrahedra, tags, reach=10.0)
    assert (repaired == missing).any()
    # Vertices of that one tetrahedron lacked something; all others lack both verdicts and are left alone.
    changed = tetrahedra.vertices[repaired == missing]
    assert np.isin(changed, tetrahedra.vertices[inner[0]]).any(axis=1).all()


def test_a_vertex_that_qhull_left_out_is_passed_over():
    tetrahedra = tetrahedralise(random_vertices(20, 5)[0])
    lone = Tetrahedra(
        np.vstack([[[0.0, 0.0, 0.0]], tetrahedra.positions]), tetrahedra.vertices + 1, tetrahedra.neighbours
    )
    tags = np.full(len(tetrahedra.vertices), INSIDE)
    assert np.array_equal(repair_tags(lone, tags, reach=1.0), repair_tags(tetrahedra, tags, reach=1.0))
