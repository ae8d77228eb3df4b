import itertools

import numpy as np
import pytest

from morphoskel.errors import ShapeError
from morphoskel.surface.ponq.cut import Faces, collect_faces, cut_surface, face_capacities
from morphoskel.surface.ponq.quadrics import QuadricVertices
from morphoskel.surface.ponq.tetrahedra import INSIDE, OUTSIDE, UNDECIDED, tetrahedralise


def random_vertices(count, seed):
    generator = np.random.default_rng(seed)
    normals = generator.normal(size=(count, 3))
    factors = generator.normal(size=(count, 4, 4))
    return QuadricVertices(generator.uniform(-0.8, 0.8, size=(count, 3)), normals, factors @ np.moveaxis(factors, 1, 2))


def capacity_naively(corners, normals, quadrics, grid):
    """Capacity of one face whose outward side is counter-clockwise."""
    distance, angle = 0.0, 0.0
    face_normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    for i in range(3):
        for j in range(3):
            if i != j:
                homogeneous = np.append(corners[j], 1)
                distance += homogeneous @ quadrics[i] @ homogeneous
        cosine = face_normal @ normals[i] / np.linalg.norm(face_normal) / np.linalg.norm(normals[i])
        angle += np.arccos(cosine)
    return grid**2 * distance + (angle / 1.5) ** 2


def test_every_inner_face_is_listed_once_and_looks_at_its_second_side():
    vertices = random_vertices(40, 0)
    tetrahedra = tetrahedralise(vertices.positions)
    faces = collect_faces(tetrahedra)
    shared = [(min(t, u), max(t, u)) for t, row in enumerate(tetrahedra.neighbours) for u in row if u >= 0 and t < u]
    assert sorted(map(tuple, np.sort(faces.sides, axis=1))) == sorted(shared)
    for triangle, (first, second) in zip(faces.vertices, faces.sides, strict=True):
        a, b, c = tetrahedra.positions[triangle]
        normal = np.cross(b - a, c - a)
        for tetrahedron, sign in ((first, -1), (second, 1)):
            assert set(triangle) < set(tetrahedra.vertices[tetrahedron])
            barycentre = tetrahedra.positions[tetrahedra.vertices[tetrahedron]].mean(axis=0)
            assert sign * (normal @ (barycentre - a)) > 0


def test_capacities_are_those_of_a_loop_over_the_vertices():
    vertices = random_vertices(30, 1)
    triangles = np.array(list(itertools.combinations(range(8), 3)))
    faces = Faces(triangles, np.zeros((len(triangles), 2), dtype=np.int64))
    first_inside, second_inside = face_capacities(faces, vertices, grid=5)
    for f, triangle in enumerate(triangles):
        for capacity, order in ((first_inside[f], triangle), (second_inside[f], triangle[::-1])):
            parts = (vertices.positions[order], vertices.normals[order], vertices.quadrics[order])
            assert capacity == pytest.approx(capacity_naively(*parts, grid=5))


def test_faces_and_vertices_without_a_direction_have_a_finite_capacity():
    vertices = random_vertices(4, 2)
    vertices.positions[2] = (vertices.positions[0] + vertices.positions[1]) / 2
    vertices.normals[3] = 0
    faces = Faces(np.array([[0, 1, 2], [0, 1, 3]]), np.zeros((2, 2), dtype=np.int64))
    capacities = np.array(face_capacities(faces, vertices, grid=1))
    assert np.isfinite(capacities).all()
    assert (capacities > 0).all()


@pytest.mark.parametrize("seed", range(6))
def test_no_other_cut_is_cheaper(seed):
    vertices = random_vertices(12, seed)
    tetrahedra = tetrahedralise(vertices.positions)
    inner = np.flatnonzero((tetrahedra.vertices < 12).all(axis=1))
    generator = np.random.default_rng(seed)
    tags = np.full(len(tetrahedra.vertices), OUTSIDE)
    tags[inner] = generator.choice([OUTSIDE, INSIDE], size=len(inner))
    free = generator.choice(inner, size=min(10, len(inner) - 1), replace=False)
    tags[free] = UNDECIDED
    tags[np.setdiff1d(inner, free)[0]] = INSIDE

    faces = collect_faces(tetrahedra)
    padded = QuadricVertices(
        tetrahedra.positions,
        np.vstack([vertices.normals, np.zeros((8, 3))]),
        np.vstack([vertices.quadrics, np.zeros((8, 4, 4))]),
    )
    first_inside, second_inside = face_capacities(faces, padded, grid=3)

    def cost(inside):
        one, two = inside[faces.sides].T
        return first_inside[one & ~two].sum() + second_inside[two & ~one].sum()

    cheapest = np.inf
    for choice in itertools.product([False, True], repeat=len(free)):
        inside = tags == INSIDE
        inside[free] = choice
        cheapest = min(cheapest, cost(inside))

    triangles = cut_surface(tetrahedra, vertices, tags, grid=3)
    capacity_of = {}
    for f, triangle in enumerate(faces.vertices):
        for turn in range(3):
            capacity_of[tuple(np.roll(triangle, turn))] = first_inside[f]
            capacity_of[tuple(np.roll(triangle[::-1], turn))] = second_inside[f]
    assert sum(capacity_of[tuple(triangle)] for triangle in triangles) == pytest.approx(cheapest)


def test_an_empty_cut_is_an_error():
    vertices = random_vertices(10, 7)
    tetrahedra = tetrahedralise(vertices.positions)
    tags = np.full(len(tetrahedra.vertices), OUTSIDE)
    with pytest.raises(ShapeError, match=f"the cut is empty, none of {len(tags)} tetrahedra is inside"):
        cut_surface(tetrahedra, vertices, tags, grid=8)
