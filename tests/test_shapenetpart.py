import json
import logging

import numpy as np
import pytest

from morphoskel.datasets.manifest import build_manifest
from morphoskel.datasets.shapenetpart import CATEGORIES, PARTS, ShapeNetPartDataset
from morphoskel.errors import DatasetError, InputError

CHAIR, LAMP = "03001627", "03636649"
POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
LISTED = {"train": [f"{CHAIR}/a", f"{LAMP}/a"], "val": [f"{CHAIR}/b"], "test": [f"{CHAIR}/c"]}


def write_lists(root, listed=LISTED):
    (root / "train_test_split").mkdir(exist_ok=True)
    for split, shapes in listed.items():
        path = root / f"train_test_split/shuffled_{split}_file_list.json"
        path.write_text(json.dumps([f"shape_data/{shape}" for shape in shapes]))


@pytest.fixture(params=["normal", "raw"])
def root(request, tmp_path):
    write_lists(tmp_path)
    for shape in [shape for shapes in LISTED.values() for shape in shapes]:
        offset, name = shape.split("/")
        labels = [1, 2, 1, 3]
        (tmp_path / offset / "points").mkdir(parents=True, exist_ok=True)
        (tmp_path / offset / "points_label").mkdir(parents=True, exist_ok=True)
        (tmp_path / offset / f"points/{name}.pts").write_text("".join(f"{x} {y} {z}\n" for x, y, z in POINTS))
        (tmp_path / offset / f"points_label/{name}.seg").write_text("".join(f"{label}\n" for label in labels))
        first = PARTS[CATEGORIES[offset]].start
        rows = "".join(f"{x} {y} {z} 0 0 1 {first + n - 1}.0\n" for (x, y, z), n in zip(POINTS, labels, strict=True))
        (tmp_path / offset / f"{name}.txt").write_text(rows)
    for offset in (CHAIR, LAMP):
        for folder in ("points", "points_label") if request.param == "normal" else ():
            for path in (tmp_path / offset / folder).iterdir():
                path.unlink()
            (tmp_path / offset / folder).rmdir()
        for path in (tmp_path / offset).glob("*.txt") if request.param == "raw" else ():
            path.unlink()
    return tmp_path


def test_the_50_parts_are_numbered_through_the_categories():
    assert list(PARTS) == list(CATEGORIES.values())
    assert [label for parts in PARTS.values() for label in parts] == list(range(50))


def test_lists_counts_and_loads_the_same_labels_from_both_layouts(root):
    dataset = ShapeNetPartDataset(root)
    entries = dataset.list_shapes()
    assert [(entry.id, entry.category, entry.split) for entry in entries] == [
        (f"{CHAIR}-a", "Chair", "train"),
        (f"{LAMP}-a", "Lamp", "train"),
        (f"{CHAIR}-b", "Chair", "val"),
        (f"{CHAIR}-c", "Chair", "test"),
    ]
    assert dataset.counts() == {"train": 2, "val": 1, "test": 1}
    assert len(build_manifest(entries, shard_size=2)) == 4
    np.testing.assert_array_equal(dataset.load(entries[0].path).labels, [12, 13, 12, 14])
    lamp = dataset.load(entries[1].path)
    np.testing.assert_array_equal(lamp.labels, [24, 25, 24, 26])
    np.testing.assert_array_equal(lamp.points, POINTS)
    assert ShapeNetPartDataset(root, ["Lamp"]).counts() == {"train": 1, "val": 0, "test": 0}


def test_a_listed_shape_that_is_missing(root, caplog):
    write_lists(root, LISTED | {"test": [f"{CHAIR}/c", f"{CHAIR}/gone", f"{LAMP}/gone"]})
    with pytest.raises(DatasetError, match=f"2 shapes of the split 'test' are not on disk, first {CHAIR}/gone"):
        ShapeNetPartDataset(root).counts()
    with caplog.at_level(logging.WARNING):
        dataset = ShapeNetPartDataset(root, allow_missing=True)
        assert dataset.counts() == {"train": 2, "val": 1, "test": 1}
    assert "2 shapes of the split 'test' are not on disk" in caplog.text
    assert len(dataset.list_shapes()) == 4


def test_a_missing_list(root, caplog):
    (root / "train_test_split/shuffled_val_file_list.json").unlink()
    with pytest.raises(DatasetError, match=r"the list of the split 'val' is missing\. Fetch .*allow_missing=true"):
        ShapeNetPartDataset(root).list_shapes()
    with caplog.at_level(logging.WARNING):
        assert ShapeNetPartDataset(root, allow_missing=True).counts() == {"train": 2, "test": 1}
    assert "the split 'val' is left out" in caplog.text


