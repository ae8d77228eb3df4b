import numpy as np
import pytest
import torch

from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.shapes import PointCloud
from morphoskel.skeleton.point2skeleton import point2skeleton


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def network():
    torch.manual_seed(0)
    settings = Point2SkeletonSettings(
        points=300,
        skeletal_points=30,
        centroids=(100, 60),
        radii=((0.3, 0.5), (0.8,)),
        neighbours=((4, 8), (8,)),
        channels=((8, 8), (16, 16)),
        head_channels=(16,),
        initial_sharpness=8.0,
        node_features=4,
        graph_channels=(8, 8, 8, 12),
    )
    return Point2SkeletonNetwork(settings).eval()


@pytest.fixture(scope="module")
def cloud():
    """Return 400 points on an ellipsoid."""
    directions = np.random.default_rng(0).normal(size=(400, 3))
    return PointCloud(directions / np.linalg.norm(directions, axis=1, keepdims=True) * (1, 0.6, 0.3))


def test_balls_inside_and_a_mesh_between_them(network, cloud):
    skeleton = point2skeleton(cloud, network)
    assert len(skeleton) == 30
    assert (np.abs(skeleton.points) <= (1, 0.6, 0.3)).all()
    assert (skeleton.radii > 0).all()
    assert len(skeleton.edges) + len(skeleton.triangles) > 0
    # Every point is linked to its nearest neighbour, so no ball is left alone.
    assert set(skeleton.edges.ravel()) | set(skeleton.triangles.ravel()) == set(range(30))


def test_the_same_cloud_gives_the_same_skeleton_and_leaves_the_network_as_it_was(network, cloud):
    before = {name: value.clone() for name, value in network.state_dict().items()}
    network.train()
    first = point2skeleton(cloud, network)
    assert network.training
    network.eval()
    second = point2skeleton(cloud, network)
    for name in ("points", "radii", "edges", "triangles"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
    assert all(torch.equal(before[name], value) for name, value in network.state_dict().items())


def test_units_do_not_matter(network, cloud):
    skeleton = point2skeleton(cloud, network)
    moved = point2skeleton(PointCloud(cloud.points * 64 + (128, 0, -256)), network)
    np.testing.assert_allclose((moved.points - (128, 0, -256)) / 64, skeleton.points, atol=1e-4)
    np.testing.assert_allclose(moved.radii / 64, skeleton.radii, atol=1e-4)


def test_the_mesh_is_nearer_than_its_corners(network, cloud):
    """Refined radii combine distances to the mesh, which are at most those to the skeletal points."""
    refined, raw = point2skeleton(cloud, network), point2skeleton(cloud, network, refine_radii=False)
    np.testing.assert_array_equal(refined.points, raw.points)
    np.testing.assert_array_equal(refined.triangles, raw.triangles)
    assert (refined.radii <= raw.radii + 1e-9).all()
    assert refined.radii.mean() < raw.radii.mean()


def test_fewer_points_than_the_network_takes(network, cloud):
    assert len(point2skeleton(PointCloud(cloud.points[:50]), network)) == 30
