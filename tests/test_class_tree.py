import shutil

import numpy as np
import pytest

from morphoskel.datasets.class_tree import ClassTreeDataset
from morphoskel.datasets.manifest import build_manifest
from morphoskel.errors import DatasetError

TETRAHEDRON = "OFF4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
CLOUD = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"


@pytest.fixture
def root(tmp_path):
    files = {
        "chair/train/chair_0001.off": TETRAHEDRON,
        "chair/train/chair_0003.off": TETRAHEDRON,
        "chair/test/chair_0002.OFF": TETRAHEDRON,
        "table/train/0001.off": TETRAHEDRON,
        "table/test/0001.xyz": CLOUD,
        "table/test/.0002.off": "hidden",
        "table/test/readme.md": "no shape",
        "documents/paper.txt": "no class",
    }
    for name, content in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    return tmp_path


def test_lists_counts_and_loads(root):
    dataset = ClassTreeDataset(root, points=30)
    entries = dataset.list_shapes()
    assert [(entry.id, entry.category, entry.split) for entry in entries] == [
        ("chair_0001", "chair", "train"),
        ("chair_0003", "chair", "train"),
        ("chair_0002", "chair", "test"),
        ("table-train-0001", "table", "train"),
        ("table-test-0001", "table", "test"),
    ]
    assert dataset.counts() == {"train": 3, "test": 2}
    assert len(build_manifest(entries, shard_size=2)) == 5
    assert len(dataset.load(entries[0].path)) == 30
    assert len(dataset.load(entries[4].path)) == 4
    assert ClassTreeDataset(root, ["table"]).counts() == {"train": 1, "test": 1}


def test_samples_depend_on_seed_and_shape_only(root, tmp_path_factory):
    first, second = (ClassTreeDataset(root).list_shapes()[index].path for index in (0, 1))
    points = ClassTreeDataset(root, points=30, seed=1).load(first).points
    np.testing.assert_array_equal(ClassTreeDataset(root, ["chair"], points=30, seed=1).load(first).points, points)
    assert (ClassTreeDataset(root, points=30, seed=2).load(first).points != points).any()
    assert (ClassTreeDataset(root, points=30, seed=1).load(second).points != points).any()
    moved = tmp_path_factory.mktemp("elsewhere") / "copy"
    shutil.copytree(root, moved)
    there = ClassTreeDataset(moved, points=30, seed=1).load(moved / first.relative_to(root))
    np.testing.assert_array_equal(there.points, points)


def test_what_is_missing(root):
    with pytest.raises(DatasetError, match="did you mean 'table'"):
        ClassTreeDataset(root, ["tabel"]).counts()
    with pytest.raises(DatasetError, match=r"nowhere: the data set's folder does not exist\. Put the shapes"):
        ClassTreeDataset(root / "nowhere").counts()
    with pytest.raises(DatasetError, match=r"documents: holds no folder <class>/\{train,val,test\}"):
        ClassTreeDataset(root / "documents").list_shapes()


def test_real_data(real_data):
    dataset = ClassTreeDataset(real_data / "modelnet10_clouds")
    counts = dataset.counts()
    assert sum(counts.values()) == 3991
    entries = dataset.list_shapes()
    assert {split: sum(entry.split == split for entry in entries) for split in counts} == counts
    assert len({entry.id for entry in entries}) == 3991
    assert {len(dataset.load(entry.path)) for entry in entries[::200]} == {1024}
