import numpy as np
import open3d
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import ball, box, joined, random_parts, random_rotation, sphere_cloud, torus, two_components

from morphoskel.errors import ShapeError
from morphoskel.shapes import Mesh, PointCloud
from morphoskel.surface import reconstruct, watertight
from morphoskel.volume import Candidates, SurfaceDistance, occupancy
from morphoskel.volume.occupancy import CROSSED


def all_points(candidates):
    return np.concatenate(list(candidates.chunks()))


def winding_naive(mesh, points):
    """Sum of the solid angles of all triangles (Van Oosterom and Strackee 1983), in whole spheres."""
    total = np.zeros(len(points))
    for triangle in mesh.vertices[mesh.triangles]:
        a, b, c = triangle[:, None] - points
        la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
        dot = [np.einsum("ij,ij->i", *pair) for pair in ((a, b), (b, c), (c, a))]
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        total += 2 * np.arctan2(volume, la * lb * lc + dot[0] * lc + dot[1] * la + dot[2] * lb)
    return np.abs(total) / (4 * np.pi)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.sampled_from(["random", "grid"]), st.integers(8, 4000), st.booleans())
def test_equals_the_naive_twin(seed, mode, count, snug):
    """Thin, overlapping, nested, inside-out parts, slivers, duplicated vertices; boxes snug, too small, too large."""
    parts = random_parts(seed)
    mesh = joined(parts)
    lower, upper = mesh.bounds if snug else np.sort(np.random.default_rng(seed).uniform(-1.5, 1.5, (2, 3)), axis=0)
    candidates = Candidates(lower, upper, count, mode, seed)
    points = all_points(candidates).astype(float)
    expected = np.zeros(len(points), dtype=bool)
    for part in parts:
        expected ^= winding_naive(part, points) > 0.5
    clear = SurfaceDistance(mesh)(points.astype(np.float32)) > 1e-6
    try:
        found = occupancy(mesh, candidates).mask()
    except ShapeError:
        found = np.zeros_like(expected)
    assert np.array_equal(found[clear], expected[clear])


@pytest.mark.parametrize("mode", ["random", "grid"])
@pytest.mark.parametrize("mesh", [ball(), box(2, 1, 0.1), torus(), two_components()])
def test_agrees_with_open3d(mesh, mode):
    """Open3D's single rays are wrong for a point in a million; by a majority of rays they agree."""
    candidates = Candidates(*mesh.bounds, 300_000, mode, 5)
    points = all_points(candidates)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    clear = SurfaceDistance(mesh)(points) > 1e-6
    votes = scene.compute_occupancy(points, nsamples=5).numpy() > 0
    assert np.array_equal(occupancy(mesh, candidates).mask()[clear], votes[clear])


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_share_inside_is_the_share_of_volume(mode):
    mesh = ball()
    candidates = Candidates(*mesh.bounds, count=300_000, mode=mode, seed=2)
    # Grid nodes stand for cells centred on them, so half a cell sticks out of the box on every side.
    box_share = 1 if mode == "random" else (1 - 1 / candidates.nodes_per_axis) ** 3
    share = len(occupancy(mesh, candidates)) / len(candidates)
    assert share == pytest.approx(np.pi / 6 * box_share, abs=0.005)


@pytest.mark.parametrize("mode", ["random", "grid"])
@pytest.mark.parametrize("threads", [1, 2])
def test_inner_points_are_all_candidates_less_those_outside(mode, threads):
    """What is made without the tiles outside is what rejection leaves of all candidates, to the last bit."""
    mesh = torus()
    candidates = Candidates(*mesh.bounds, 200_000, mode, 3)
    result = occupancy(mesh, candidates, threads=threads)
    assert np.array_equal(result.inner_points(threads=threads), all_points(candidates)[result.mask()])
    assert len(result) == result.mask().sum()


def test_most_tiles_are_settled_as_a_whole():
    mesh = ball()
    result = occupancy(mesh, Candidates(*mesh.bounds, 2_000_000, seed=1))
    assert (result.states == CROSSED).mean() < 0.2


def test_points_in_line_with_edges_and_corners_are_not_confused():
    """A grid on a box: every line along an axis runs through edges, corners and faces seen edge-on."""
    mesh = box(2, 2, 2)
    candidates = Candidates(np.full(3, -2.0), np.full(3, 2.0), 17**3, "grid")
    points = np.abs(all_points(candidates)).max(axis=1)
    mask = occupancy(mesh, candidates).mask()
    assert mask[points < 1].all()
    assert not mask[points > 1].any()


def test_no_point_far_from_a_thin_shell_is_taken_for_inside():
    """A single point outside, taken for inside, would be the largest ball of the skeleton, with residue 0."""
    cloud = sphere_cloud(2000)
    above = cloud.points[:, 2] > 0
    bowl = reconstruct(PointCloud(cloud.points[above], cloud.normals[above]), "ball_pivoting")
    shell = watertight(bowl, seed=1)
    inner = occupancy(shell, Candidates(*shell.bounds, count=1_000_000, seed=1)).inner_points()
    assert np.abs(np.linalg.norm(inner, axis=1) - 1).max() < 0.1


def test_far_from_the_origin():
    """Float32 resolves 6e-5 there; points may be rounded across the sides of their tiles."""
    mesh = ball()
    far = Mesh(mesh.vertices + 1000, mesh.triangles)
    candidates = Candidates(*far.bounds, 100_000, seed=2)
    radius = np.linalg.norm(all_points(candidates).astype(float) - 1000, axis=1)
    mask = occupancy(far, candidates).mask()
    assert mask[radius < 0.998].all()
    assert not mask[radius > 1.001].any()


def test_orientation_does_not_matter_and_a_turned_shape_has_the_same_share():
    mesh = torus()
    candidates = Candidates(*mesh.bounds, 50_000, seed=1)
    flipped = Mesh(mesh.vertices, mesh.triangles[:, ::-1])
    assert np.array_equal(occupancy(flipped, candidates).mask(), occupancy(mesh, candidates).mask())
    turned = Mesh(mesh.vertices @ random_rotation(3).T, mesh.triangles)
    boxes = [Candidates(np.full(3, -1.5), np.full(3, 1.5), 200_000, seed=1) for _ in range(2)]
    shares = [len(occupancy(shape, box)) / 200_000 for shape, box in zip((mesh, turned), boxes, strict=True)]
    assert shares[0] == pytest.approx(shares[1], abs=0.005)


def test_threads_do_not_matter():
    mesh = torus()
    candidates = Candidates(*mesh.bounds, 300_000, seed=1)
    assert np.array_equal(occupancy(mesh, candidates, threads=2).mask(), occupancy(mesh, candidates).mask())


def test_an_open_surface_is_refused():
    mesh = ball(subdivisions=2)
    with pytest.raises(ShapeError, match=r"not closed: 3 of its 480 edges.*watertight"):
        occupancy(Mesh(mesh.vertices, mesh.triangles[1:]), Candidates(*mesh.bounds, 1000))


def test_nothing_inside_is_an_error_that_helps():
    candidates = Candidates(np.full(3, 5.0), np.full(3, 6.0), count=1000)
    with pytest.raises(ShapeError, match=r"none of the 1,000 candidates.*skeleton\.candidates\.count"):
        occupancy(ball(), candidates)
