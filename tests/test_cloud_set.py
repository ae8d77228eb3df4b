import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tiny_clouds import tiny_clouds

from morphoskel.config import compose
from morphoskel.datasets.cloud_set import gather_clouds, normalise, read_cloud_set, write_cloud_set
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.errors import DatasetError, InputError, ShapeError
from morphoskel.formats import write_cloud_ply
from morphoskel.shapes import PointCloud


@given(seed=st.integers(0, 99), size=st.floats(1e-6, 1e6), shift=st.floats(-100, 100))
def test_normalised_clouds_have_centroid_0_and_radius_1(seed, size, shift):
    cloud = np.random.default_rng(seed).normal(size=(20, 3)) * size + shift * size
    points, centre, scale = normalise(cloud)
    assert points.dtype == np.float32
    assert np.abs(points.mean(axis=0)).max() < 1e-6
    assert np.linalg.norm(points, axis=1).max() == pytest.approx(1, abs=1e-6)
    np.testing.assert_allclose(points * scale + centre, cloud, atol=1e-6 * scale)


def test_normalising_agrees_with_its_naive_twin():
    cloud = np.random.default_rng(1).uniform(size=(15, 3))
    centre = [math.fsum(axis) / 15 for axis in cloud.T]
    scale = max(math.dist(point, centre) for point in cloud)
    points, found_centre, found_scale = normalise(cloud)
    assert found_centre == pytest.approx(centre)
    assert found_scale == pytest.approx(scale)
    naive = [[(a - b) / scale for a, b in zip(point, centre, strict=True)] for point in cloud]
    np.testing.assert_allclose(points, naive, atol=1e-6)


def test_a_cloud_needs_an_extent():
    with pytest.raises(ShapeError, match="all 7 points are the same"):
        normalise(np.full((7, 3), 0.1))


def make(folder, clouds):
    """Write clouds, by class and split, as a data set; return its section and its manifest."""
    for place, count in clouds.items():
        cloud = np.random.default_rng(sum(map(ord, place))).normal(size=(count, 3)) + 4
        write_cloud_ply(folder / "data" / f"{place}.ply", PointCloud(cloud))
    section = compose(["dataset=class_tree", f"dataset.root={folder}/data"]).model_dump(mode="json")["dataset"]
    entries = open_configured(section, seed=1).list_shapes()
    write_manifest(folder / "manifest.csv", build_manifest(entries, shard_size=2))
    return section, folder / "manifest.csv"


CLOUDS = {"vase/train/c": 30, "bowl/train/a": 20, "vase/train/b": 25, "ant/test/x": 20, "vase/test/y": 20}


def gather(folder, clouds=CLOUDS, split="train", points=20, seed=3):
    section, manifest = make(folder, clouds)
    return gather_clouds(manifest, split, dataset=section, points=points, seed=seed, progress=False)


@pytest.fixture(scope="module")
def gathered(tmp_path_factory):
    return gather(tmp_path_factory.mktemp("data"))


def test_the_labels_of_all_splits_have_the_same_names(gathered, tmp_path):
    assert gathered.class_names.tolist() == ["ant", "bowl", "vase"]  # no ant is in the training split
    assert gathered.ids.tolist() == ["bowl-train-a", "vase-train-b", "vase-train-c"]
    assert gathered.categories.tolist() == ["bowl", "vase", "vase"]
    assert gathered.labels.tolist() == [1, 2, 2]
    assert gathered.labels.dtype == np.int64
    test = gather(tmp_path, split="test")
    assert test.class_names.tolist() == gathered.class_names.tolist()
    assert test.labels.tolist() == [0, 2]


def test_points_are_drawn_of_the_cloud_without_replacement(gathered, tmp_path):
    section, _ = make(tmp_path, CLOUDS)
    dataset = open_configured(section, seed=1)
    assert gathered.points.shape == (3, 20, 3)
    for number, entry in enumerate(sorted(entry.path for entry in dataset.list_shapes() if entry.split == "train")):
        original = dataset.load(entry).points
        found = gathered.points[number] * gathered.scales[number] + gathered.centres[number]
        distances = np.linalg.norm(found[:, None] - original, axis=2)
        assert distances.min(axis=1).max() < 1e-5
        assert len({*distances.argmin(axis=1).tolist()}) == 20
        if len(original) == 20:
            assert distances.argmin(axis=1).tolist() == list(range(20))  # nothing to draw: the order is kept


def test_a_shapes_draw_depends_on_seed_and_id_alone(gathered, tmp_path):
    more = gather(tmp_path / "more", {**CLOUDS, "bowl/train/first": 22, "vase/train/a": 30})
    assert len(more) == 5
    for number, shape in enumerate(gathered.ids):
        place = more.ids.tolist().index(shape)
        assert np.array_equal(more.points[place], gathered.points[number])
        assert np.array_equal(more.centres[place], gathered.centres[number])
    other = gather(tmp_path / "other", seed=4)
    assert np.array_equal(other.points[0], gathered.points[0])  # has just 20 points
    assert not np.array_equal(other.points[1], gathered.points[1])
    twins = gather(tmp_path / "twins", {"vase/train/ab": 30, "vase/train/ba": 30}, points=20)
    assert not np.array_equal(twins.points[0], twins.points[1])  # the same cloud under two ids


