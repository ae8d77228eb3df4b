import numpy as np
import pytest

from morphoskel.surface.ponq.quadrics import fit_quadric_vertices


def corner_samples(corner, planes, count=30, seed=0):
    """Samples of the planes through `corner` perpendicular to the first `planes` axes."""
    generator = np.random.default_rng(seed)
    points, normals = [], []
    for axis in range(planes):
        patch = np.asarray(corner) + generator.uniform(-0.1, 0.1, size=(count, 3))
        patch[:, axis] = corner[axis]
        points.append(patch)
        normals.append(np.tile(np.eye(3)[axis], (count, 1)))
    return np.vstack(points), np.vstack(normals)


def fit_naively(points, normals, sites):
    nearest = np.linalg.norm(points[:, None] - sites, axis=2).argmin(axis=1)
    for site in np.unique(nearest):
        own = np.flatnonzero(nearest == site)
        quadric = np.zeros((4, 4))
        for i in own:
            plane = np.append(normals[i], -normals[i] @ points[i])
            quadric += np.outer(plane, plane) / len(own)
        block, column = quadric[:3, :3], -quadric[:3, 3]
        position = sites[site] + np.linalg.pinv(block, rcond=0.05) @ (column - block @ sites[site])
        yield position, normals[own].mean(axis=0), quadric / np.linalg.norm(block, 2)


def test_vertices_are_those_of_a_loop_over_the_cells():
    generator = np.random.default_rng(4)
    points = generator.uniform(-0.6, 0.6, size=(400, 3))
    # Normals that vary smoothly, so that the minimisers stay in the cube.
    normals = points + np.array([0, 0, 2])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    sites = points[:50] + 0.01
    expected = list(fit_naively(points, normals, sites))
    vertices = fit_quadric_vertices(points, normals, sites)
    assert len(vertices) == len(expected)
    positions = np.array([row[0] for row in expected])
    assert (np.abs(positions) < 1).all()
    order, expected_order = np.argsort(vertices.positions[:, 0]), np.argsort(positions[:, 0])
    for ours, theirs in zip(
        (vertices.positions, vertices.normals, vertices.quadrics), zip(*expected, strict=True), strict=True
    ):
        assert np.allclose(ours[order], np.array(theirs)[expected_order])


@pytest.mark.parametrize("planes", [1, 2, 3])
def test_a_vertex_moves_onto_the_planes_and_along_none_of_them(planes):
    corner, site = np.array([0.3, -0.2, 0.5]), np.array([0.33, -0.15, 0.46])
    vertices = fit_quadric_vertices(*corner_samples(corner, planes), site[None])
    assert np.allclose(vertices.positions[0], np.where(np.arange(3) < planes, corner, site))
    assert np.allclose(vertices.normals[0], np.where(np.arange(3) < planes, 1 / planes, 0))
    homogeneous = np.append(vertices.positions[0], 1)
    assert homogeneous @ vertices.quadrics[0] @ homogeneous == pytest.approx(0, abs=1e-12)
    assert np.linalg.norm(vertices.quadrics[0][:3, :3], 2) == pytest.approx(1)


def test_an_empty_cell_has_no_vertex():
    points, normals = corner_samples([0, 0, 0], 1)
    vertices = fit_quadric_vertices(points, normals, np.array([[0, 0, 0], [0.9, 0.9, 0.9]]))
    assert len(vertices) == 1


def test_vertices_in_the_same_place_become_one():
    points, normals = corner_samples([0.1, 0.2, 0.3], 3, count=300)
    sites = np.array([[0.12, 0.22, 0.32], [0.08, 0.18, 0.28]])
    assert len(fit_quadric_vertices(points, normals, sites)) == 1
    one = fit_quadric_vertices(points, normals, sites[:1])
    two = fit_quadric_vertices(points, normals, sites)
    # The cells of both sites together hold the same samples as the cell of one.
    assert np.allclose(two.normals, one.normals)
    assert np.allclose(two.quadrics, one.quadrics)


def test_a_minimiser_outside_the_cube_is_replaced_by_its_site():
    # Two planes at 45 degrees; each pair meets in a line along y.
    normals = np.array([[0.0, 0.0, 1.0], [np.sqrt(0.5), 0.0, np.sqrt(0.5)]])
    site = np.array([[0.4, 0.1, 0.1]])
    near = np.array([[0.0, 0.0, 0.0], [0.8, 0.0, 0.0]])
    assert np.allclose(fit_quadric_vertices(near, normals, site).positions, [[0.8, 0.1, 0.0]])
    far = np.array([[0.0, 0.0, 0.0], [0.8, 0.0, 0.8]])
    assert np.array_equal(fit_quadric_vertices(far, normals, site).positions, site)
