import numpy as np
import open3d
import pytest
import trimesh
from scipy.spatial import cKDTree
from solids import box, random_rotation, sphere_cloud

from morphoskel.errors import ConfigError, ShapeError
from morphoskel.formats import read_point_cloud
from morphoskel.shapes import Mesh, PointCloud
from morphoskel.surface import reconstruct
from morphoskel.surface.ponq import reconstruct_ponq

CELL = 2 / 64


def directed_edges(mesh):
    return np.vstack([mesh.triangles[:, [i, (i + 1) % 3]] for i in range(3)])


def is_closed_and_oriented(mesh):
    """Whether every edge is run through as often in one direction as in the other."""
    edges = directed_edges(mesh)
    return sorted(map(tuple, edges)) == sorted(map(tuple, edges[:, ::-1]))


def euler_characteristic(mesh):
    return len(mesh.vertices) - len(directed_edges(mesh)) // 2 + len(mesh.triangles)


def self_intersects(mesh):
    legacy = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(mesh.vertices), open3d.utility.Vector3iVector(mesh.triangles)
    )
    return legacy.is_self_intersecting()


def sample(mesh, count, seed=0):
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    points, triangles = trimesh.sample.sample_surface(solid, count, seed=seed)
    return PointCloud(points, solid.face_normals[triangles])


def distances(points, mesh):
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    return scene.compute_distance(np.asarray(points, dtype=np.float32)).numpy()


def points_on_box_edges(sides, count):
    """Points along the twelve edges of a box around the origin."""
    half = np.array(sides) / 2
    along = np.linspace(-1, 1, count)
    edges = []
    for axis in range(3):
        for signs in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            edge = np.insert(np.tile(signs, (count, 1)).astype(float), axis, along, axis=1)
            edges.append(edge * half)
    return np.vstack(edges)


@pytest.fixture(scope="module")
def sphere():
    return reconstruct_ponq(sphere_cloud(2000), seed=0)


