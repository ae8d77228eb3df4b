import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.sample import sample_surface
from morphoskel.shapes import Mesh

# A right triangle of area 0.5 in the plane z = 0 and one of area 1.5 in the plane x = 5; the last has no area.
VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [5, 3, 0], [5, 0, 1]], dtype=np.float64)
MESH = Mesh(VERTICES, np.array([[0, 1, 2], [3, 4, 5], [0, 0, 1]]))
COUNT = 20_000


def test_points_lie_on_the_triangles_with_their_normals():
    cloud = sample_surface(MESH, COUNT, np.random.default_rng(2))
    first = cloud.points[:, 0] < 3
    x, y, z = cloud.points[first].T
    assert (z == 0).all()
    assert ((x >= 0) & (y >= 0) & (x + y <= 1 + 1e-12)).all()
    np.testing.assert_array_equal(cloud.normals[first], np.tile([0, 0, 1], (first.sum(), 1)))
    x, y, z = cloud.points[~first].T
    np.testing.assert_allclose(x, 5)
    assert ((y >= 0) & (z >= 0) & (y / 3 + z <= 1 + 1e-12)).all()
    np.testing.assert_array_equal(cloud.normals[~first], np.tile([1, 0, 0], ((~first).sum(), 1)))


def test_the_density_is_uniform():
    points = sample_surface(MESH, COUNT, np.random.default_rng(2)).points
    first = points[:, 0] < 3
    tolerance = 4 * np.sqrt(0.25 * 0.75 / COUNT)
    assert first.mean() == pytest.approx(0.25, abs=tolerance)
    # The half-sized copy of a triangle at a corner has a quarter of its area, whichever corner.
    barycentric = np.stack([points[first, 0], points[first, 1], 1 - points[first, 0] - points[first, 1]], axis=1)
    tolerance = 4 * np.sqrt(0.25 * 0.75 / first.sum())
    np.testing.assert_allclose((barycentric > 0.5).mean(axis=0), 0.25, atol=tolerance)


def test_the_generator_decides():
    draw = [sample_surface(MESH, 10, np.random.default_rng(seed)).points for seed in (1, 1, 2)]
    np.testing.assert_array_equal(draw[0], draw[1])
    assert (draw[0] != draw[2]).any()


def test_bad_arguments():
    with pytest.raises(InputError, match="samples: expected at least 4"):
        sample_surface(MESH, 3, np.random.default_rng(1))
    with pytest.raises(InputError, match="area of its 1 triangles is 0"):
        sample_surface(Mesh(VERTICES, np.array([[0, 1, 1]])), 10, np.random.default_rng(1))
