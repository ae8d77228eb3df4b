import numpy as np
import pytest

from morphoskel.datasets.manifest import build_manifest
from morphoskel.datasets.point2skeleton import CATEGORIES, Point2SkeletonDataset
from morphoskel.errors import DatasetError, InputError

PROPERTIES = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
ROWS = "0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n0 0 1 0 0 0\n"
PLY = f"ply\nformat ascii 1.0\nelement vertex 4\n{PROPERTIES}end_header\n{ROWS}"


@pytest.fixture
def root(tmp_path):
    shapes = {"train": ["03001627/a", "03001627/b", "03797390/a"], "test": ["03001627/c"]}
    (tmp_path / "data-split").mkdir()
    for split, listed in shapes.items():
        (tmp_path / f"data-split/all-{split}.txt").write_text("\n".join(listed) + "\n")
        for name in listed:
            path = tmp_path / "pointclouds" / f"{name}.ply"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(PLY)
    return tmp_path


def test_lists_counts_and_loads(root):
    dataset = Point2SkeletonDataset(root)
    entries = dataset.list_shapes()
    assert [(entry.id, entry.category, entry.split) for entry in entries] == [
        ("03001627-a", "Chair", "train"),
        ("03001627-b", "Chair", "train"),
        ("03797390-a", "Mug", "train"),  # the same name in another category is another shape
        ("03001627-c", "Chair", "test"),
    ]
    assert dataset.counts() == {"train": 3, "test": 1}
    assert len(build_manifest(entries, shard_size=2)) == 4
    cloud = dataset.load(entries[0].path)
    np.testing.assert_array_equal(cloud.normals[3], 0)


def test_only_some_categories(root):
    dataset = Point2SkeletonDataset(root, ["Mug"])
    assert [entry.id for entry in dataset.list_shapes()] == ["03797390-a"]
    assert dataset.counts() == {"train": 1, "test": 0}
    with pytest.raises(DatasetError, match="did you mean 'Mug'"):
        Point2SkeletonDataset(root, ["Mugs"])


def test_what_is_missing_or_damaged(root):
    with pytest.raises(DatasetError, match=r"nowhere: the data set's folder does not exist\. .*by hand"):
        Point2SkeletonDataset(root / "nowhere").counts()
    (root / "data-split/all-test.txt").write_text("00000000/a\n")
    with pytest.raises(DatasetError, match=r"all-test\.txt: expected lines <offset>/<id> .*got '00000000/a'"):
        Point2SkeletonDataset(root).counts()
    (root / "data-split/all-test.txt").unlink()
    with pytest.raises(DatasetError, match=r"all-test\.txt: missing"):
        Point2SkeletonDataset(root).list_shapes()
    (root / "pointclouds/03001627/a.ply").write_text(PLY[:-12])
    with pytest.raises(InputError, match=r"a\.ply: .*truncated"):
        Point2SkeletonDataset(root).load(root / "pointclouds/03001627/a.ply")


def test_real_data(real_data):
    dataset = Point2SkeletonDataset(real_data / "point2skeleton")
    entries = dataset.list_shapes()
    assert dataset.counts() == {"train": 80, "test": 80}
    assert {entry.category for entry in entries} == set(CATEGORIES.values())
    assert len(build_manifest(entries, shard_size=50)) == 160
    for entry in entries:
        cloud = dataset.load(entry.path)
        assert len(cloud) == 2000
        assert np.abs(cloud.points).max() <= 1
        lengths = np.linalg.norm(cloud.normals, axis=1)
        assert np.isclose(lengths, 1).sum() + (lengths == 0).sum() == 2000
