import numpy as np
import pytest
from solids import ball, sphere_cloud

from morphoskel.errors import ShapeError
from morphoskel.placement import FAR, bring_back, bring_near, check_extent, remoteness
from morphoskel.shapes import Mesh, PointCloud, Skeleton


def test_near_shapes_stay_untouched():
    for shape in (ball(subdivisions=1), sphere_cloud(20)):
        near, offset = bring_near(shape)
        assert near is shape
        assert not offset.any()


@pytest.mark.parametrize("distance", [2.5 * FAR, 1e6, -1e9])
def test_far_shapes_come_near_and_their_skeletons_back(distance):
    mesh, cloud = ball(subdivisions=1), sphere_cloud(20)
    for shape in (
        Mesh(mesh.vertices + np.array([distance, 0, 0]), mesh.triangles),
        PointCloud(cloud.points + np.array([distance, 0, 0]), cloud.normals),
    ):
        near, offset = bring_near(shape)
        points = near.vertices if isinstance(near, Mesh) else near.points
        assert np.abs(points).max() < 1.1
        skeleton = bring_back(Skeleton(points, np.ones(len(points))), offset)
        expected = shape.vertices if isinstance(shape, Mesh) else shape.points
        np.testing.assert_allclose(skeleton.points, expected, atol=1e-12)


@pytest.mark.parametrize("scale", [1e-200, 1e-20, 1e20, 1e300])
def test_extents_beyond_single_precision_are_refused(scale):
    with pytest.raises(ShapeError, match=r"PointCloud\(20 points.*has the extent .*rescale it"):
        check_extent(PointCloud(sphere_cloud(20).points * scale))


def test_what_is_moved_keeps_the_rest():
    cloud = sphere_cloud(20)
    near, _ = bring_near(PointCloud(cloud.points + 1e6, cloud.normals, np.arange(20)))
    np.testing.assert_array_equal(near.normals, cloud.normals)
    np.testing.assert_array_equal(near.labels, np.arange(20))


def test_remoteness_is_counted_in_extents():
    assert remoteness(np.array([9.0, 0, 0]), np.array([10.0, 0.5, 0])) == 10
    assert remoteness(np.ones(3), np.ones(3)) == np.inf
