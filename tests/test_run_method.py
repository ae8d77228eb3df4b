import inspect

import numpy as np
import pytest
import torch
from solids import ball, sphere_cloud
from tiny_point2skeleton import TINY

from morphoskel.errors import ConfigError, InputError
from morphoskel.methods import METHODS, SURFACE_METHODS
from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork, save_network
from morphoskel.run_method import check_network, check_settings, setting_names, skeleton_inside, skeleton_of_cloud
from morphoskel.skeleton import ms3d
from morphoskel.skeleton.coverage import coverage_skeleton
from morphoskel.skeleton.coverage_axis import coverage_axis
from morphoskel.skeleton.dpc import deep_points
from morphoskel.skeleton.l1_medial import L1MedialSettings, l1_medial
from morphoskel.skeleton.point2skeleton import point2skeleton
from morphoskel.volume import Candidates

SHARED = {"points", "element_radius", "threads"}


@pytest.fixture(scope="module")
def candidates():
    return Candidates(*ball().bounds, 4000)


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    torch.manual_seed(0)
    path = tmp_path_factory.mktemp("network") / "network.pt"
    save_network(Point2SkeletonNetwork(TINY), path)
    return path


def equal(first, second):
    return np.array_equal(first.points, second.points) and np.array_equal(first.radii, second.radii)


@pytest.mark.parametrize("method", SURFACE_METHODS)
def test_the_largest_ball_of_a_ball_is_itself(method, candidates):
    cloud = sphere_cloud(2000).points
    skeleton = skeleton_inside(method, ball(), candidates, cloud, k=20, points=1, settings={})
    assert len(skeleton) == 1
    assert np.linalg.norm(skeleton.points[0]) < 0.15
    assert skeleton.radii[0] == pytest.approx(1, abs=0.15)


def test_the_name_decides_which_balls_are_chosen(candidates):
    cloud = sphere_cloud(500).points
    chosen = [
        skeleton_inside(method, ball(), candidates, cloud, k=20, points=9, settings={}) for method in SURFACE_METHODS
    ]
    assert equal(chosen[0], ms3d(ball(), candidates, points=9))
    assert not any(equal(chosen[a], chosen[b]) for a, b in ((0, 1), (0, 2), (1, 2)))


def test_settings_reach_the_methods(candidates):
    cloud = sphere_cloud(500)
    greedy = {
        limit: skeleton_inside(
            "coverage_axis", ball(), candidates, cloud.points, k=20, points=50, settings={"candidate_limit": limit}
        )
        for limit in (5, 7)
    }
    assert [len(skeleton) <= limit for limit, skeleton in greedy.items()] == [True, True]
    curves = skeleton_of_cloud("l1_medial", cloud, np.random.default_rng(3), settings={"samples": 60})
    assert equal(curves, l1_medial(cloud, np.random.default_rng(3), L1MedialSettings(samples=60)))
    deep = skeleton_of_cloud("dpc", cloud, np.random.default_rng(3), settings={"samples": 60})
    assert len(deep) == 60 < len(deep_points(cloud))


def test_a_network_predicts_as_if_called_itself(network):
    from morphoskel.networks.point2skeleton_network import load_point2skeleton

    cloud = sphere_cloud(200)
    before = torch.get_num_threads()
    named = skeleton_of_cloud(
        "point2skeleton", cloud, np.random.default_rng(0), settings={"refine_radii": False}, network=network
    )
    assert torch.get_num_threads() == before
    direct = point2skeleton(cloud, load_point2skeleton(network), refine_radii=False)
    assert np.allclose(named.points, direct.points, atol=1e-5)
    assert np.allclose(named.radii, direct.radii, atol=1e-5)


@pytest.mark.parametrize(
    ("method", "function"),
    [("ms3d_coverage", coverage_skeleton), ("coverage_axis", coverage_axis), ("point2skeleton", point2skeleton)],
)
def test_settings_are_the_keywords_of_the_function(method, function):
    parameters = inspect.signature(function).parameters.values()
    keywords = {parameter.name for parameter in parameters if parameter.kind is parameter.KEYWORD_ONLY}
    assert set(setting_names(method)) == keywords - SHARED


@pytest.mark.parametrize("method", METHODS)
def test_a_setting_that_a_method_does_not_have_is_refused(method):
    check_settings(method, dict.fromkeys(setting_names(method)))
    with pytest.raises(ConfigError, match=rf"{method} has no setting 'colour'; legal: \w"):
        check_settings(method, {"colour": 1})


def test_covering_needs_something_to_cover(candidates):
    with pytest.raises(InputError, match="needs points of the surface"):
        skeleton_inside("coverage_axis", ball(), candidates, None, k=20, points=1, settings={})


@pytest.mark.parametrize(
    ("method", "network", "message"),
    [
        ("point2skeleton", None, "needs the file of a trained network; `morphoskel run train_point2skeleton"),
        ("point2skeleton", "absent.pt", "absent.pt: no such file.*train_point2skeleton"),
        ("dpc", "network.pt", "dpc has none"),
    ],
)
def test_a_network_goes_with_its_method(method, network, message):
    with pytest.raises((ConfigError, InputError), match=message):
        check_network(method, network)


def test_a_network_that_fits_is_accepted(network):
    check_network("point2skeleton", str(network))
    check_network("ms3d", None)
