import numpy as np
import pytest
import torch
from solids import capsule, sphere_cloud
from tiny_generator import TINY
from tiny_skeleton_aware import TINY_SAMPLER, TINY_SKELETON

from morphoskel import read_shape
from morphoskel.config import compose
from morphoskel.errors import ConfigError, InputError
from morphoskel.formats import read_point_cloud, write_cloud_ply, write_mesh_ply
from morphoskel.networks.point_generator import PointGenerator, save_generator
from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork, save_skeleton_aware
from morphoskel.networks.skeleton_sampler import SkeletonSampler, save_skeleton_sampler
from morphoskel.sampling import sample_files as module
from morphoskel.sampling.sample_files import SamplingRequest, prepare_sampler, sample_files
from morphoskel.skeleton.thinning import farthest_points

CONFIG = compose(
    [
        "skeleton.candidates.count=5000",
        "skeleton.points=32",
        "surface.poisson.depth=5",
        "surface.repaired_poisson.depth=5",
        "watertight.resolution=2000",
    ]
)


@pytest.fixture(scope="module")
def networks(tmp_path_factory):
    """Files with untrained networks, which choose 10 points."""
    folder = tmp_path_factory.mktemp("networks")
    with torch.random.fork_rng():
        torch.manual_seed(0)
        save_generator(PointGenerator(10, TINY), folder / "generator.pt")
        save_skeleton_sampler(SkeletonSampler(10, TINY_SAMPLER), folder / "sampler.pt")
        save_skeleton_aware(SkeletonAwareNetwork(TINY_SKELETON), folder / "skeleton.pt")
    return folder


def run(inputs, folder, config=CONFIG, **request):
    return sample_files(inputs, folder, config, SamplingRequest(**request), progress=False)


def test_a_cloud_gives_points_and_their_indices(tmp_path):
    write_cloud_ply(tmp_path / "ball.ply", sphere_cloud(300))
    cloud = read_shape(tmp_path / "ball.ply")
    result = run([tmp_path / "ball.ply"], tmp_path / "out", sampler="fps", points=20)
    assert [path.name for path in result.written] == ["ball.ply", "ball.npz"]
    assert result.failures == {}
    with np.load(tmp_path / "out" / "ball.npz") as stored:
        assert sorted(stored) == ["indices", "points"]
        assert stored["indices"].tolist() == farthest_points(cloud.points, 20).tolist()
        assert np.array_equal(stored["points"], cloud.points[stored["indices"]])
        chosen = read_point_cloud(tmp_path / "out" / "ball.ply")
        assert np.array_equal(chosen.points, stored["points"])
        assert chosen.normals == pytest.approx(cloud.normals[stored["indices"]])


def test_a_mesh_gives_the_points_drawn_on_it_and_its_skeleton(tmp_path):
    write_mesh_ply(tmp_path / "pill.ply", capsule())
    result = run([tmp_path / "pill.ply"], tmp_path / "out", sampler="lfs", plot=True)
    assert [path.name for path in result.written] == ["pill.ply", "pill.npz", "pill.png"]
    with np.load(tmp_path / "out" / "pill.npz") as stored:
        assert stored["cloud"].shape == (2000, 3)
        assert np.array_equal(stored["points"], stored["cloud"][stored["indices"]])
        assert len(stored["indices"]) == 128
        assert len(stored["local_feature_size"]) == 2000
        assert stored["skeleton_points"].shape == (32, 3)
        assert np.median(stored["skeleton_radii"]) == pytest.approx(0.5, abs=0.05)


def test_the_configuration_sets_the_seed_the_surface_and_the_rule(tmp_path):
    write_cloud_ply(tmp_path / "ball.ply", sphere_cloud(300))
    skeletons = []
    for seed in (5, 6):
        config = CONFIG.model_copy(update={"seed": seed})
        run([tmp_path / "ball.ply"], tmp_path / "out", config, sampler="lfs", points=10)
        with np.load(tmp_path / "out" / "ball.npz") as stored:
            skeletons.append(stored["skeleton_points"])
    assert not np.array_equal(*skeletons)
    plain = compose(["samplers.lfs.exponent=0", "sampling.skeleton=ms3d_coverage", "sampling.surface=alpha_shape"])
    ready = prepare_sampler(plain, SamplingRequest("lfs"))
    assert ready.lfs.exponent == 0
    assert ready.skeletonization["method"] == "ms3d_coverage"
    assert ready.skeletonization["surface"] == "alpha_shape"
    assert prepare_sampler(plain, SamplingRequest("lfs", surface="ponq")).skeletonization["surface"] == "ponq"