@pytest.mark.parametrize("allow_missing", [False, True])
def test_a_shape_that_is_listed_twice(root, allow_missing):
    write_lists(root, LISTED | {"test": [f"{CHAIR}/a"]})
    with pytest.raises(DatasetError, match=f"1 shapes are listed more than once, first {CHAIR}/a in train, test"):
        ShapeNetPartDataset(root, allow_missing=allow_missing).counts()


@pytest.mark.parametrize("content", ["{", '{"a": 1}', "3", '["a"]', '["shape_data/123/a"]', "[3]"])
def test_a_damaged_list(root, content):
    (root / "train_test_split/shuffled_val_file_list.json").write_text(content)
    with pytest.raises(DatasetError, match=r"shuffled_val_file_list\.json: expected"):
        ShapeNetPartDataset(root).counts()


def test_damaged_labels(root):
    path = ShapeNetPartDataset(root).list_shapes()[0].path
    if path.suffix == ".txt":
        cases = {
            "".join(f"{x} {y} {z} 0 0 1 47\n" for x, y, z in POINTS): "labels of Chair are 12 to 15, .* has 47 to 47",
            "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in POINTS): "expected 7 columns",
        }
    else:
        cases = {
            "1\n2\n": "holds 2 labels for 4 points",
            "1 2 3 5": "labels of Chair are 1 to 4, but the shape has 1 to 5",
            "1 2 3 x": "whole number",
            None: "labels of the shape cannot be read",
        }
        path = path.parent.parent / f"points_label/{path.stem}.seg"
    for content, message in cases.items():
        if content is None:
            path.unlink()
        else:
            path.write_text(content)
        with pytest.raises(InputError, match=message):
            ShapeNetPartDataset(root).load(ShapeNetPartDataset(root).list_shapes()[0].path)


def test_a_file_of_another_folder(tmp_path):
    (tmp_path / "a.txt").write_text("".join(f"{x} {y} {z} 0 0 1 1\n" for x, y, z in POINTS))
    with pytest.raises(InputError, match="is no folder of ShapeNetPart"):
        ShapeNetPartDataset(tmp_path).load(tmp_path / "a.txt")


def test_an_absent_data_set(tmp_path):
    with pytest.raises(DatasetError, match="did you mean 'Chair'"):
        ShapeNetPartDataset(tmp_path, ["Chairs"])
    with pytest.raises(DatasetError, match=r"nowhere: the data set's folder does not exist\. Fetch https://"):
        ShapeNetPartDataset(tmp_path / "nowhere").counts()


def test_real_data_raw(real_data):
    dataset = ShapeNetPartDataset(real_data / "shapenetpart_raw", allow_missing=True)  # it has one list only
    entries = dataset.list_shapes()
    assert {entry.category for entry in entries} == set(CATEGORIES.values())
    for entry in entries:
        cloud = dataset.load(entry.path)
        assert len(cloud) > 2000
        assert set(cloud.labels) <= set(PARTS[entry.category])


def test_real_data_with_normals(real_data, tmp_path):
    source = real_data / "shapenetpart_normal"
    with pytest.raises(DatasetError, match="listed more than once"):  # the lists of the extract overlap
        ShapeNetPartDataset(source, allow_missing=True).counts()
    files = sorted(source.glob("0*/*.txt"))
    for folder in {path.parent.name for path in files}:
        (tmp_path / folder).symlink_to(source / folder)
    write_lists(tmp_path, {"train": [], "val": [], "test": [f"{path.parent.name}/{path.stem}" for path in files]})
    dataset = ShapeNetPartDataset(tmp_path)
    assert dataset.counts() == {"train": 0, "val": 0, "test": 4}
    for entry in dataset.list_shapes():
        cloud = dataset.load(entry.path)
        assert set(cloud.labels) <= set(PARTS[entry.category])
        np.testing.assert_allclose(np.linalg.norm(cloud.normals, axis=1), 1)


def test_axes_can_be_exchanged(root):
    usual, turned = ShapeNetPartDataset(root), ShapeNetPartDataset(root, axes=("x", "z", "-y"))
    for entry in usual.list_shapes():
        first, second = usual.load(entry.path), turned.load(entry.path)
        assert np.array_equal(second.points, first.points[:, [0, 2, 1]] * [1, 1, -1])
        assert np.array_equal(second.labels, first.labels)
        if first.normals is not None:
            assert np.array_equal(second.normals, first.normals[:, [0, 2, 1]] * [1, 1, -1])
