from itertools import combinations

import numpy as np
import pytest
import trimesh
from scipy.spatial import Delaunay
from scipy.spatial.distance import cdist
from solids import ball, random_rotation, sphere_cloud

from morphoskel.errors import ShapeError
from morphoskel.formats import read_point_cloud
from morphoskel.formats.sample import sample_surface
from morphoskel.shapes import Mesh, PointCloud
from morphoskel.surface import reconstruct, watertight
from morphoskel.surface.reconstruct import reconstruct_repaired
from morphoskel.surface.repair import ALPHA, MISSED, _alpha_triangles, _inside, mean_spacing, patch, repair_surface
from morphoskel.volume import SurfaceDistance

SPHERE = sphere_cloud(1500).points
BALL = ball(subdivisions=4)


def farthest(mesh, points):
    """Largest distance from the points to the mesh, in their mean spacing."""
    return SurfaceDistance(mesh)(points.astype(np.float32)).max() / mean_spacing(points)


def closed(repair):
    return watertight(repair.mesh, seed=0, resolution=5000)


def fine_box(*sides):
    solid = trimesh.creation.box(sides)
    return Mesh(*trimesh.remesh.subdivide_to_size(solid.vertices, solid.faces, 0.08))


def sampled(mesh, count, seed=3):
    return sample_surface(mesh, count, np.random.default_rng(seed)).points


def without_cap(mesh):
    return Mesh(mesh.vertices, mesh.triangles[mesh.vertices[mesh.triangles].mean(axis=1)[:, 2] < 0.7])


def assert_unchanged(repair, mesh):
    np.testing.assert_array_equal(repair.mesh.vertices, mesh.vertices)
    np.testing.assert_array_equal(repair.mesh.triangles, mesh.triangles)
    assert (repair.reason, repair.missed, repair.buried, repair.removed, repair.added) == ("none", 0, 0, 0, 0)


def test_a_surface_that_agrees_with_its_cloud_is_left_alone():
    assert_unchanged(repair_surface(BALL, PointCloud(SPHERE)), BALL)


def test_a_hole_of_cloud_and_surface_is_no_contradiction():
    bowl = PointCloud(SPHERE[SPHERE[:, 2] < 0.65])
    assert_unchanged(repair_surface(without_cap(BALL), bowl), without_cap(BALL))


def test_surface_that_closes_a_hole_of_the_cloud_stays():
    """The cap is far from all points, but nothing says that it is wrong."""
    assert_unchanged(repair_surface(BALL, PointCloud(SPHERE[SPHERE[:, 2] < 0.65])), BALL)


def test_a_cap_that_the_surface_lost_is_given_back():
    repair = repair_surface(without_cap(BALL), PointCloud(SPHERE))
    assert repair.reason == "missed points"
    assert 0 < repair.missed < (SPHERE[:, 2] > 0.7).sum()
    assert repair.buried == repair.removed == 0
    assert farthest(repair.mesh, SPHERE) <= MISSED
    added = repair.mesh.vertices[repair.mesh.triangles[-repair.added :]]
    assert added[..., 2].min() > 0.5
    assert np.linalg.norm(added.mean(axis=1), axis=1) == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize("sides", [(1.5, 1.0, 0.0), (1.5, 0.05, 0.05), (1.5, 0.03, 1.0)])
def test_thin_parts_that_the_surface_lost_are_given_back(sides):
    """A sheet of no thickness, a rod and a board beside a ball; the closed surface still has them."""
    thin = trimesh.creation.box(np.maximum(sides, 1e-9))
    thin.apply_translation([2.0, 0.2, 0.1])
    part = sampled(Mesh(thin.vertices, thin.faces), 500)
    points = np.vstack([SPHERE, part])
    assert farthest(BALL, points) > 10
    repair = repair_surface(BALL, PointCloud(points))
    assert repair.reason == "missed points"
    assert repair.added > 100
    assert repair.removed == 0
    assert farthest(repair.mesh, points) <= MISSED
    np.testing.assert_array_equal(repair.mesh.triangles[: -repair.added], BALL.triangles)
    assert farthest(closed(repair), points) <= 2 * MISSED


def lonely_line(spacing):
    steps = np.cumsum(np.random.default_rng(4).uniform(1.0, 2.0, 25)) * spacing
    """Points on a line, farther from the ball than a strand reaches."""
    return np.array([1.4, 0.0, 0.0]) + steps[:, None] * np.array([0.8, 0.6, 0.0])


def test_strands_run_along_a_line_of_points():
    line = lonely_line(mean_spacing(SPHERE))
    points = np.vstack([SPHERE, line])
    repair = repair_surface(BALL, PointCloud(points))
    strands = repair.mesh.vertices[repair.mesh.triangles[-repair.added :]]
    assert repair.missed == repair.added == len(line)  # a strand a point
    assert len(repair.mesh.vertices) == len(BALL.vertices) + len(points)  # and no speck
    lengths = [np.linalg.norm(strands - strands[:, [corner]], axis=2).max() for corner in range(3)]
    assert max(lengths) < 6 * mean_spacing(points)
    between = (line[:-1] + line[1:]) / 2  # no gaps
    assert SurfaceDistance(repair.mesh)(between.astype(np.float32)).max() < 1e-4
    assert farthest(closed(repair), points) <= MISSED


