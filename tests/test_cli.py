import re

import numpy as np
import pytest
import trimesh
import yaml
from solids import sphere_cloud, torus

from morphoskel import read_shape, skeletonize
from morphoskel.cli import main
from morphoskel.formats import read_skeleton_ply, write_cloud_ply, write_mesh_ply
from morphoskel.methods import METHODS
from morphoskel.sampling.samplers import SAMPLERS
from morphoskel.surface.reconstruct import SURFACES

FAST = [
    "skeleton.candidates.count=20000",
    "skeleton.points=32",
    "surface.poisson.depth=5",
    "surface.repaired_poisson.depth=5",
    "watertight.resolution=2000",
]


def test_skeletonize_writes_skeleton_and_picture(tmp_path, capfd):
    write_mesh_ply(tmp_path / "torus.ply", torus())
    code = main(["skeletonize", str(tmp_path / "torus.ply"), "-o", str(tmp_path / "out"), "--plot", *FAST])
    assert code == 0
    skeleton = read_skeleton_ply(tmp_path / "out" / "torus.ply")
    assert len(skeleton) == 32
    with np.load(tmp_path / "out" / "torus.npz") as stored:
        assert np.array_equal(stored["radii"], skeleton.radii)
    assert (tmp_path / "out" / "torus.png").read_bytes().startswith(b"\x89PNG")
    assert "wrote" in capfd.readouterr().err
    assert len(trimesh.load(tmp_path / "out" / "torus.ply").vertices) == 32


