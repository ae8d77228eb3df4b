import json

import numpy as np
import pytest
from solids import ball, sphere_cloud

from morphoskel.cli import main
from morphoskel.evaluation.sphere_metrics import cd_recon, hd_recon, sphere_distances
from morphoskel.formats import write_cloud_ply, write_mesh_ply, write_skeleton_npz, write_skeleton_ply
from morphoskel.shapes import PointCloud, Skeleton

SKELETON = Skeleton([[0.0, 0, 0], [0.1, 0, 0]], [0.5, 0.75])
OTHER = Skeleton([[0.0, 0, 1], [0.1, 0, 1], [0, 2, 1]], np.ones(3))
CLOUD = PointCloud(sphere_cloud(100).points.astype(np.float32))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_skeleton_ply(tmp_path / "a.ply", SKELETON)
    write_skeleton_npz(tmp_path / "other.npz", OTHER)
    write_cloud_ply(tmp_path / "cloud.ply", CLOUD)
    write_mesh_ply(tmp_path / "mesh.ply", ball(subdivisions=2))
    return tmp_path


@pytest.mark.parametrize("protocol", ["correct", "released"])
@pytest.mark.usefixtures("folder")
def test_balls_with_a_cloud_as_json(protocol, capsys):
    assert main(["compare", "a.ply", "cloud.ply", "--json", "--protocol", protocol]) == 0
    found = json.loads(capsys.readouterr().out)
    expected = sphere_distances(CLOUD.points, SKELETON.points, SKELETON.radii)
    assert found["compared"] == "balls with surface"
    assert found["protocol"] == protocol
    assert found["cd"] == cd_recon(expected, protocol)
    assert found["hd"] == hd_recon(expected)
    assert found["b_to_a"]["count"] == 100
    assert (found["a_to_b"]["max"], found["a_to_b"]["count"]) == (expected.sphere_to_point_max, 2)
    assert found["a_to_b"]["mean"] + found["b_to_a"]["mean"] == pytest.approx(found["cd"])


@pytest.mark.usefixtures("folder")
def test_centres_with_centres_as_a_table(capsys):
    assert main(["compare", "a.ply", "other.npz"]) == 0
    far = np.linalg.norm([0, 2, 1])
    assert [line.split() for line in capsys.readouterr().out.splitlines()] == [
        ["A", "a.ply", "2", "balls"],
        ["B", "other.npz", "3", "balls"],
        [],
        ["mean", "largest"],
        ["centres", "B", "to", "A", f"{(2 + far) / 3:.6g}", f"{far:.6g}"],
        ["centres", "A", "to", "B", "1", "1"],
        ["CD", f"{(2 + far) / 3 + 1:.6g}"],
        ["HD", f"{far:.6g}"],
    ]


@pytest.mark.usefixtures("folder")
def test_columns_are_aligned_and_the_points_on_a_mesh_are_counted(capsys):
    assert main(["compare", "a.ply", "mesh.ply", "--samples", "1000", "--seed", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].endswith("1,000 points drawn on 320 triangles, seed 3")
    mean, largest, chamfer, hausdorff = lines[3], lines[4], lines[6], lines[7]
    assert mean.index("mean") + len("mean") == len(chamfer)
    assert len(mean) == len(largest) == len(hausdorff)
    assert chamfer.startswith("CD-Recon ")
    assert hausdorff.startswith("HD-Recon ")


@pytest.mark.usefixtures("folder")
def test_the_released_protocol_is_named_in_the_table(capsys):
    assert main(["compare", "a.ply", "cloud.ply", "--protocol", "released"]) == 0
    assert "protocol released: the second mean is divided by" in capsys.readouterr().out


@pytest.mark.usefixtures("folder")
def test_a_cloud_can_stand_for_centres(capsys):
    assert main(["compare", "a.ply", "cloud.ply", "--centres", "--json"]) == 0
    expected = sphere_distances(CLOUD.points, SKELETON.points, np.zeros(2))
    found = json.loads(capsys.readouterr().out)
    assert (found["compared"], found["hd"]) == ("centres with centres", hd_recon(expected))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["a.ply"], "expected A and B, got 1 files: a.ply"),
        (["a.ply", "cloud.ply", "mesh.ply"], "expected A and B, got 3 files"),
        (["a.ply", "gone.ply"], "gone.ply: cannot be read"),
        (["cloud.ply", "mesh.ply"], "cloud.ply: A must be a skeleton (a PLY file with the property radius"),
        (["cloud.ply", "a.ply"], "found PointCloud(100 points); name the skeleton first"),
        (["a.ply", "cloud.ply", "--samples", "9"], "cloud.ply: points are drawn on a mesh only"),
        (["a.ply", "mesh.ply", "--samples", "3"], "mesh.ply: samples: expected at least 4 points, got 3"),
        (["a.ply", "mesh.ply", "--centres"], "mesh.ply: a mesh has no centres"),
    ],
)
@pytest.mark.usefixtures("folder")
def test_errors_are_one_clear_line(words, message, capfd):
    assert main(["compare", *words]) == 1
    printed = capfd.readouterr()
    assert message in printed.err
    assert "Traceback" not in printed.err
    assert printed.out == ""


def test_help_shows_examples(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["compare", "--help"])
    assert ended.value.code == 0
    text = capsys.readouterr().out
    assert "examples:" in text
    assert "usage: morphoskel compare A B" in text