def test_a_point_by_itself_becomes_a_speck():
    lonely = np.array([[0.0, 0.0, 3.0]])
    points = np.vstack([SPHERE, lonely])
    repair = repair_surface(BALL, PointCloud(points))
    assert (repair.missed, repair.added, repair.reason) == (1, 4, "missed points")
    speck = trimesh.Trimesh(repair.mesh.vertices, repair.mesh.triangles[-4:])
    assert speck.is_watertight
    assert speck.volume > 0
    np.testing.assert_allclose(speck.center_mass, lonely[0])
    corners = cdist(lonely, repair.mesh.vertices[-4:])
    np.testing.assert_allclose(corners, mean_spacing(points) / 2)
    assert farthest(repair.mesh, points) < MISSED


@pytest.fixture(scope="module")
def filled():
    """A bin open at the top, walls 0.1 thick, whose surface was rebuilt as a solid box."""
    outer = sampled(fine_box(1, 1, 1), 2400)
    inner = sampled(fine_box(0.8, 0.8, 0.9), 2000, seed=4) + np.array([0, 0, 0.05])
    opening = (np.abs(outer[:, :2]).max(axis=1) < 0.4) & (outer[:, 2] > 0.499)
    walls = inner[inner[:, 2] < 0.499]
    return fine_box(1, 1, 1), np.vstack([outer[~opening], walls]), walls


def test_a_filled_cavity_is_opened(filled):
    mesh, points, walls = filled
    repair = repair_surface(mesh, PointCloud(points))
    assert repair.reason == "filled cavity and missed points"
    assert 0.5 * len(walls) < repair.buried == repair.missed <= len(walls)
    removed = np.setdiff1d(np.arange(len(mesh.triangles)), _places_of(repair, mesh))
    assert len(removed) == repair.removed
    centroids = mesh.vertices[mesh.triangles[removed]].mean(axis=1)
    assert centroids[:, 2] == pytest.approx(0.5)  # all of the lid, and most of it
    assert np.abs(centroids[:, :2]).max() < 0.4
    assert cdist([[0, 0, 0.5]], centroids).min() < 0.05
    assert farthest(repair.mesh, points) <= MISSED
    surface = watertight(repair.mesh, seed=0)
    spacing = mean_spacing(points)
    left = points[SurfaceDistance(surface)(points.astype(np.float32)) > MISSED * spacing]
    assert len(left) < 0.1 * len(points)
    to_walls = np.column_stack([0.4 - np.abs(left[:, :2]), left[:, 2] + 0.4])
    assert np.sort(to_walls, axis=1)[:, 1].max() < ALPHA * spacing  # the alpha shape rounds the cavity's edges off
    assert _inside(mesh, np.zeros((1, 3))).all()
    assert not _inside(surface, np.array([[0, 0, 0], [0.2, 0.2, 0.3], [0, 0, 0.8]])).any()


def _places_of(repair, mesh):
    kept = repair.mesh.triangles[: len(mesh.triangles) - repair.removed]
    keys = {tuple(triangle): place for place, triangle in enumerate(mesh.triangles.tolist())}
    return [keys[tuple(triangle)] for triangle in kept.tolist()]


def test_a_few_buried_points_open_nothing(filled):
    mesh, _, walls = filled
    shell = sampled(mesh, 3000)
    bin_without_walls = shell[~((np.abs(shell[:, :2]).max(axis=1) < 0.4) & (shell[:, 2] > 0.499))]
    few = np.vstack([bin_without_walls, walls[np.abs(walls[:, :2]).max(axis=1) < 0.3][:5]])
    repair = repair_surface(mesh, PointCloud(few))
    assert (repair.buried, repair.removed, repair.reason) == (5, 0, "missed points")


def test_points_in_one_plane_are_refused_only_where_they_must_be_mended():
    generator = np.random.default_rng(6)
    points = np.column_stack([generator.random((400, 2)), np.zeros(400)])
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    square = Mesh(corners, [[0, 1, 2], [0, 2, 3]])
    assert_unchanged(repair_surface(square, PointCloud(points)), square)
    with pytest.raises(ShapeError, match="the points lie in one plane"):
        repair_surface(Mesh(corners, [[0, 1, 2]]), PointCloud(points))


def circumradius(a, b, c):
    """Solve for the point of the plane that is as far from all corners."""
    normal = np.cross(b - a, c - a)
    equations = np.array([2 * (b - a), 2 * (c - a), normal])
    centre = np.linalg.solve(equations, [b @ b - a @ a, c @ c - a @ a, normal @ a])
    return np.linalg.norm(centre - a)


