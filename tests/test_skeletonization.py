import inspect

import numpy as np
import pytest
from solids import sphere_cloud, torus

import morphoskel
from morphoskel import Mesh, PointCloud, skeletonize
from morphoskel.config import compose
from morphoskel.errors import InputError
from morphoskel.skeletonization import DEFAULT_SEED


def test_defaults_are_those_of_the_configuration():
    defaults = {name: item.default for name, item in inspect.signature(skeletonize).parameters.items()}
    skeleton = compose().skeleton
    assert defaults["candidates"] == skeleton.candidates.count
    assert defaults["mode"] == skeleton.candidates.mode
    assert (defaults["k"], defaults["points"]) == (skeleton.k, skeleton.points)
    assert compose().seed == DEFAULT_SEED


def test_a_mesh_and_its_cloud_give_the_same_circle():
    solid = torus()
    import trimesh

    points, faces = trimesh.sample.sample_surface(trimesh.Trimesh(solid.vertices, solid.triangles), 4000, seed=1)
    normals = trimesh.Trimesh(solid.vertices, solid.triangles).face_normals[faces]
    for shape in (solid, PointCloud(points, normals)):
        skeleton = skeletonize(shape, candidates=60_000, points=20)
        away = np.hypot(np.hypot(skeleton.points[:, 0], skeleton.points[:, 1]) - 1, skeleton.points[:, 2])
        assert np.median(away) < 0.05
        assert np.median(skeleton.radii) == pytest.approx(0.3, abs=0.05)


def test_an_array_is_a_cloud_and_threads_do_not_matter():
    cloud = sphere_cloud(1000)
    from_cloud = skeletonize(cloud, candidates=8000, points=16, threads=1)
    from_array = skeletonize(cloud.points.tolist(), normals=cloud.normals, candidates=8000, points=16, threads=2)
    assert np.array_equal(from_cloud.points, from_array.points)


@pytest.mark.parametrize(
    ("shape", "message"),
    [("dragon.ply", "read_shape"), (np.zeros((3, 2)), r"\(N, 3\)"), (np.zeros((9, 3)), "distinct")],
)
def test_what_is_no_shape_is_refused(shape, message):
    with pytest.raises(InputError, match=message):
        skeletonize(shape)


def test_normals_belong_beside_an_array():
    with pytest.raises(InputError, match="inside the point cloud"):
        skeletonize(sphere_cloud(10), normals=np.zeros((10, 3)))


def test_public_names():
    assert {name: getattr(morphoskel, name).__name__ for name in morphoskel.__all__}["Mesh"] == Mesh.__name__
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = morphoskel.nothing