@pytest.mark.parametrize(
    ("sampler", "network", "arrays"),
    [
        ("snet", "generator.pt", 2),
        ("metasampler", "generator.pt", 2),
        ("uniform", "sampler.pt", 2),
        ("ms3d", "sampler.pt", 5),
        ("shuffled", "sampler.pt", 5),
        ("skeleton_aware", "sampler.pt", 5),
    ],
)
def test_a_network_chooses_as_many_points_as_it_was_trained_for(sampler, network, arrays, networks, tmp_path):
    write_cloud_ply(tmp_path / "ball.ply", sphere_cloud(300))
    skeletons = {"skeleton_network": networks / "skeleton.pt"} if sampler == "skeleton_aware" else {}
    request = {"sampler": sampler, "network": networks / network, **skeletons}
    result = run([tmp_path / "ball.ply"], tmp_path / "out", **request)
    assert result.failures == {}
    with np.load(tmp_path / "out" / "ball.npz") as stored:
        assert len({*stored["indices"].tolist()}) == 10
        assert len(stored.files) == arrays


@pytest.mark.parametrize("method", ["dpc", "l1_medial"])
def test_a_prior_of_another_method_comes_from_its_skeleton(method, networks):
    ready = prepare_sampler(CONFIG, SamplingRequest(method, network=networks / "sampler.pt"))
    assert ready.skeletonization["method"] == method
    assert ready.count == 10


@pytest.mark.parametrize(
    ("request_", "error", "message"),
    [
        ({"sampler": "fpz"}, ConfigError, "did you mean 'fps'"),
        ({"sampler": "ms3d"}, ConfigError, "'ms3d' needs a trained network; name its file with --network"),
        ({"sampler": "fps", "network": "sampler.pt"}, ConfigError, "'fps' has no network; leave --network out"),
        ({"sampler": "ms3d", "network": "generator.pt"}, InputError, "generator.pt: not a skeleton-aware sampler"),
        ({"sampler": "snet", "network": "sampler.pt"}, InputError, "sampler.pt: not a generator"),
        ({"sampler": "snet", "network": "absent.pt"}, InputError, "absent.pt: no trained generator"),
        ({"sampler": "skeleton_aware", "network": "sampler.pt"}, ConfigError, "name its file with --skeleton-network"),
        (
            {"sampler": "ms3d", "network": "sampler.pt", "skeleton_network": "skeleton.pt"},
            ConfigError,
            "leave --skeleton-network out",
        ),
        ({"sampler": "snet", "network": "generator.pt", "noise": True}, ConfigError, "leave --noise out"),
        (
            {"sampler": "snet", "network": "generator.pt", "points": 12},
            ConfigError,
            "was trained to choose 10 points and cannot choose 12",
        ),
        ({"sampler": "fps", "points": 3}, ConfigError, "points: expected at least 4, .* got 3"),
        ({"sampler": "lfs", "surface": "bpa"}, ConfigError, "surface 'bpa' is not configured"),
    ],
)
def test_a_request_that_contradicts_itself_is_refused(request_, error, message, networks, tmp_path):
    files = {name: networks / request_[name] for name in ("network", "skeleton_network") if name in request_}
    write_cloud_ply(tmp_path / "ball.ply", sphere_cloud(100))
    with pytest.raises(error, match=message):
        run([tmp_path / "ball.ply"], tmp_path / "out", **{**request_, **files})
    assert not (tmp_path / "out").exists()


def test_a_sampler_without_its_settings_is_refused():
    with pytest.raises(ConfigError, match="sampler 'lfs' is not configured"):
        prepare_sampler(compose(["sampler=[fps]"]), SamplingRequest("lfs"))
    assert prepare_sampler(compose(["sampler=[]"]), SamplingRequest("fps")).lfs is None


def test_an_input_is_never_overwritten(tmp_path):
    write_cloud_ply(tmp_path / "ball.ply", sphere_cloud(100))
    before = (tmp_path / "ball.ply").read_bytes()
    with pytest.raises(InputError, match=r"ball\.ply would be overwritten"):
        run([tmp_path], tmp_path, sampler="fps", points=10)
    assert (tmp_path / "ball.ply").read_bytes() == before
    (tmp_path / "ball.ply").unlink()
    np.savetxt(tmp_path / "ball.xyz", sphere_cloud(100).points)
    assert run([tmp_path], tmp_path, sampler="fps", points=10).failures == {}


def test_a_file_that_fails_does_not_stop_the_others(tmp_path, monkeypatch):
    for name, count in (("few", 20), ("many", 100), ("odd", 100)):
        write_cloud_ply(tmp_path / f"{name}.ply", sphere_cloud(count))
    real = module._sample_file

    def give_up_on_odd(path, name, *others, **options):
        if name == "odd":
            raise RuntimeError("no facet\nmany lines follow")
        return real(path, name, *others, **options)

    monkeypatch.setattr(module, "_sample_file", give_up_on_odd)
    result = run([tmp_path], tmp_path / "out", sampler="random", points=50)
    assert [path.name for path in result.written] == ["many.ply", "many.npz"]
    assert {path.name: reason for path, reason in result.failures.items()} == {
        "few.ply": "50 points are wanted, and it has only 20; ask for fewer, or give a denser cloud",
        "odd.ply": "RuntimeError: no facet",
    }
