"""Names of files that a shell, a template or a table could take for something else."""

import os
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from solids import box, sphere_cloud
from test_workflow import copy_repository, run

from morphoskel.cli import main
from morphoskel.datasets.folder import FolderDataset
from morphoskel.datasets.manifest import SAFE_NAME, build_manifest, read_manifest, write_manifest
from morphoskel.errors import DatasetError
from morphoskel.formats import read_skeleton_ply, write_cloud_ply, write_mesh_ply

ODD_NAMES = [
    "two words", " ", "it's", 'say "hi"', "line\nbreak", "-rf", "--help", "+", "$(touch evil)", "`touch evil`",
    "{split}", "{}", "<results>", "*", "[a]", "a;touch evil", "a|b&c", "$HOME", r"$\frac$", "$a$ $b$", "Möbel",
    "Мебель", "椅子", "桌子", "%s%d", "a=b", "#", "~", "a,b", "<b>", r"\input{x}", "=1+1", "a'); --",
]  # fmt: skip


ODD_CATEGORIES = ["-rf", "{split} $a$", "<results>|&"]

SHELL_NAMES = ["it's", "line\nbreak", "-rf", "$(touch evil)", "{split}", "*", "<b>", r"$\frac$", "Möbel 椅子"]


def test_a_folder_of_odd_names_is_listed_and_read(tmp_path):
    root = tmp_path / "it's $HOME"
    for number, name in enumerate(ODD_NAMES):
        folder = root / name if number % 2 else root
        folder.mkdir(parents=True, exist_ok=True)
        write_cloud_ply(folder / f"{name}{number}.ply", sphere_cloud(50, seed=number))
    dataset = FolderDataset(root)
    records = build_manifest(dataset.list_shapes(), shard_size=4)
    assert len(records) == len(ODD_NAMES)
    assert all(SAFE_NAME.fullmatch(record.id) for record in records)
    write_manifest(tmp_path / "manifest.csv", records)
    assert read_manifest(tmp_path / "manifest.csv") == records
    assert [len(dataset.load(record.path)) for record in records] == [50] * len(records)


def test_names_that_differ_only_in_letters_of_another_alphabet(tmp_path):
    for name in ("椅子.ply", "桌子.ply"):
        (tmp_path / name).write_bytes(b"")
    assert len(build_manifest(FolderDataset(tmp_path).list_shapes(), shard_size=1)) == 2


def test_the_id_of_an_accent_does_not_depend_on_its_encoding(tmp_path):
    ids = []
    for name in ("\u00fc.ply", "u\u0308.ply"):
        (tmp_path / name).write_bytes(b"")
        ids.append(FolderDataset(tmp_path).list_shapes()[0].id)
        (tmp_path / name).unlink()
    assert ids[0] == ids[1]


@pytest.mark.skipif(sys.platform == "darwin", reason="names are always UTF-8 there")
def test_a_name_in_another_encoding(tmp_path):
    folder = os.fsencode(tmp_path)
    with open(folder + b"/caf\xe9.xyz", "wb") as stream:  # noqa: PTH123 - a path of bytes
        stream.write(b"0 0 0\n")
    with pytest.raises(DatasetError, match="not encoded as UTF-8"):
        build_manifest(FolderDataset(tmp_path).list_shapes(), shard_size=1)


@pytest.fixture
def solids(tmp_path, monkeypatch):
    """Change into a folder with meshes of odd names; whatever a shell would create there is found."""
    folder = tmp_path / "my $(touch evil) {split} Möbel"
    folder.mkdir()
    for name in SHELL_NAMES:
        write_mesh_ply(folder / f"{name}.ply", box(1.0, 0.6, 0.4))
    monkeypatch.chdir(folder)
    yield folder
    assert not list(tmp_path.rglob("evil"))


SMALL = ["skeleton.candidates.count=1000", "skeleton.points=8", "skeleton.k=5", "watertight.resolution=100"]


