import pytest
from solids import sphere_cloud

from morphoskel.config import compose
from morphoskel.datasets.configured import check_plan, count_shapes, open_configured
from morphoskel.datasets.manifest import Entry
from morphoskel.errors import DatasetError
from morphoskel.formats import write_cloud_ply


def section(*overrides):
    return compose(overrides).model_dump(mode="json")["dataset"]


@pytest.mark.parametrize("kind", ["point2skeleton", "modelnet40", "shapenetpart"])
def test_an_absent_data_set_is_planned_with_its_published_counts(kind, tmp_path):
    planned = section(f"dataset={kind}", f"dataset.root={tmp_path}/absent")
    assert count_shapes(planned, seed=1) == planned["counts"]


def test_an_absent_folder_of_ones_own_is_an_error(tmp_path):
    with pytest.raises(DatasetError, match="absent"):
        count_shapes(section("dataset=folder", f"dataset.root={tmp_path}/absent"), seed=1)


def test_what_is_there_is_counted(tmp_path):
    for number in range(3):
        write_cloud_ply(tmp_path / f"{number}.ply", sphere_cloud(50, seed=number))
    folder = section("dataset=folder", f"dataset.root={tmp_path}")
    assert sum(count_shapes(folder, seed=1).values()) == 3
    dataset = open_configured(folder, seed=1)
    assert len(dataset.load(dataset.list_shapes()[0].path)) == 50


def test_synthetic_counts_are_arithmetic(tmp_path):
    synthetic = section("dataset.per_category={train: 3, test: 2}", f"dataset.root={tmp_path}/absent")
    assert count_shapes(synthetic, seed=1) == {"train": 24, "test": 16}


def test_a_data_set_that_does_not_match_the_plan_is_refused(tmp_path):
    entries = [Entry(str(number), "Chair", "test", tmp_path) for number in range(3)]
    check_plan(entries, {"test": 3})
    with pytest.raises(DatasetError, match=r"test: 3 found, 1184 planned; train: 0 found, 5904 planned.*run again"):
        check_plan(entries, {"train": 5904, "test": 1184})
