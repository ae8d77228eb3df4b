"""The skeletons that theory predicts. Lengths are in units of the mean spacing of the candidates."""

import numpy as np
import pytest
from solids import ball, box, capsule, random_rotation, torus

from morphoskel.shapes import Mesh
from morphoskel.skeleton import ms3d
from morphoskel.volume import Candidates, SurfaceDistance, occupancy

COUNT = 300_000


def skeleton_and_spacing(mesh, points=1024, mode="random", seed=5):
    lower, upper = mesh.bounds
    candidates = Candidates(lower, upper, COUNT, mode, seed)
    return ms3d(mesh, candidates, points=points), (np.prod(upper - lower) / COUNT) ** (1 / 3)


def local_maxima(skeleton):
    return skeleton.points[skeleton.residues == 0]


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_ball_gives_its_centre(mode):
    skeleton, spacing = skeleton_and_spacing(ball(), mode=mode)
    assert 1 <= len(local_maxima(skeleton)) <= 8  # a grid with an even number of nodes has eight next to the centre
    assert np.linalg.norm(skeleton.points[0]) < 1.5 * spacing
    assert skeleton.radii[0] == pytest.approx(1, abs=1.5 * spacing)


def test_capsule_gives_its_axis():
    skeleton, spacing = skeleton_and_spacing(capsule(2.0, 0.5))
    maxima = local_maxima(skeleton)
    beyond = np.maximum(np.abs(maxima[:, 2]) - 1, 0)
    away = np.linalg.norm(np.column_stack([maxima[:, :2], beyond]), axis=1)
    assert len(maxima) >= 15
    assert np.quantile(away, 0.9) < spacing
    assert np.ptp(maxima[:, 2]) > 1.5  # the whole axis, not a piece of it


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_torus_gives_its_circle(mode):
    skeleton, spacing = skeleton_and_spacing(torus(1.0, 0.3), mode=mode)
    maxima = local_maxima(skeleton)
    away = np.hypot(np.hypot(maxima[:, 0], maxima[:, 1]) - 1, maxima[:, 2])
    assert len(maxima) >= 40
    assert np.quantile(away, 0.95) < spacing
    angles = np.sort(np.arctan2(maxima[:, 1], maxima[:, 0]))
    assert np.diff(angles).max() < 0.6
    assert np.median(skeleton.radii[: len(maxima)]) == pytest.approx(0.3, abs=0.01)


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_box_gives_its_bisector_sheets(mode):
    """Inside a box the two nearest pairs of faces are equally far on the medial axis."""
    skeleton, spacing = skeleton_and_spacing(box(2, 1, 1), points=256, mode=mode)
    to_faces = np.sort(np.array([1, 0.5, 0.5]) - np.abs(skeleton.points), axis=1)
    assert np.quantile(to_faces[:, 1] - to_faces[:, 0], 0.8) < spacing


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_plate_gives_its_middle_sheet(mode):
    skeleton, spacing = skeleton_and_spacing(box(2, 2, 0.2), mode=mode)
    assert np.abs(skeleton.points[:, 2]).max() < 0.2 * spacing
    assert np.abs(skeleton.radii - 0.1).max() < 0.2 * spacing


def test_balls_are_inscribed_and_sorted():
    mesh = torus()
    skeleton, _ = skeleton_and_spacing(mesh)
    centres = skeleton.points.astype(np.float32)
    inner = {tuple(point) for point in occupancy(mesh, Candidates(*mesh.bounds, COUNT, seed=5)).inner_points().tolist()}
    assert inner.issuperset(map(tuple, centres.tolist()))
    assert np.abs(SurfaceDistance(mesh)(centres) - skeleton.radii).max() < 1e-7
    assert (np.diff(skeleton.residues) >= 0).all()


def test_residue_agrees_with_open3d_on_the_same_candidates():
    """The released computation, written with Open3D's own calls."""
    import open3d

    mesh = torus()
    candidates = Candidates(*mesh.bounds, 50_000, seed=1)
    points = np.concatenate(list(candidates.chunks()))
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    inner = points[scene.compute_occupancy(points).numpy() > 0]
    udf = scene.compute_distance(inner).numpy()
    search = open3d.core.nns.NearestNeighborSearch(open3d.core.Tensor(inner))
    search.knn_index()
    neighbours, _ = search.knn_search(open3d.core.Tensor(inner), 20)
    residues = udf[neighbours.numpy()].max(axis=1) - udf
    skeleton = ms3d(mesh, candidates, points=len(inner) + 5)
    assert abs(len(skeleton) - len(inner)) <= 5
    matched = {tuple(point): value for point, value in zip(inner.tolist(), residues, strict=True)}
    known = [tuple(point) in matched for point in skeleton.points.tolist()]
    assert sum(known) >= len(inner) - 5
    reference = np.array([matched[tuple(point)] for point in skeleton.points[known].tolist()])
    assert (np.abs(reference - skeleton.residues[known]) > 1e-6).sum() <= 5  # two neighbours equally far in float32


def test_skeleton_turns_and_scales_with_the_shape():
    """A grid in the mesh's own box turns with it only by right angles, so turn by one."""
    mesh = box(2, 1, 0.6)
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    turned = Mesh(mesh.vertices @ turn.T * 2, mesh.triangles)
    first, second = (ms3d(shape, Candidates(*shape.bounds, 27_000, "grid"), points=200) for shape in (mesh, turned))
    assert np.allclose(np.sort(first.radii) * 2, np.sort(second.radii), atol=1e-5)


def test_radii_survive_a_general_motion():
    mesh = torus()
    moved = Mesh(mesh.vertices @ random_rotation(1).T + 5, mesh.triangles)
    median = [np.median(skeleton_and_spacing(shape, points=40)[0].radii) for shape in (mesh, moved)]
    assert median[0] == pytest.approx(median[1], abs=0.01)


def test_threads_do_not_matter():
    mesh = torus()
    candidates = Candidates(*mesh.bounds, 30_000, seed=1)
    one, two = (ms3d(mesh, candidates, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.points, two.points)
    assert np.array_equal(one.residues, two.residues)
