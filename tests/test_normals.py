import numpy as np
import pytest
from solids import sphere_cloud

from morphoskel.errors import ShapeError
from morphoskel.shapes import PointCloud
from morphoskel.surface.normals import complete_normals


def test_known_normals_are_kept_and_scaled():
    cloud = sphere_cloud(200)
    longer = PointCloud(cloud.points, cloud.normals * 3)
    assert np.allclose(complete_normals(longer), cloud.normals)


@pytest.mark.parametrize("unknown", [1, 60, 190])
def test_zero_normals_are_filled_pointing_outward(unknown):
    cloud = sphere_cloud(200)
    normals = cloud.normals.copy()
    normals[:unknown] = 0
    completed = complete_normals(PointCloud(cloud.points, normals))
    assert np.allclose(np.linalg.norm(completed, axis=1), 1)
    assert np.allclose(completed[unknown:], normals[unknown:], atol=1e-12)
    assert (np.einsum("ij,ij->i", completed, cloud.points) > 0.8).all()


@pytest.mark.parametrize("given", [None, np.zeros((500, 3))])
def test_missing_normals_are_estimated_pointing_outward(given):
    points = sphere_cloud(500).points
    completed = complete_normals(PointCloud(points, given))
    assert (np.einsum("ij,ij->i", completed, points) > 0.9).all()


def test_the_smallest_cloud_has_normals():
    tetrahedron = PointCloud([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert np.allclose(np.linalg.norm(complete_normals(tetrahedron), axis=1), 1)


def test_points_in_a_plane_have_no_outside():
    flat = np.column_stack([np.random.default_rng(0).random((50, 2)), np.zeros(50)])
    with pytest.raises(ShapeError, match="one plane"):
        complete_normals(PointCloud(flat))
