import numpy as np
import open3d
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import ball, box, random_rotation, sphere_cloud, torus, two_components

from morphoskel.shapes import Mesh, PointCloud
from morphoskel.surface import reconstruct, watertight
from morphoskel.volume import Candidates, SurfaceQuery


def uniform(count, seed=0, scale=1.5):
    return np.random.default_rng(seed).uniform(-scale, scale, (count, 3)).astype(np.float32)


@pytest.mark.parametrize("mesh", [ball(), box(2, 1, 0.1), torus(), two_components()])
def test_agrees_with_open3d_on_all_cores(mesh):
    """The inside test may differ for a handful of points on the surface, the distance by 1e-6."""
    points = uniform(50_000)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    query = SurfaceQuery(mesh)
    assert (query.occupancy(points) != (scene.compute_occupancy(points).numpy() > 0)).sum() <= 5
    assert np.abs(query.udf(points) - scene.compute_distance(points).numpy()).max() <= 1e-6


def test_box_inside_and_distance_are_analytic():
    points = uniform(20_000)
    half = np.array([1.0, 0.5, 0.25])
    excess = np.abs(points) - half
    inside = (excess < 0).all(axis=1)
    outside_distance = np.linalg.norm(np.maximum(excess, 0), axis=1)
    expected = np.where(inside, -excess.max(axis=1), outside_distance)
    query = SurfaceQuery(box(2, 1, 0.5))
    clear = np.abs(expected) > 1e-5
    assert np.array_equal(query.occupancy(points)[clear], inside[clear])
    assert np.abs(query.udf(points) - expected).max() < 1e-5


def test_no_point_far_from_a_thin_shell_is_taken_for_inside():
    """Rays through edges made single points outside the largest balls of a skeleton, one or two in a million."""
    cloud = sphere_cloud(2000)
    above = cloud.points[:, 2] > 0
    bowl = reconstruct(PointCloud(cloud.points[above], cloud.normals[above]), "ball_pivoting")
    shell = watertight(bowl, seed=1)
    query = SurfaceQuery(shell)
    for chunk in Candidates(*shell.bounds, count=1_000_000, seed=1).chunks():
        far = np.abs(np.linalg.norm(chunk, axis=1) - 1) > 0.1
        assert not query.occupancy(chunk)[far].any()


def test_a_ray_that_miscounts_is_outvoted():
    query, points = SurfaceQuery(ball()), uniform(1000)
    truth = query.occupancy(points)
    honest = query._scene

    class Miscounting:
        def compute_occupancy(self, points, nthreads, nsamples):
            votes = honest.compute_occupancy(points, nthreads=nthreads, nsamples=nsamples)
            if nsamples == 1:
                votes[int(np.flatnonzero(~truth)[0])] = 1.0
            return votes

    query._scene = Miscounting()
    assert np.array_equal(query.occupancy(points), truth)


def naive_distance(mesh, points):
    """Smallest distance to any triangle, by projecting on each plane and on each edge."""
    corners = mesh.vertices[mesh.triangles]
    best = np.full(len(points), np.inf)
    for a, b, c in corners:
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        for start, end in ((a, b), (b, c), (c, a)):
            along = end - start
            share = np.clip((points - start) @ along / max(along @ along, 1e-30), 0, 1)
            best = np.minimum(best, np.linalg.norm(points - start - share[:, None] * along, axis=1))
        if length > 1e-12:
            height = (points - a) @ (normal / length)
            foot = points - height[:, None] * (normal / length)
            turns = [np.cross(end - start, foot - start) @ normal for start, end in ((a, b), (b, c), (c, a))]
            best = np.where(np.all([turn >= 0 for turn in turns], axis=0), np.minimum(best, np.abs(height)), best)
    return best


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10_000))
def test_distance_equals_the_naive_one_on_random_soups(seed):
    generator = np.random.default_rng(seed)
    vertices = generator.normal(size=(24, 3))
    mesh = Mesh(vertices, [generator.choice(24, 3, replace=False) for _ in range(16)])
    points = uniform(300, seed)
    assert np.abs(SurfaceQuery(mesh).udf(points) - naive_distance(mesh, points.astype(float))).max() < 1e-5


def test_distance_is_1_lipschitz_and_moves_with_the_shape():
    mesh, points = torus(), uniform(5000)
    udf = SurfaceQuery(mesh).udf(points)
    gaps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert (np.abs(np.diff(udf)) <= gaps + 1e-5).all()
    turn = random_rotation(4)
    moved = Mesh(mesh.vertices @ turn.T * 3 + 7, mesh.triangles)
    again = SurfaceQuery(moved).udf((points @ turn.T * 3 + 7).astype(np.float32))
    assert np.abs(again - 3 * udf).max() < 1e-4


def test_threads_do_not_change_results():
    mesh, points = torus(), uniform(20_000)
    one, two = SurfaceQuery(mesh, threads=1), SurfaceQuery(mesh, threads=2)
    assert np.array_equal(one.occupancy(points), two.occupancy(points))
    assert np.array_equal(one.udf(points), two.udf(points))
