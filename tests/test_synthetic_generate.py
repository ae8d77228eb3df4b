import time

import numpy as np
import pytest
from scipy.spatial import cKDTree

from morphoskel.datasets.synthetic import CATEGORIES, PART_NAMES, generate_shape, part_labels
from morphoskel.datasets.synthetic.catalogue import find_builder
from morphoskel.errors import DatasetError, ShapeError

SEED = 7


@pytest.fixture(scope="module")
def shapes():
    """Three shapes of each category."""
    return {
        category: [generate_shape(category, f"{category}-{index}", seed=SEED, points=600) for index in range(3)]
        for category in CATEGORIES
    }


def arrays(shape):
    cloud, mesh = shape.cloud, shape.mesh
    return (cloud.points, cloud.normals, cloud.labels, mesh.vertices, mesh.triangles, shape.triangle_labels)


def distance_to_surface(mesh, point):
    """Distance in double precision; Open3D computes in single, which long thin triangles do not forgive."""
    a, b, c = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
    best = np.inf
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        share = np.clip(((point - start) * along).sum(1) / (along**2).sum(1), 0.0, 1.0)
        best = min(best, np.linalg.norm(start + share[:, None] * along - point, axis=1).min())
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    within = np.ones(len(a), dtype=bool)
    for start, end in ((a, b), (b, c), (c, a)):
        within &= (np.cross(end - start, point - start) * normals).sum(1) >= 0
    heights = np.abs(((point - a) * normals).sum(1))
    return min(best, heights[within].min(initial=np.inf))


def test_labels_follow_shapenetpart():
    counts = [4, 2, 2, 4, 4, 3, 3, 2, 4, 2, 6, 2, 3, 3, 3, 3, 3]
    assert [len(PART_NAMES[category]) for category in CATEGORIES] == counts
    assert [part_labels(category).start for category in CATEGORIES] == np.cumsum([0, *counts[:-1]]).tolist()
    assert part_labels("Chair") == range(12, 16)
    assert part_labels("Table") == range(47, 50)
    assert part_labels("Rifle") == range(50, 53)


def test_a_change_of_any_builder_changes_the_digest_of_the_data():
    from morphoskel import provenance

    modules = {find_builder(category).__module__ for category in CATEGORIES}
    assert len(modules) == len(CATEGORIES)
    assert modules <= set(provenance._imports("morphoskel.datasets.synthetic.catalogue"))


@pytest.mark.parametrize("category", CATEGORIES)
def test_bit_equal_whatever_was_generated_before(category, shapes):
    again = generate_shape(category, f"{category}-2", seed=SEED, points=600)
    for first, second in zip(arrays(shapes[category][2]), arrays(again), strict=True):
        assert first.tobytes() == second.tobytes()


def test_seed_and_id_both_matter():
    base = generate_shape("Chair", "one", seed=1, points=50)
    for other in (generate_shape("Chair", "two", seed=1, points=50), generate_shape("Chair", "one", seed=2, points=50)):
        assert base.mesh.vertices.tobytes() != other.mesh.vertices.tobytes()


def test_the_number_of_points_does_not_change_the_surface():
    few, many = (generate_shape("Lamp", "one", seed=1, points=points) for points in (10, 100))
    assert few.mesh.vertices.tobytes() == many.mesh.vertices.tobytes()


@pytest.mark.parametrize("category", CATEGORIES)
def test_surfaces_are_watertight_connected_and_solid(category, shapes):
    import trimesh

    for shape in shapes[category]:
        mesh = trimesh.Trimesh(shape.mesh.vertices, shape.mesh.triangles, process=False)
        assert mesh.is_watertight
        assert mesh.is_winding_consistent
        assert mesh.volume > 1e-3
        assert mesh.body_count == 1
        assert len(np.unique(shape.mesh.triangles)) == len(shape.mesh.vertices)
        assert len(np.unique(shape.mesh.vertices, axis=0)) == len(shape.mesh.vertices)
        assert mesh.euler_number <= 2
        assert mesh.euler_number % 2 == 0


