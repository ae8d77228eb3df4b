import numpy as np
import pytest
import trimesh
from coloured import SKELETON, SURFACE

from morphoskel.cli import main
from morphoskel.formats import write_mesh_ply, write_skeleton_ply
from morphoskel.formats.skeleton_file import read_skeleton
from morphoskel.shapes import Skeleton


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_skeleton_ply(tmp_path / "a.ply", SKELETON)
    write_skeleton_ply(tmp_path / "bare.ply", Skeleton(SKELETON.points, SKELETON.radii))
    write_mesh_ply(tmp_path / "mesh.ply", SURFACE)
    return tmp_path


def test_skeleton_and_surface_for_viewers(folder, capfd):
    assert main(["export", "a.ply", "mesh.ply", "-o", "out/a.glb"]) == 0
    assert set(trimesh.load(folder / "out" / "a.glb").geometry) == {"balls", "sheets", "curves", "surface"}
    assert "wrote out/a.glb (" in capfd.readouterr().err


def test_files_may_stand_behind_the_output(folder):
    assert main(["export", "-o", "a.obj", "a.ply", "--subdivisions", "0", "mesh.ply"]) == 0
    objects = [line for line in (folder / "a.obj").read_text().splitlines() if line.startswith("o ")]
    assert objects == ["o balls", "o sheets", "o curves", "o surface"]


def test_numbers_go_there_and_back(folder):
    assert main(["export", "a.ply", "-o", "a.npz"]) == 0
    np.testing.assert_array_equal(read_skeleton(folder / "a.npz").residues, SKELETON.residues)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["gone.ply", "-o", "a.glb"], "gone.ply: cannot be read"),
        (["mesh.ply", "-o", "a.glb"], "mesh.ply: expected a skeleton (a PLY file with the property radius"),
        (["a.ply", "-o", "a.stl"], "a.stl: cannot write .stl; expected one of .ply, .obj, .glb, .npz"),
        (["a.ply", "-o", "a.ply"], "a.ply is read and would be overwritten"),
        (["a.ply", "mesh.ply", "-o", "mesh.ply"], "mesh.ply is read and would be overwritten"),
        (["a.ply", "mesh.ply", "a.ply", "-o", "b.ply"], "expected SKELETON and perhaps MESH, got 3 files"),
        (["a.ply", "bare.ply", "-o", "b.ply"], "bare.ply: expected a mesh with triangles"),
        (["a.ply", "-o", "b.ply", "--subdivisions", "6"], "subdivisions: expected a number from 0 to 5"),
        (["a.ply", "-o", "b.npz", "--subdivisions", "2"], "leave --subdivisions out"),
    ],
)
def test_errors_are_one_clear_line(folder, words, message, capfd):
    before = sorted(folder.iterdir())
    assert main(["export", *words]) == 1
    error = capfd.readouterr().err
    assert message in error
    assert "Traceback" not in error
    assert sorted(folder.iterdir()) == before


def test_help_names_every_format(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["export", "--help"])
    assert ended.value.code == 0
    text = capsys.readouterr().out
    assert "examples:" in text
    assert all(f"  {suffix} " in text for suffix in (".glb", ".obj", ".ply", ".npz"))