@pytest.mark.parametrize("alpha", [0.2, 0.35, 10.0])
@pytest.mark.parametrize("seed", [0, 1])
def test_alpha_triangles_equal_their_naive_twin(seed, alpha):
    points = np.random.default_rng(seed).uniform(size=(60, 3))
    faces = {
        tuple(sorted(face)) for simplex in Delaunay(points).simplices.tolist() for face in combinations(simplex, 3)
    }
    expected = sorted(face for face in faces if circumradius(*points[list(face)]) < alpha)
    found = _alpha_triangles(points, alpha)
    assert found.tolist() == [list(face) for face in expected]
    assert 0 < len(found) <= len(faces)


def test_patches_are_only_where_points_are_missed():
    missed = SPHERE[:, 2] > 0.8
    vertices, triangles = patch(SPHERE, missed, mean_spacing(SPHERE))
    assert missed[np.minimum(triangles, len(SPHERE) - 1)].any(axis=1).all()
    assert set(np.flatnonzero(missed)) <= set(triangles.ravel())
    np.testing.assert_array_equal(vertices[: len(SPHERE)], SPHERE)
    nothing = patch(SPHERE, np.zeros(len(SPHERE), dtype=bool), 0.1)
    assert [part.shape for part in nothing] == [(0, 3), (0, 3)]


def test_the_spacing_counts_repeated_points_once():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0]])
    assert mean_spacing(points) == pytest.approx(4 / 3)
    assert mean_spacing(np.vstack([points, points[:2]])) == pytest.approx(4 / 3)


@pytest.mark.parametrize("seed", [0, 1])
def test_moves_and_scales_with_the_shape(filled, seed):
    mesh, points, _ = filled
    line = lonely_line(mean_spacing(points))
    points = np.vstack([points, line])
    turn, shift, size = random_rotation(seed), np.array([0.3, -0.2, 0.5]), 1.7
    plain = repair_surface(mesh, PointCloud(points))
    moved = repair_surface(
        Mesh(size * mesh.vertices @ turn.T + shift, mesh.triangles), PointCloud(size * points @ turn.T + shift)
    )
    assert (moved.missed, moved.buried, moved.removed) == (plain.missed, plain.buried, plain.removed)
    np.testing.assert_array_equal(moved.mesh.triangles, plain.mesh.triangles)
    np.testing.assert_allclose(moved.mesh.vertices, size * plain.mesh.vertices @ turn.T + shift, atol=1e-9)


def test_normals_are_not_used(filled):
    mesh, points, _ = filled
    normals = sphere_cloud(len(points)).points
    plain, with_normals = (repair_surface(mesh, PointCloud(points, given)) for given in (None, normals))
    np.testing.assert_array_equal(with_normals.mesh.triangles, plain.mesh.triangles)
    np.testing.assert_array_equal(with_normals.mesh.vertices, plain.mesh.vertices)


def test_repaired_poisson_is_poisson_mended():
    cloud = sphere_cloud(2000)
    plain = reconstruct(cloud, "poisson", depth=5)
    assert_unchanged(reconstruct_repaired(cloud, depth=5), plain)
    wire = lonely_line(mean_spacing(cloud.points))
    wired = PointCloud(np.vstack([cloud.points, wire]), np.vstack([cloud.normals, np.roll(wire, 1, axis=1)]))
    assert farthest(reconstruct(wired, "poisson", depth=5), wired.points) > MISSED
    assert farthest(reconstruct(wired, "repaired_poisson", depth=5), wired.points) <= MISSED


CONTRADICTED = {
    "03001627/c709aa613431c0538a653a9f65a410f6": True,  # chair
    "03636649/97e63c1f813cb1926f43c7673a499bbc": True,  # lamp, its shade filled
    "03001627/858e512945d4544644175b4dddf5be08": False,  # chair; the closed surface hides sheets inside
}
"""Real clouds far from whose points Poisson reconstruction ends; whether closing the mended surface keeps all of it."""


@pytest.mark.parametrize(("name", "kept_when_closed"), CONTRADICTED.items())
def test_real_clouds_that_poisson_contradicts(real_data, name, kept_when_closed):
    path = real_data / "point2skeleton" / "pointclouds" / f"{name}.ply"
    if not path.is_file():
        pytest.skip(f"{path} is absent")
    cloud = read_point_cloud(path)
    plain = reconstruct(cloud, "poisson")
    assert SurfaceDistance(plain)(cloud.points.astype(np.float32)).max() > 0.2
    repair = repair_surface(plain, cloud)
    assert repair.missed > 0
    assert repair.reason != "none"
    assert farthest(repair.mesh, cloud.points) <= MISSED
    if kept_when_closed:
        assert farthest(watertight(repair.mesh, seed=0), cloud.points) < 3
