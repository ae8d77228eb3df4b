import numpy as np
import pytest

from morphoskel.datasets.synthetic.assembly import Part, sample_surface, unite
from morphoskel.datasets.synthetic.primitives import ball, box, rod
from morphoskel.errors import ShapeError


def areas(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def test_provenance_and_normalisation_of_two_boxes():
    mesh, part = unite([Part("low", box((2, 2, 2))), Part("high", box((1, 2, 1), (0, 1, 0)))])
    low, high = mesh.bounds
    assert np.allclose(low, -high, atol=1e-6)
    assert np.linalg.norm(mesh.vertices, axis=1).max() == pytest.approx(1.0, abs=1e-6)
    scale = (high[0] - low[0]) / 2
    assert areas(mesh)[part == 0].sum() == pytest.approx((6 * 4 - 1) * scale**2, rel=1e-5)
    assert areas(mesh)[part == 1].sum() == pytest.approx((4 * 1 + 1) * scale**2, rel=1e-5)


def test_labels_do_not_depend_on_what_was_built_before():
    def build():
        return unite([Part("a", ball(1.0)), Part("b", rod((0, 0, 0), (2, 0, 0), 0.3))])

    first = build()
    for size in range(1, 30):
        box((size, 1, 1)).as_original()
    second = build()
    assert np.array_equal(first[0].vertices, second[0].vertices)
    assert np.array_equal(first[0].triangles, second[0].triangles)
    assert np.array_equal(first[1], second[1])


def test_coordinates_fit_float32():
    mesh, _ = unite([Part("a", ball(1.0)), Part("b", box((3, 0.1, 0.1)))])
    assert np.array_equal(mesh.vertices, mesh.vertices.astype(np.float32))


def test_a_floating_part_is_refused():
    with pytest.raises(ShapeError, match="2 separate solids"):
        unite([Part("a", box((1, 1, 1))), Part("b", box((1, 1, 1), (3, 0, 0)))])


def test_a_buried_part_is_refused():
    with pytest.raises(ShapeError, match=r"part 1 \(core\) lies wholly inside"):
        unite([Part("hull", box((3, 3, 3))), Part("core", box((1, 1, 1)))])


def test_a_part_inside_a_void_is_refused_as_floating():
    hollow = box((3, 3, 3)) - box((2, 2, 2))
    with pytest.raises(ShapeError, match="separate solids"):
        unite([Part("shell", hollow), Part("core", box((1, 1, 1)))])


def test_voids_are_filled():
    hollow = box((3, 3, 3)) - box((2, 2, 2))
    mesh, part = unite([Part("shell", hollow), Part("knob", box((1, 1, 1), (0, 2, 0)))])
    assert set(part) == {0, 1}
    assert (areas(mesh).sum() / (mesh.bounds[1][0] - mesh.bounds[0][0]) ** 2) == pytest.approx((54 + 4) / 9, rel=1e-5)


def test_samples_lie_uniformly_on_the_surface():
    mesh, part = unite([Part("a", box((2, 1, 1))), Part("b", box((0.5, 3, 0.5)))])
    count = 40000
    cloud = sample_surface(mesh, part, count, np.random.default_rng(0))
    share = areas(mesh)[part == 1].sum() / areas(mesh).sum()
    deviation = np.sqrt(share * (1 - share) / count)
    assert (cloud.labels == 1).mean() == pytest.approx(share, abs=4 * deviation)
    centroid = (mesh.vertices[mesh.triangles].mean(axis=1) * areas(mesh)[:, None]).sum(axis=0) / areas(mesh).sum()
    assert np.allclose(cloud.points.mean(axis=0), centroid, atol=4 / np.sqrt(count))


def test_samples_spread_evenly_inside_a_triangle():
    mesh, part = unite([Part("a", box((1, 1, 1)))])
    cloud = sample_surface(mesh, part, 60000, np.random.default_rng(1))
    top = cloud.points[cloud.normals[:, 1] > 0.9]
    half = mesh.bounds[1][0]
    histogram, _, _ = np.histogram2d(top[:, 0], top[:, 2], bins=5, range=[[-half, half]] * 2)
    expected = len(top) / 25
    assert ((histogram - expected) ** 2 / expected).sum() < 52  # chi-squared, 24 degrees of freedom, p = 0.001
