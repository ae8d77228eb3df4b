import numpy as np
import open3d
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import ball, box, joined, random_parts, random_rotation, torus, two_components

from morphoskel.shapes import Mesh
from morphoskel.volume import SurfaceDistance


def uniform(count, seed=0, scale=1.5):
    return np.random.default_rng(seed).uniform(-scale, scale, (count, 3)).astype(np.float32)


def distance_naive(mesh, points):
    """Smallest distance to any triangle, by projecting on each edge and, where there is one, on the plane."""
    best = np.full(len(points), np.inf)
    for a, b, c in mesh.vertices[mesh.triangles]:
        for start, end in ((a, b), (b, c), (c, a)):
            along = end - start
            share = np.clip((points - start) @ along / max(along @ along, 1e-300), 0, 1)
            best = np.minimum(best, np.linalg.norm(points - start - share[:, None] * along, axis=1))
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length > 0:
            height = (points - a) @ (normal / length)
            foot = points - height[:, None] * (normal / length)
            turns = [np.cross(end - start, foot - start) @ normal for start, end in ((a, b), (b, c), (c, a))]
            best = np.where(np.all([turn > 0 for turn in turns], axis=0), np.minimum(best, np.abs(height)), best)
    return best


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 40))
def test_equals_the_naive_twin_on_random_soups(seed, count):
    generator = np.random.default_rng(seed)
    vertices = generator.normal(size=(24, 3))
    mesh = Mesh(vertices, generator.integers(0, 24, (count, 3)))  # some with repeated corners: segments and points
    points = uniform(150, seed)
    assert np.abs(SurfaceDistance(mesh)(points) - distance_naive(mesh, points.astype(float))).max() < 1e-6


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10_000))
def test_equals_the_naive_twin_on_thin_parts_slivers_and_duplicated_vertices(seed):
    mesh = joined(random_parts(seed))
    points = uniform(100, seed)
    assert np.abs(SurfaceDistance(mesh)(points) - distance_naive(mesh, points.astype(float))).max() < 1e-6


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_scale_does_not_matter(scale):
    mesh, points = torus(), uniform(2000)
    scaled = SurfaceDistance(Mesh(mesh.vertices * scale, mesh.triangles))((points.astype(float) * scale).astype("f4"))
    assert np.abs(scaled / scale - SurfaceDistance(mesh)(points)).max() < 1e-6


@pytest.mark.parametrize("mesh", [ball(), box(2, 1, 0.1), torus(), two_components()])
def test_agrees_with_open3d(mesh):
    points = uniform(50_000)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    assert np.abs(SurfaceDistance(mesh)(points) - scene.compute_distance(points).numpy()).max() <= 1e-6


def test_box_is_analytic():
    points = uniform(20_000)
    excess = np.abs(points.astype(float)) - np.array([1.0, 0.5, 0.25])
    outside = np.linalg.norm(np.maximum(excess, 0), axis=1)
    expected = np.where((excess < 0).all(axis=1), -excess.max(axis=1), outside)
    assert np.abs(SurfaceDistance(box(2, 1, 0.5))(points) - expected).max() < 1e-7


def test_is_1_lipschitz_and_moves_with_the_shape():
    mesh, points = torus(), uniform(5000)
    udf = SurfaceDistance(mesh)(points)
    gaps = np.linalg.norm(np.diff(points.astype(float), axis=0), axis=1)
    assert (np.abs(np.diff(udf.astype(float))) <= gaps + 1e-6).all()
    turn = random_rotation(4)
    moved = Mesh(mesh.vertices @ turn.T * 3 + 7, mesh.triangles)
    again = SurfaceDistance(moved)((points @ turn.T * 3 + 7).astype(np.float32))
    assert np.abs(again - 3 * udf).max() < 1e-5


def test_middle_of_a_plate_is_a_plateau_to_the_last_bit():
    """Noise in the last bits would break ties between equal balls at random."""
    solid = box(2, 2, 0.25)
    points = uniform(3000, scale=0.8)
    points[:, 2] = 0
    assert (SurfaceDistance(solid)(points) == np.float32(0.125)).all()


def test_order_and_threads_do_not_matter():
    mesh, points = torus(), uniform(40_000)
    distance = SurfaceDistance(mesh)
    one = distance(points)
    order = np.random.default_rng(1).permutation(len(points))
    assert np.array_equal(distance(points, threads=2), one)
    # Another packet may settle on another of two triangles whose distances agree to float32.
    assert np.abs(distance(points[order]) - one[order]).max() < 2e-7


def test_nothing_to_measure():
    assert SurfaceDistance(ball())(np.zeros((0, 3), dtype=np.float32)).shape == (0,)
