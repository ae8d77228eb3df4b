import dataclasses
import json
import subprocess
import sys

import numpy as np
import pytest

from morphoskel.datasets.dataset import Dataset
from morphoskel.datasets.registry import open_dataset
from morphoskel.datasets.synthetic import CATEGORIES, SyntheticDataset, generate_shape, write_shapes
from morphoskel.errors import DatasetError, ShapeError
from morphoskel.formats.read import read_shape
from morphoskel.pool import run_isolated


@pytest.fixture
def small(tmp_path):
    return SyntheticDataset(tmp_path / "data", ["Mug", "Knife"], {"train": 2, "test": 1}, points=64, seed=5)


def files(root):
    return {path.relative_to(root).as_posix(): path.read_bytes() for path in sorted(root.rglob("*")) if path.is_file()}


def test_it_is_a_data_set_of_the_registry(small, tmp_path):
    assert isinstance(small, Dataset)
    opened = open_dataset("synthetic", root=tmp_path, categories=None, per_category={"test": 1}, points=8, seed=1)
    assert isinstance(opened, SyntheticDataset)


def test_counts_and_ids_are_arithmetic(small):
    assert small.counts() == {"train": 4, "test": 2}
    entries = small.plan_shapes()
    assert [entry.id for entry in entries] == [
        "knife-train-0000",
        "knife-train-0001",
        "mug-train-0000",
        "mug-train-0001",
        "knife-test-0000",
        "mug-test-0000",
    ]
    assert entries[-1].category == "Mug"
    assert entries[-1].split == "test"
    assert entries[-1].path == small.root / "clouds" / "Mug" / "mug-test-0000.ply"
    assert SyntheticDataset(small.root, None, {"test": 3}).counts() == {"test": 3 * len(CATEGORIES)}


def test_files_hold_exactly_the_generated_shapes(small):
    write_shapes(small)
    for entry in small.list_shapes():
        shape = generate_shape(entry.category, entry.id, seed=5, points=64)
        cloud = small.load(entry.path)
        assert np.array_equal(cloud.points, shape.cloud.points)
        assert np.allclose(cloud.normals, shape.cloud.normals, atol=1e-7)
        assert np.array_equal(cloud.labels, shape.cloud.labels)
        mesh = read_shape(small.root / "meshes" / entry.category / f"{entry.id}.ply")
        assert np.array_equal(mesh.vertices, shape.mesh.vertices)
        assert np.array_equal(mesh.triangles, shape.mesh.triangles)


def test_files_do_not_depend_on_workers_or_on_other_categories(small, tmp_path):
    write_shapes(small)
    parallel = SyntheticDataset(tmp_path / "parallel", ["Knife", "Cap", "Mug"], small.per_category, points=64, seed=5)
    write_shapes(parallel, workers=2)
    one, other = files(small.root), files(parallel.root)
    assert {name: content for name, content in other.items() if "Cap" not in name} == one


def test_shapes_not_generated_yet_are_explained(small):
    with pytest.raises(DatasetError, match=r"does not exist.*write_shapes"):
        small.list_shapes()


def test_shapes_of_another_seed_are_refused(small):
    write_shapes(small)
    other = SyntheticDataset(small.root, ["Mug"], {"test": 1}, points=64, seed=6)
    with pytest.raises(DatasetError, match=r"'seed': 5.*'seed': 6"):
        other.list_shapes()
    write_shapes(other)
    assert len(other.list_shapes()) == 1
    assert not (small.root / "clouds" / "Knife").exists()


def test_a_damaged_description_is_explained(small):
    write_shapes(small)
    (small.root / "synthetic.json").write_text(json.dumps({"seed": 5}), encoding="utf-8")
    with pytest.raises(DatasetError, match=r"synthetic.json: is damaged.*generate it again"):
        small.list_shapes()


def test_a_folder_with_something_else_is_not_replaced(small):
    small.root.mkdir()
    (small.root / "thesis.txt").write_text("precious", encoding="utf-8")
    with pytest.raises(DatasetError, match="would be replaced"):
        write_shapes(small)
    assert (small.root / "thesis.txt").read_text(encoding="utf-8") == "precious"


def test_a_failure_leaves_nothing_half_written(small, monkeypatch):
    from morphoskel.datasets.synthetic import dataset

    def run_but_fail_last(function, tasks, **settings):
        *whole, last = run_isolated(function, tasks, **settings)
        yield from whole
        yield dataclasses.replace(last, reason="out of clay")

    monkeypatch.setattr(dataset, "run_isolated", run_but_fail_last)
    with pytest.raises(ShapeError, match="could not be built: out of clay"):
        write_shapes(small)
    assert list(small.root.parent.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"categories": ["Chiar"]}, "did you mean 'Chair'"),
        ({"per_category": {"test": -1}}, r"per_category\.test: expected at least 0 shapes, got -1"),
        ({"per_category": {"te/st": 1}}, "split 'te/st'"),
        ({"points": 2}, "at least 4 points"),
    ],
)
def test_illegal_options_are_explained(tmp_path, options, message):
    with pytest.raises(DatasetError, match=message):
        SyntheticDataset(tmp_path, **options)


def test_nothing_to_generate_and_no_workers_are_explained(tmp_path):
    with pytest.raises(DatasetError, match="asks for no shape"):
        write_shapes(SyntheticDataset(tmp_path, None, {"test": 0}))
    with pytest.raises(DatasetError, match="at least 1 process"):
        write_shapes(SyntheticDataset(tmp_path, None, {"test": 1}), workers=0)


def test_counting_imports_no_heavy_library():
    script = (
        "import sys; from morphoskel.datasets.synthetic import SyntheticDataset; "
        "SyntheticDataset('x', None, {'test': 1}).counts(); "
        "assert not {'manifold3d', 'trimesh', 'scipy', 'matplotlib'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
