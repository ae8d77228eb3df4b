import numpy as np
import pytest
from solids import sphere_cloud

from morphoskel.config import compose
from morphoskel.errors import ConfigError, ShapeError
from morphoskel.shapes import PointCloud
from morphoskel.surface import reconstruct
from morphoskel.surface.reconstruct import SURFACES

METHODS = ["poisson", "ball_pivoting", "alpha_shape", "ponq", "repaired_poisson"]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("normals", [True, False])
def test_a_sphere_is_rebuilt_near_its_points(method, normals):
    settings = {"alpha": 1.5} if method == "alpha_shape" else {}
    mesh = reconstruct(sphere_cloud(2000, normals=normals), method, **settings)
    radii = np.linalg.norm(mesh.vertices[np.unique(mesh.triangles)], axis=1)
    assert np.abs(radii - 1).max() < 0.05


@pytest.mark.parametrize("method", METHODS)
def test_the_same_cloud_gives_the_same_mesh(method):
    cloud = sphere_cloud(1000)
    settings = {"alpha": 1.5} if method == "alpha_shape" else {}
    first, second = (reconstruct(cloud, method, **settings) for _ in range(2))
    assert np.array_equal(first.vertices, second.vertices)
    assert np.array_equal(first.triangles, second.triangles)


def test_poisson_depth_refines_the_mesh():
    sizes = [len(reconstruct(sphere_cloud(3000), depth=depth).triangles) for depth in (5, 7)]
    assert sizes[0] * 2 < sizes[1]


def test_ball_pivoting_leaves_a_hole_that_poisson_closes():
    cloud = sphere_cloud(4000)
    upper = cloud.points[:, 2] > -0.4
    bowl = PointCloud(cloud.points[upper], cloud.normals[upper])
    lowest = {method: reconstruct(bowl, method).bounds[0][2] for method in ("poisson", "ball_pivoting")}
    assert lowest["ball_pivoting"] >= -0.41
    assert lowest["poisson"] < -0.6


def test_ball_pivoting_decimates_a_large_mesh():
    mesh = reconstruct(sphere_cloud(2000), "ball_pivoting", maximum_triangles=1000)
    assert 500 < len(mesh.triangles) <= 1000


def test_alpha_shape_scales_with_the_cloud_unless_told_otherwise():
    cloud = sphere_cloud(2000)
    large = PointCloud(cloud.points * 100)
    relative = [len(reconstruct(shape, "alpha_shape", alpha=1.5).triangles) for shape in (cloud, large)]
    assert relative[0] == relative[1]
    with pytest.raises(ShapeError, match="alpha_shape: no triangle"):
        reconstruct(large, "alpha_shape", alpha=1.5, unit="absolute")


def test_an_unknown_method_is_refused():
    legal = "legal are poisson, ball_pivoting, alpha_shape, ponq, repaired_poisson"
    with pytest.raises(ConfigError, match=legal):
        reconstruct(sphere_cloud(10), "marching")


def test_only_ponq_depends_on_the_seed():
    cloud = sphere_cloud(500)
    settings = {"alpha_shape": {"alpha": 1.5}, "poisson": {"depth": 5}, "repaired_poisson": {"depth": 5}}
    for method in SURFACES:
        first, second = (reconstruct(cloud, method, seed=seed, **settings.get(method, {})) for seed in (0, 1))
        assert np.array_equal(first.vertices, second.vertices) == (method != "ponq"), method


@pytest.mark.parametrize("method", METHODS)
def test_the_configured_settings_are_the_methods(method):
    """Each section of the configuration can be handed to its method as it is."""
    surface = compose(["surface.poisson.depth=5", "surface.repaired_poisson.depth=5", "surface.alpha_shape.alpha=1.5"])
    section = getattr(surface.surface, method).model_dump(mode="json")
    assert len(reconstruct(sphere_cloud(500), method, **section).triangles) > 100