def test_a_sphere_is_one_closed_surface_of_genus_0(sphere):
    assert is_closed_and_oriented(sphere)
    edges = np.sort(directed_edges(sphere), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    assert euler_characteristic(sphere) == 2
    assert not self_intersects(sphere)
    solid = trimesh.Trimesh(sphere.vertices, sphere.triangles, process=False)
    assert solid.body_count == 1
    assert solid.volume == pytest.approx(4 / 3 * np.pi, rel=0.02)  # positive: it looks outward


def test_a_sphere_is_less_than_two_cells_away(sphere):
    dense = sphere_cloud(20_000, seed=9).points
    assert distances(dense, sphere).max() < 2 * CELL
    assert np.abs(np.linalg.norm(sample(sphere, 20_000).points, axis=1) - 1).max() < 2 * CELL


def test_sharp_edges_of_a_box_are_nearer_than_those_of_poisson():
    sides = (2.0, 1.4, 1.0)
    cloud = sample(box(*sides), 10_000)
    sharp, smooth = reconstruct_ponq(cloud, seed=0), reconstruct(cloud, "poisson", depth=6)
    edges = points_on_box_edges(sides, 100)
    assert distances(edges, sharp).mean() < 0.3 * distances(edges, smooth).mean()
    assert np.median(distances(edges, sharp)) < 1e-3
    assert is_closed_and_oriented(sharp)
    assert euler_characteristic(sharp) == 2
    solid = trimesh.Trimesh(sharp.vertices, sharp.triangles, process=False)
    assert solid.volume == pytest.approx(np.prod(sides), rel=0.005)


def test_a_torus_has_a_hole():
    ring = trimesh.creation.torus(1.0, 0.4, major_sections=96, minor_sections=48)
    mesh = reconstruct_ponq(sample(Mesh(ring.vertices, ring.faces), 3000), seed=0)
    assert is_closed_and_oriented(mesh)
    assert euler_characteristic(mesh) == 0


def test_missing_normals_are_completed():
    mesh = reconstruct_ponq(sphere_cloud(1000, normals=False), seed=0)
    assert is_closed_and_oriented(mesh)
    assert np.abs(np.linalg.norm(mesh.vertices, axis=1) - 1).max() < 2 * CELL


def test_the_seed_decides():
    cloud = sphere_cloud(600)
    first, again, other = (reconstruct_ponq(cloud, seed=seed, steps=20) for seed in (1, 1, 2))
    assert np.array_equal(first.vertices, again.vertices)
    assert np.array_equal(first.triangles, again.triangles)
    assert not np.array_equal(first.vertices, other.vertices)


def test_the_result_moves_and_scales_with_the_cloud():
    cloud = sphere_cloud(600)
    mesh = reconstruct_ponq(cloud, seed=1, steps=20)
    # Powers of two, so that rounding is the same.
    moved = reconstruct_ponq(PointCloud(cloud.points * 64, cloud.normals), seed=1, steps=20)
    assert np.array_equal(moved.triangles, mesh.triangles)
    assert np.allclose(moved.vertices, mesh.vertices * 64, rtol=1e-9)
    shifted = reconstruct_ponq(PointCloud(cloud.points + 1000, cloud.normals), seed=1, steps=20)
    assert np.abs(np.linalg.norm(shifted.vertices - 1000, axis=1) - 1).max() < 2 * CELL


def test_the_released_preset_keeps_nearly_every_point_as_a_vertex():
    cloud = sphere_cloud(1000)
    mesh = reconstruct_ponq(cloud, seed=0, preset="released", sites=5000, steps=30, grid=24)
    assert is_closed_and_oriented(mesh)
    assert len(mesh.vertices) > 0.8 * len(cloud)
    assert cKDTree(cloud.points).query(mesh.vertices)[0].max() < 2 * CELL


def test_repeated_points_count_once():
    cloud = sphere_cloud(400)
    repeated = PointCloud(np.repeat(cloud.points, 4, axis=0), np.repeat(cloud.normals, 4, axis=0))
    mesh = reconstruct_ponq(repeated, seed=0)
    assert is_closed_and_oriented(mesh)
    assert len(mesh.vertices) == 100
    corners = trimesh.creation.box((1, 1, 1)).vertices
    with pytest.raises(ShapeError, match="8 distinct points give 2 sites, and a tetrahedron needs 4"):
        reconstruct_ponq(PointCloud(np.repeat(corners, 50, axis=0)), seed=0)
    with pytest.raises(ShapeError, match="cannot draw 401 sites from 400 distinct points"):
        reconstruct_ponq(repeated, seed=0, sites=401)


@pytest.mark.parametrize("dimensions", [1, 2])
def test_a_flat_cloud_is_refused(dimensions):
    points = np.zeros((100, 3))
    points[:, :dimensions] = np.random.default_rng(0).uniform(size=(100, dimensions))
    with pytest.raises(ShapeError, match="lie in a plane and enclose no volume"):
        reconstruct_ponq(PointCloud(points @ random_rotation(0).T), seed=0)


def test_normals_that_point_inward_are_refused():
    cloud = sphere_cloud(400)
    with pytest.raises(ShapeError, match="they point inward or contradict each other"):
        reconstruct_ponq(PointCloud(cloud.points, -cloud.normals), seed=0)


def test_missing_normals_that_cannot_be_estimated_are_an_error():
    lattice = np.stack(np.meshgrid(*[np.arange(-3, 4)] * 3), axis=-1).reshape(-1, 3)
    cospherical = lattice[(lattice**2).sum(axis=1) == 9]
    with pytest.raises(ShapeError, match=r"the missing normals of 30 points cannot be oriented"):
        reconstruct_ponq(PointCloud(cospherical), seed=0)


def test_a_value_out_of_range_is_refused():
    with pytest.raises(ConfigError, match="sites must be at least 4"):
        reconstruct_ponq(sphere_cloud(100), seed=0, sites=1)


@pytest.mark.parametrize("category", ["02691156", "03001627", "03797390"])
def test_real_clouds_give_closed_surfaces_near_their_points(real_data, category):
    path = sorted((real_data / "point2skeleton" / "pointclouds" / category).glob("*.ply"))[0]
    cloud = read_point_cloud(path)
    mesh = reconstruct_ponq(cloud, seed=0)
    assert is_closed_and_oriented(mesh)
    assert not self_intersects(mesh)
    assert np.median(distances(cloud.points, mesh)) < 0.01
