import pytest
from measured_run import config

from morphoskel.errors import InputError
from morphoskel.planning.extent import Extent

COUNTS = {"synthetic": {"train": 2, "test": 6}, "synthetic_parts": {"train": 9}}


@pytest.mark.parametrize(("shard", "shapes"), [("00000", 4), ("00001", 2), ("00002", 0)])
def test_the_last_shard_holds_what_is_left(shard, shapes):
    extent = Extent(config(), COUNTS)
    assert extent.shapes({"dataset": "synthetic", "split": "test", "shard": shard}) == shapes


def test_the_first_data_set_is_meant_where_none_is_named():
    assert Extent(config(), COUNTS).shapes({}, "train") == 2


def test_an_unknown_split_is_told():
    with pytest.raises(InputError, match="split val of synthetic is not known"):
        Extent(config(), COUNTS).shapes({"split": "val"})


def test_the_second_data_set_has_settings_of_its_own():
    extent = Extent(config("tasks.segmentation.skeletons.candidates=500"), COUNTS)
    assert extent.setting("skeleton.candidates.count", {"dataset": "synthetic"}) == 1000
    assert extent.setting("skeleton.candidates.count", {"dataset": "synthetic_parts"}) == 500
    assert extent.setting("skeleton.k", {"dataset": "synthetic_parts"}) == extent.setting("skeleton.k", {})


def test_what_is_not_there_is_none():
    assert Extent(config(), COUNTS).setting("skeleton.no.such", {}) is None


def test_a_section_tells_what_the_second_data_set_has_of_its_own():
    extent = Extent(config("tasks.segmentation.skeletons.depth=5"), COUNTS)
    first, second = {"dataset": "synthetic"}, {"dataset": "other"}
    assert extent.setting("surface.repaired_poisson", first)["depth"] != 5
    assert extent.setting("surface.repaired_poisson", second)["depth"] == 5
    assert extent.setting("surface.ball_pivoting", second) == extent.setting("surface.ball_pivoting", first)
