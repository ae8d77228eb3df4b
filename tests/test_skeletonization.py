import dataclasses
import inspect

import numpy as np
import pytest
import torch
from solids import sphere_cloud, torus
from tiny_point2skeleton import TINY

import morphoskel
from morphoskel import Mesh, PointCloud, skeletonize
from morphoskel.batch import arguments_of
from morphoskel.config import compose
from morphoskel.errors import ConfigError, InputError
from morphoskel.formats.sample import sample_surface
from morphoskel.methods import CLOUD_METHODS, METHODS, MORPHOLOGICAL, RANKED
from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork, save_network
from morphoskel.skeleton import ms3d
from morphoskel.skeleton.coverage import coverage_skeleton
from morphoskel.skeleton.coverage_axis import coverage_axis
from morphoskel.skeleton.dpc import DeepPointsSettings
from morphoskel.skeleton.l1_medial import L1MedialSettings
from morphoskel.skeleton.point2skeleton import point2skeleton
from morphoskel.skeletonization import DEFAULT_SEED, _complete, skeletonize_shape


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    torch.manual_seed(0)
    path = tmp_path_factory.mktemp("network") / "network.pt"
    save_network(Point2SkeletonNetwork(TINY), path)
    return path


def test_defaults_are_those_of_the_configuration():
    defaults = {name: item.default for name, item in inspect.signature(skeletonize).parameters.items()}
    skeleton = compose().skeleton
    assert defaults["candidates"] == skeleton.candidates.count
    assert defaults["mode"] == skeleton.candidates.mode
    assert (defaults["k"], defaults["points"]) == (skeleton.k, skeleton.points)
    assert compose().seed == DEFAULT_SEED
    for method in METHODS:
        assert same(method, arguments_of(compose(), method, defaults["surface"])["settings"])


def same(method, configured):
    """Tell whether settings of the configuration are the defaults of a call without any."""
    if method in ("l1_medial", "dpc"):
        return configured == dataclasses.asdict({"l1_medial": L1MedialSettings, "dpc": DeepPointsSettings}[method]())
    function = {"ms3d": ms3d, "ms3d_coverage": coverage_skeleton, "coverage_axis": coverage_axis}.get(
        method, point2skeleton
    )
    values = {name: item.default for name, item in inspect.signature(function).parameters.items()}
    return configured == {name: values[name] for name in configured} | _complete(method, {})


@pytest.mark.parametrize("method", METHODS)
def test_every_method_takes_clouds_and_meshes(method, network):
    for shape in (torus(), sample_surface(torus(), 1500, np.random.default_rng(0))):
        result = skeletonize_shape(
            shape,
            method=method,
            reconstruction={"depth": 5},
            candidates={"mode": "random", "count": 8000},
            k=20,
            points=12,
            network=network if method == "point2skeleton" else None,
            seed=1,
        )
        assert (result.surface is None) == (method in CLOUD_METHODS)
        assert len(result.skeleton) == 12 or method in CLOUD_METHODS
        assert (result.skeleton.residues is None) == (method not in MORPHOLOGICAL)
        # An untrained network still places its balls between points of the cloud.
        assert (np.abs(result.skeleton.points) <= np.array([1.35, 1.35, 0.35])).all()


@pytest.mark.parametrize("method", sorted(RANKED))
def test_the_first_balls_of_a_ranked_method_are_its_answer_for_fewer(method):
    many, few = (skeletonize(torus(), method=method, candidates=8000, points=points) for points in (30, 10))
    assert np.array_equal(many.points[:10], few.points)


@pytest.mark.parametrize("method", ["coverage_axis", "l1_medial"])
def test_the_seed_decides(method):
    first, again, other = (skeletonize(torus(), method=method, candidates=8000, points=9, seed=s) for s in (1, 1, 2))
    assert np.array_equal(first.points, again.points)
    assert not np.array_equal(first.points, other.points)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"method": "ms3d_cover"}, "did you mean 'ms3d_coverage'"),
        ({"surface": "bpa"}, "no such reconstruction 'bpa'; legal are poisson"),
        ({"settings": {"step": 1}}, "ms3d_coverage has no setting 'step'; legal: nominees, touch"),
        ({"method": "dpc", "settings": {"step": 0}}, "step: expected a number greater than 0"),
        ({"method": "coverage_axis", "settings": {"offset": -1}}, "offset: expected a length above 0"),
        ({"method": "point2skeleton"}, "train_point2skeleton"),
        ({"network": "network.pt"}, "ms3d_coverage has none"),
        ({"mode": "scattered"}, "mode: expected random or grid"),
        ({"points": 0}, "points: expected a whole number from 1, got 0"),
        ({"k": 1}, "k: expected a whole number from 2"),
        ({"candidates": 1}, "candidates: expected a whole number from 8"),
    ],
)
def test_wrong_arguments_are_refused(arguments, message):
    with pytest.raises((ConfigError, InputError), match=message):
        skeletonize(sphere_cloud(50), **arguments)


@pytest.mark.parametrize("method", ["ms3d", "ms3d_coverage"])
def test_a_mesh_and_its_cloud_give_the_same_circle(method):
    solid = torus()
    import trimesh

    points, faces = trimesh.sample.sample_surface(trimesh.Trimesh(solid.vertices, solid.triangles), 4000, seed=1)
    normals = trimesh.Trimesh(solid.vertices, solid.triangles).face_normals[faces]
    for shape in (solid, PointCloud(points, normals)):
        skeleton = skeletonize(shape, method=method, candidates=60_000, points=20)
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