def test_a_cloud_with_too_few_points_is_named(tmp_path):
    with pytest.raises(ShapeError, match=r"bowl-train-a \(.*a\.ply\): has 20 points, 21 are wanted"):
        gather(tmp_path, points=21)
    with pytest.raises(DatasetError, match="no shape of split 'val'"):
        gather(tmp_path, split="val")


LABELS = np.array([1, 2, 2, 3, 1])


def write_parts(folder, listed):
    """Write ShapeNetPart's raw layout: chairs and lamps of five points, of which the first decides the shape's id."""
    for split, shapes in listed.items():
        path = folder / f"train_test_split/shuffled_{split}_file_list.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps([f"shape_data/{shape}" for shape in shapes]))
        for number, shape in enumerate(shapes):
            offset, name = shape.split("/")
            for kind, suffix, rows in (
                ("points", "pts", np.random.default_rng(number).normal(size=(5, 3))),
                ("points_label", "seg", LABELS),
            ):
                (folder / offset / kind).mkdir(parents=True, exist_ok=True)
                np.savetxt(folder / offset / kind / f"{name}.{suffix}", rows, fmt="%.9g")
    section = compose(["dataset=shapenetpart", f"dataset.root={folder}"]).model_dump(mode="json")["dataset"]
    entries = open_configured(section, seed=1).list_shapes()
    write_manifest(folder / "manifest.csv", build_manifest(entries, shard_size=2))
    return section, folder / "manifest.csv"


@pytest.fixture(scope="module")
def with_parts(tmp_path_factory):
    chair, lamp = "03001627", "03636649"
    listed = {"train": [f"{lamp}/a", f"{chair}/a"], "val": [f"{chair}/b"], "test": [f"{lamp}/c"]}
    return write_parts(tmp_path_factory.mktemp("parts"), listed)


@pytest.mark.parametrize("points", [3, 5, 12])
def test_parts_stay_with_their_points(with_parts, points, tmp_path):
    section, manifest = with_parts
    gathered = gather_clouds(manifest, "train", dataset=section, points=points, seed=3, repeat=True, progress=False)
    write_cloud_set(gathered, tmp_path / "clouds.npz")
    clouds = read_cloud_set(tmp_path / "clouds.npz")
    assert clouds.categories.tolist() == ["Chair", "Lamp"]
    assert clouds.lengths.tolist() == [min(points, 5)] * 2
    first = {"Chair": 12, "Lamp": 24}
    assert len(clouds.part_classes) == 50
    for part, label in enumerate(clouds.part_classes):
        owner = next((name for name, start in first.items() if start <= part < start + 4), None)
        assert (clouds.class_names[label] if label >= 0 else None) == owner
    dataset = open_configured(section, seed=1)
    entries = sorted((entry.id, entry.path) for entry in dataset.list_shapes() if entry.split == "train")
    for shape, (_, path) in enumerate(entries):
        original = dataset.load(path)
        found = clouds.points[shape] * clouds.scales[shape] + clouds.centres[shape]
        nearest = np.linalg.norm(found[:, None] - original.points, axis=2).argmin(axis=1)
        kept = clouds.parts[shape] >= 0
        assert np.array_equal(clouds.parts[shape][kept], original.labels[nearest][kept])
        assert len(set(nearest[kept].tolist())) == kept.sum()
        assert np.array_equal(nearest, nearest[np.arange(points) % min(points, 5)])  # the others repeat them in order


def test_a_data_set_without_parts_has_none(gathered):
    assert gathered.parts is None
    assert gathered.part_classes is None
    assert gathered.lengths.tolist() == [20, 20, 20]


def test_a_file_gives_the_clouds_back(tmp_path):
    clouds = tiny_clouds()
    write_cloud_set(clouds, tmp_path / "sub" / "clouds.npz")
    again = read_cloud_set(tmp_path / "sub" / "clouds.npz")
    for name in ("ids", "labels", "class_names", "points", "centres", "scales"):
        first, second = getattr(clouds, name), getattr(again, name)
        assert first.dtype == second.dtype
        assert np.array_equal(first, second)
    assert [path.name for path in (tmp_path / "sub").iterdir()] == ["clouds.npz"]


def test_other_files_are_refused(tmp_path):
    (tmp_path / "empty.npz").touch()
    (tmp_path / "text.npz").write_text("points")
    np.save(tmp_path / "array.npy", np.zeros(3))
    np.savez(tmp_path / "others.npz", ids=np.zeros(3))
    np.savez(tmp_path / "pickled.npz", ids=np.array([None]))
    write_cloud_set(tiny_clouds(), tmp_path / "whole.npz")
    content = (tmp_path / "whole.npz").read_bytes()
    (tmp_path / "cut.npz").write_bytes(content[: len(content) // 2])
    names = ["absent.npz", "empty.npz", "text.npz", "array.npy", "others.npz", "pickled.npz", "cut.npz"]
    for name in names:
        with pytest.raises(InputError, match=rf"{name}: expected a file of clouds of this version \(.*make it again"):
            read_cloud_set(tmp_path / name)


def test_a_classifier_must_know_the_same_classes_in_the_same_order():
    clouds = tiny_clouds()
    clouds.check_classes(("ball", "line"))
    for names in (("line", "ball"), ("ball",), ("ball", "line", "cube"), ("0", "1")):
        with pytest.raises(InputError, match=f"2 classes ball, line, got one of {', '.join(names)}; train"):
            clouds.check_classes(names)