@pytest.mark.parametrize("category", CATEGORIES)
def test_shapes_are_normalised_and_fit_float32(category, shapes):
    for shape in shapes[category]:
        low, high = shape.mesh.bounds
        assert np.allclose(low, -high, atol=1e-5)
        assert np.linalg.norm(shape.mesh.vertices, axis=1).max() == pytest.approx(1.0, abs=1e-5)
        for array in (shape.mesh.vertices, shape.cloud.points, shape.cloud.normals):
            assert np.array_equal(array, array.astype(np.float32))


@pytest.mark.parametrize("category", CATEGORIES)
def test_points_lie_on_the_surface_with_outward_unit_normals(category, shapes):
    import open3d as o3d

    for shape in shapes[category]:
        scene = o3d.t.geometry.RaycastingScene()
        scene.add_triangles(shape.mesh.vertices.astype(np.float32), shape.mesh.triangles.astype(np.uint32))
        points, normals = shape.cloud.points, shape.cloud.normals
        assert max(distance_to_surface(shape.mesh, point) for point in points[:40]) < 1e-6
        nearest = scene.compute_closest_points(points.astype(np.float32))
        assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
        # A sample on an edge may be given to either side by the closest-point query.
        labels = shape.triangle_labels[nearest["primitive_ids"].numpy()]
        assert (labels == shape.cloud.labels).mean() > 0.99
        for step, occupied in ((-1e-4, 1.0), (1e-4, 0.0)):
            occupancy = scene.compute_occupancy((points + step * normals).astype(np.float32), nsamples=3).numpy()
            assert (occupancy == occupied).mean() > 0.99


@pytest.mark.parametrize("category", CATEGORIES)
def test_every_part_occurs_often_and_no_other_label(category):
    count = 20
    seen = np.zeros(max(part_labels("Rifle")) + 1, dtype=int)
    for index in range(count):
        labels = generate_shape(category, f"parts-{index}", seed=SEED, points=2000).cloud.labels
        seen[np.unique(labels)] += 1
    legal = list(part_labels(category))
    assert (seen[legal] >= count // 5).all(), dict(zip(PART_NAMES[category], seen[legal], strict=True))
    assert seen.sum() == seen[legal].sum()


@pytest.mark.parametrize("category", CATEGORIES)
def test_shapes_of_a_category_differ(category, shapes):
    clouds = [shape.cloud.points for shape in shapes[category]]
    for first, second in ((0, 1), (0, 2), (1, 2)):
        there, _ = cKDTree(clouds[first]).query(clouds[second])
        back, _ = cKDTree(clouds[second]).query(clouds[first])
        assert max(there.max(), back.max()) > 0.1


def test_at_least_five_shapes_a_second():
    generate_shape("Chair", "warm", seed=SEED)
    start = time.process_time()
    for category in CATEGORIES:
        generate_shape(category, "speed", seed=SEED)
    assert len(CATEGORIES) / (time.process_time() - start) > 5


def test_unknown_categories_are_answered_with_the_nearest():
    with pytest.raises(DatasetError, match=r"'Chiar'.*'Chair'.*Airplane, Bag.*Rifle"):
        generate_shape("Chiar", "one", seed=1)


def test_too_few_points_are_refused():
    with pytest.raises(DatasetError, match="at least 4 points, got 3"):
        generate_shape("Chair", "one", seed=1, points=3)


def test_a_defect_of_a_builder_names_the_shape(monkeypatch):
    from morphoskel.datasets.synthetic import generate
    from morphoskel.datasets.synthetic.assembly import Part
    from morphoskel.datasets.synthetic.primitives import box

    parts = [Part("handle", box((1, 1, 1))), Part("body", box((1, 1, 1), (5, 0, 0)))]
    monkeypatch.setattr(generate, "find_builder", lambda category: lambda generator: parts)
    with pytest.raises(ShapeError, match=r"'mug-test-0001' \(seed 3\).*floats"):
        generate_shape("Mug", "mug-test-0001", seed=3)
