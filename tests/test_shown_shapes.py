import pytest
from shard_folders import write_shard
from solids import ball

from morphoskel.datasets.manifest import ShapeRecord
from morphoskel.errors import InputError
from morphoskel.reporting.figures.shown_shapes import (
    NOT_THERE,
    choose_records,
    choose_shapes,
    find_result,
    find_skeleton,
    find_surface,
)
from morphoskel.shapes import Skeleton

IDS = ["a0", "a1", "b0", "b1", "c0"]
CATEGORIES = ["Airplane", "Airplane", "Table Lamp", "Table Lamp", "Chair"]
BALLS = Skeleton([[0.0, 0, 0], [1, 0, 0]], [0.5, 0.25], [0.0, 0.0])


@pytest.mark.parametrize(
    ("wanted", "count", "expected"),
    [
        ((), None, {"Airplane": 0, "Table Lamp": 2, "Chair": 4}),
        (("lamp", "earphone"), None, {"Table Lamp": 2, "Airplane": 0, "Chair": 4}),
        (("b1", "lamp", "a1"), 3, {"Table Lamp": 3, "Airplane": 1, "Chair": 4}),
        (("a1", "a0", "a1"), 3, {"Airplane": 1, "a0": 0, "Table Lamp": 2}),
        (("chair",), 1, {"Chair": 4}),
    ],
)
def test_wanted_shapes_come_first_and_then_one_of_every_category(wanted, count, expected):
    chosen = choose_shapes(IDS, CATEGORIES, wanted=wanted, count=count)
    assert list(chosen.items()) == list(expected.items())


def test_records_are_chosen_like_shapes(tmp_path):
    records = [ShapeRecord(shape, category, "test", 0, tmp_path, "")
               for shape, category in zip(IDS, CATEGORIES, strict=True)]  # fmt: skip
    chosen = choose_records(records, wanted=["chair"], count=2)
    assert {title: record.id for title, record in chosen.items()} == {"Chair": "c0", "Airplane": "a0"}


def test_results_are_found_in_any_shard_or_said_to_be_missing(tmp_path):
    folders = [
        write_shard(tmp_path / "0", {"a": BALLS, "b": "select_skeleton"}),
        write_shard(tmp_path / "1", {"c": ball(subdivisions=1)}),
        tmp_path / "absent",
    ]
    assert find_result(folders, "a") == tmp_path / "0" / "a.ply"
    assert len(find_skeleton(folders, "a")) == 2
    assert find_skeleton(folders, "b") == find_surface(folders, "b") == "failed at\nselect\nskeleton"
    assert len(find_surface(folders, "c").triangles) == 80
    assert find_skeleton(folders, "d") == find_surface([], "a") == NOT_THERE


def test_a_skeleton_without_balls_is_said_to_have_none(tmp_path):
    empty = Skeleton(BALLS.points[:0], BALLS.radii[:0], BALLS.radii[:0])
    assert find_skeleton([write_shard(tmp_path, {"a": empty})], "a") == "no balls"


def test_a_damaged_result_is_an_error(tmp_path):
    folder = write_shard(tmp_path, {"a": BALLS})
    (folder / "a.ply").write_bytes(b"ply")
    with pytest.raises(InputError, match=r"a\.ply"):
        find_skeleton([folder], "a")
