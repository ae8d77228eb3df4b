import numpy as np
import pytest

from morphoskel.datasets.folder import FolderDataset
from morphoskel.datasets.manifest import build_manifest
from morphoskel.errors import ConfigError, DatasetError

TETRAHEDRON = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
CLOUD = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"


@pytest.fixture
def root(tmp_path):
    files = {
        "dog.off": TETRAHEDRON,
        "my cat (old).xyz": CLOUD,
        "birds/owl.off": TETRAHEDRON,
        "birds/small/wren.off": TETRAHEDRON,
        "notes.md": "no shape",
        ".hidden.off": "hidden",
        ".cache/owl.off": "hidden",
    }
    for name, content in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    return tmp_path


def test_lists_counts_and_loads(root):
    dataset = FolderDataset(root, points=30)
    entries = dataset.list_shapes()
    assert [(entry.id, entry.category, entry.split) for entry in entries] == [
        ("birds-owl", "birds", "test"),
        ("birds-small-wren", "birds", "test"),
        ("dog", "shape", "test"),
        ("my_cat__old_", "shape", "test"),
    ]
    assert dataset.counts() == {"test": 4}
    assert len(build_manifest(entries, shard_size=2)) == 4
    assert [len(dataset.load(entry.path)) for entry in entries] == [30, 30, 30, 4]


def test_options(root):
    assert FolderDataset(root, recursive=False).counts() == {"test": 2}
    assert FolderDataset(root, suffixes=[".XYZ"]).counts() == {"test": 1}
    assert FolderDataset(root, categories=["birds"]).counts() == {"test": 2}
    with pytest.raises(ConfigError, match=r"'\.blend' is not supported"):
        FolderDataset(root, suffixes=[".blend"])
    with pytest.raises(DatasetError, match="did you mean 'birds'"):
        FolderDataset(root, categories=["bird"]).counts()


def test_samples_depend_on_seed_and_shape_only(root):
    paths = [entry.path for entry in FolderDataset(root).list_shapes()]
    points = FolderDataset(root, points=30, seed=1).load(paths[0]).points
    np.testing.assert_array_equal(FolderDataset(root, points=30, seed=1, recursive=False).load(paths[0]).points, points)
    assert (FolderDataset(root, points=30, seed=2).load(paths[0]).points != points).any()
    assert (FolderDataset(root, points=30, seed=1).load(paths[1]).points != points).any()


def test_two_files_with_the_same_id(root):
    (root / "dog.xyz").write_text(CLOUD)
    with pytest.raises(DatasetError, match=r"id 'dog' occurs twice: .*dog\.off .*dog\.xyz"):
        build_manifest(FolderDataset(root).list_shapes(), shard_size=1)


def test_nothing_to_read(tmp_path):
    with pytest.raises(DatasetError, match=r"holds no file with a suffix \.ply"):
        FolderDataset(tmp_path).counts()
    with pytest.raises(DatasetError, match=r"nowhere: the data set's folder does not exist\. Put your meshes"):
        FolderDataset(tmp_path / "nowhere").counts()


def test_real_mesh(real_data):
    dataset = FolderDataset(real_data / "medial_axis", points=500)
    (entry,) = dataset.list_shapes()
    assert entry.id == "dog"
    assert len(dataset.load(entry.path)) == 500