def test_shapes_of_odd_names_are_skeletonized_shown_exported_and_compared(solids):
    assert main(["skeletonize", str(solids), "-o", "out {x}", "--method", "ms3d", *SMALL]) == 0
    for name in SHELL_NAMES:
        assert len(read_skeleton_ply(Path("out {x}") / f"{name}.ply")) == 8
    words = [f"out {{x}}/{name}.ply" for name in SHELL_NAMES]
    assert main(["view", *words, "-o", "$(touch evil).html", "--no-open"]) == 0
    assert "<b>" not in Path("$(touch evil).html").read_text(encoding="utf-8")
    for suffix in (".glb", ".obj", ".ply", ".npz"):
        assert main(["export", words[0], "-o", f"it's {{x}} $(touch evil){suffix}"]) == 0
    assert main(["compare", "out {x}/-rf.ply", "./-rf.ply", "--samples", "500"]) == 0


def test_pictures_show_names_as_they_are(solids):
    name = r"$\frac$"
    assert main(["skeletonize", f"{name}.ply", "-o", "out", "--method", "ms3d", "--plot", *SMALL]) == 0
    assert Path(f"out/{name}.png").stat().st_size > 1000


def test_a_leading_minus_is_an_option_unless_a_folder_comes_before(solids, capsys):
    with pytest.raises(SystemExit):
        main(["skeletonize", "-rf.ply", "-o", "out", *SMALL])
    assert main(["skeletonize", "./-rf.ply", "-o", "out", "--method", "ms3d", *SMALL]) == 0


@pytest.fixture(scope="module")
def odd_clone(tmp_path_factory):
    """Return a clone and the words of a small experiment, both under names that mean something to a shell."""
    base = tmp_path_factory.mktemp("odd")
    root = base / 'my "data" `touch evil` 椅子\'s 😀'
    for name in ODD_CATEGORIES:
        (root / name).mkdir(parents=True)
        write_cloud_ply(root / name / f"{name} $(touch evil).ply", sphere_cloud(400, seed=len(name)))
    words = ["experiment=smoke", "dataset=folder", f"dataset.root={root}", "~parts", "surface=[poisson]", "task=[]",
             "skeleton=[ms3d]", "sampler=[fps]", "skeleton.candidates.count=4000", "skeleton.points=32", "run=odd",
             "surface.poisson.depth=5", "watertight.resolution=1000", "medial_axis.samples=500"]  # fmt: skip
    yield copy_repository(base / "it's my $(touch evil) clone, Möbel"), words
    assert not list(base.rglob("evil"))


@pytest.mark.workflow
def test_a_clone_and_a_data_set_under_odd_paths(odd_clone):
    repository, words = odd_clone
    run(repository, "resources/manifest/folder.csv", "results/odd/config.yaml", *words)
    records = read_manifest(repository / "resources/manifest/folder.csv")
    assert {record.category for record in records} == set(ODD_CATEGORIES)


@pytest.mark.workflow
@pytest.mark.timeout(1800)
def test_categories_of_odd_names_reach_the_tables_and_pictures(odd_clone):
    repository, words = odd_clone
    run(repository, "table_surface_reconstruction", "figure_contact_sheet", *words)
    frame = pd.read_csv(repository / "results/odd/tables/surface_reconstruction.csv", keep_default_na=False)
    measured = frame[(frame["method"] == "Poisson") & (frame["metric"] == "cd_recon") & (frame["value"] != "not run")]
    assert set(ODD_CATEGORIES) <= set(measured["group"])
    assert np.isfinite(measured["value"].astype(float)).all()


@pytest.mark.workflow
def test_a_clone_that_snakemake_cannot_handle(tmp_path):
    output = run(copy_repository(tmp_path / "{split}"), "skeletons", "--", "--dry-run", check=False)
    assert "Snakemake cannot handle the character '{'" in output
