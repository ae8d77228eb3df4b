import numpy as np
import pytest

from morphoskel.datasets.manifest import build_manifest
from morphoskel.datasets.modelnet40 import CATEGORIES, ModelNet40Dataset
from morphoskel.errors import ConfigError, DatasetError, InputError

ROWS = "".join(f"{x},{y},0.5,0,0,1\n" for x in range(4) for y in range(3))


@pytest.fixture
def root(tmp_path):
    shapes = {"train": ["chair_0001", "night_stand_0001"], "test": ["chair_0002"]}
    for split, listed in shapes.items():
        (tmp_path / f"modelnet40_{split}.txt").write_text("\r\n".join(listed))
        for name in listed:
            path = tmp_path / name.rpartition("_")[0] / f"{name}.txt"
            path.parent.mkdir(exist_ok=True)
            path.write_text(ROWS)
    return tmp_path


def test_there_are_40_classes_in_alphabetic_order():
    assert len(set(CATEGORIES)) == 40
    assert list(CATEGORIES) == sorted(CATEGORIES)


def test_lists_counts_and_loads(root):
    dataset = ModelNet40Dataset(root)
    entries = dataset.list_shapes()
    assert [(entry.id, entry.category, entry.split) for entry in entries] == [
        ("chair_0001", "chair", "train"),
        ("night_stand_0001", "night_stand", "train"),
        ("chair_0002", "chair", "test"),
    ]
    assert dataset.counts() == {"train": 2, "test": 1}
    assert len(build_manifest(entries, shard_size=2)) == 3
    assert len(dataset.load(entries[1].path)) == 12
    assert ModelNet40Dataset(root, ["night_stand"]).counts() == {"train": 1, "test": 0}


def test_only_the_first_points(root):
    path = root / "chair/chair_0001.txt"
    cloud = ModelNet40Dataset(root, points=5).load(path)
    np.testing.assert_array_equal(cloud.points, ModelNet40Dataset(root).load(path).points[:5])
    assert len(cloud.normals) == 5
    with pytest.raises(InputError, match=r"chair_0001\.txt: dataset\.points asks for 13 points, but the file has 12"):
        ModelNet40Dataset(root, points=13).load(path)
    with pytest.raises(ConfigError, match=r"dataset\.points: expected at least 4"):
        ModelNet40Dataset(root, points=3)


def test_what_is_missing_or_damaged(root):
    with pytest.raises(DatasetError, match="did you mean 'chair'"):
        ModelNet40Dataset(root, ["chairs"])
    with pytest.raises(DatasetError, match=r"nowhere: the data set's folder does not exist\. Fetch https://"):
        ModelNet40Dataset(root / "nowhere").counts()
    (root / "modelnet40_test.txt").write_text("chair_0002\nspaceship_0001\n")
    with pytest.raises(DatasetError, match=r"modelnet40_test\.txt: .*got 'spaceship_0001'"):
        ModelNet40Dataset(root).counts()


def test_real_data(real_data):
    root = real_data / "modelnet40_normal_resampled"
    assert (root / "modelnet40_shape_names.txt").read_text().split() == list(CATEGORIES)
    dataset = ModelNet40Dataset(root, points=1024)
    entries = dataset.list_shapes()
    assert dataset.counts() == {"train": 10, "test": 8}
    assert len(build_manifest(entries, shard_size=50)) == 18
    cloud = dataset.load(entries[0].path)
    assert len(cloud) == 1024
    np.testing.assert_allclose(np.linalg.norm(cloud.normals, axis=1), 1)