def test_a_broken_file_does_not_stop_the_others(tmp_path, capfd):
    write_cloud_ply(tmp_path / "good.ply", sphere_cloud(500))
    (tmp_path / "bad.off").write_text("OFF\n4 1 0\n0 0 0\n")
    (tmp_path / "notes.md").write_text("not a shape")
    code = main(["skeletonize", str(tmp_path), "-o", str(tmp_path / "out"), *FAST])
    assert code == 1
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["good.npz", "good.ply"]
    assert "bad.off: FAILED" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["skeletonize", "absent.ply", "-o", "out"], "absent.ply: no such file"),
        (["skeletonize", ".", "-o", "out"], "no shape to skeletonize"),
        (["skeletonize", ".", "-o", "out", "skeleton.kk=3"], "did you mean 'skeleton.k'"),
        (["config", "experiment=papr"], "did you mean 'paper'"),
        (["run"], "holds the workflow"),
    ],
)
def test_errors_are_one_clear_line(words, message, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 1
    error = capfd.readouterr().err
    assert message in error
    assert "Traceback" not in error


def test_a_surface_that_is_not_configured_is_refused(tmp_path, capfd):
    write_cloud_ply(tmp_path / "a.ply", sphere_cloud(100))
    assert main(["skeletonize", str(tmp_path / "a.ply"), "-o", str(tmp_path), "--surface", "bpa"]) == 1
    assert "configured are poisson, ball_pivoting, alpha_shape" in capfd.readouterr().err


def test_the_method_is_chosen_by_name_and_set_by_its_section(tmp_path):
    write_mesh_ply(tmp_path / "torus.ply", torus())
    words = ["skeletonize", str(tmp_path / "torus.ply"), *FAST]
    assert main([*words, "-o", str(tmp_path / "dpc"), "--method", "dpc", "methods.dpc.samples=50", "--plot"]) == 0
    assert len(read_skeleton_ply(tmp_path / "dpc" / "torus.ply")) == 50
    assert (tmp_path / "dpc" / "torus.png").read_bytes().startswith(b"\x89PNG")
    assert (
        main([*words, "-o", str(tmp_path / "few"), "--method", "coverage_axis", "methods.coverage_axis.points=5"]) == 0
    )
    assert len(read_skeleton_ply(tmp_path / "few" / "torus.ply")) == 5


def test_the_command_and_the_library_give_the_same_balls(tmp_path):
    path = tmp_path / "shape.ply"  # the seeds depend on the name, which the library takes to be "shape"
    write_mesh_ply(path, torus())
    assert main(["skeletonize", str(path), "-o", str(tmp_path / "out"), "skeleton.candidates.count=9000"]) == 0
    skeleton = skeletonize(read_shape(path), candidates=9000)
    assert np.array_equal(read_skeleton_ply(tmp_path / "out" / "shape.ply").points, skeleton.points)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--method", "point2skeleton"], "`morphoskel run train_point2skeleton"),
        (["--method", "point2skeleton", "--network", "absent.pt"], "absent.pt: no such file"),
        (["--network", "network.pt"], "choose the method point2skeleton"),
        (["--method", "dpc", "skeleton=[ms3d]"], "method 'dpc' is not configured"),
    ],
)
def test_a_method_that_cannot_run_is_refused_before_any_file(words, message, tmp_path, capfd):
    write_cloud_ply(tmp_path / "a.ply", sphere_cloud(100))
    assert main(["skeletonize", str(tmp_path / "a.ply"), "-o", str(tmp_path / "out"), *words]) == 1
    assert message in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_wrong_method_is_refused_with_the_legal_ones(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["skeletonize", "a.ply", "-o", "out", "--method", "skeleton"])
    assert ended.value.code == 2
    error = capsys.readouterr().err
    assert all(method in error for method in METHODS)


def test_help_names_every_method_and_surface(capsys):
    with pytest.raises(SystemExit):
        main(["skeletonize", "--help"])
    text = capsys.readouterr().out
    assert all(f"  {method} " in text for method in METHODS)
    assert all(surface in text for surface in SURFACES)
    assert f"--method {METHODS[0]} --surface poisson" in text


def test_two_inputs_of_one_name_are_refused(tmp_path, capfd):
    for folder in ("one", "two"):
        write_cloud_ply(tmp_path / folder / "a.ply", sphere_cloud(100))
    assert main(["skeletonize", str(tmp_path / "one"), str(tmp_path / "two"), "-o", str(tmp_path / "out")]) == 1
    assert "would both be written as 'a'" in capfd.readouterr().err


def test_config_prints_what_a_run_would_use(capsys):
    assert main(["config", "experiment=paper", "skeleton.k=30"]) == 0
    assert yaml.safe_load(capsys.readouterr().out)["skeleton"]["k"] == 30


def test_sample_writes_the_chosen_points(tmp_path, capfd):
    write_cloud_ply(tmp_path / "in" / "a.ply", sphere_cloud(200))
    words = ["sample", str(tmp_path / "in"), "-o", str(tmp_path / "out"), "--points", "16", *FAST, "--plot"]
    assert main(words) == 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["a.npz", "a.ply", "a.png"]
    assert len(read_shape(tmp_path / "out" / "a.ply")) == 16
    with np.load(tmp_path / "out" / "a.npz") as stored:
        assert len(stored["local_feature_size"]) == 200
    assert "a.ply: chose 16 of 200 points" in capfd.readouterr().err


def test_sample_says_which_file_failed(tmp_path, capfd):
    write_cloud_ply(tmp_path / "a.ply", sphere_cloud(20))
    words = ["sample", str(tmp_path / "a.ply"), "-o", str(tmp_path / "out"), "--sampler", "fps", "--points", "21"]
    assert main(words) == 1
    assert "a.ply: FAILED: 21 points are wanted, and it has only 20" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--sampler", "samplenet"], "name its file with --network"),
        (["--sampler", "snet", "--network", "absent.pt"], "absent.pt: no trained generator"),
        (["--noise"], "leave --noise out"),
        (["--sampler", "skeleton_aware", "--network", "a.pt"], "--skeleton-network"),
        (["--skeleton-network", "a.pt"], "leave --skeleton-network out"),
        (["--surface", "bpa"], "surface 'bpa' is not configured"),
        (["samplers.lfs.exponnt=0"], "did you mean 'samplers.lfs.exponent'"),
        (["samplers.lfs.exponent=-1"], "exponent: expected a number from 0"),
    ],
)
def test_a_sampler_that_cannot_run_is_refused_before_any_file(words, message, tmp_path, capfd):
    write_cloud_ply(tmp_path / "a.ply", sphere_cloud(100))
    assert main(["sample", str(tmp_path / "a.ply"), "-o", str(tmp_path / "out"), *words]) == 1
    assert message in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_help_names_every_sampler(capsys):
    with pytest.raises(SystemExit):
        main(["sample", "--help"])
    described = capsys.readouterr().out.partition("samplers without training:")[2]
    assert [sampler for sampler in SAMPLERS if not re.search(rf"[ ,]{sampler}[ ,\n]", described)] == []


@pytest.mark.parametrize("command", [[], ["run"], ["skeletonize"], ["sample"], ["config"]])
def test_help_shows_examples(command, capsys):
    with pytest.raises(SystemExit) as ended:
        main([*command, "--help"])
    assert ended.value.code == 0
    text = capsys.readouterr().out
    assert "morphoskel" in text
    assert "examples:" in text or not command


def test_snakemake_options_belong_to_run(capsys):
    with pytest.raises(SystemExit):
        main(["config", "--", "-n"])
    assert "morphoskel run" in capsys.readouterr().err
