import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.segmentation_names import (
    COMPARISONS,
    STRATEGY_NAMES,
    difference_name,
    row_name,
    row_order,
    split_row,
)
from morphoskel.sampling.samplers import SAMPLERS


def test_every_sampler_can_choose_labels():
    assert set(STRATEGY_NAMES) == {"full", *SAMPLERS}
    assert {name for pair in COMPARISONS for name in pair} <= set(SAMPLERS)


def test_names_are_the_papers():
    assert row_name("full", "1") == "PointNet (all labels)"
    assert row_name("fps", "16") == "FPS, ratio 16"
    assert row_name("ms3d", "128") == "MS3D, ratio 128"
    assert difference_name("ms3d", "fps", "32") == "MS3D minus FPS, ratio 32"


def test_an_unknown_strategy_is_named_with_the_known_ones():
    with pytest.raises(InputError, match="no strategy 'all_points'; known are full, random, fps"):
        row_name("all_points", "1")


def test_names_can_be_taken_apart():
    assert split_row("LFS-weighted FPS, ratio 64") == ("LFS-weighted FPS", "64")
    assert split_row("PointNet (all labels)") == ("PointNet (all labels)", "")


def test_rows_are_in_the_order_of_ratio_then_strategy():
    names = ["PointNet (all labels)", "Random, ratio 16", "FPS, ratio 16", "MS3D, ratio 16", "uniform prior, ratio 16",
             "MS3D minus FPS, ratio 16", "LFS-weighted FPS minus FPS, ratio 16", "Something else, ratio 16",
             "Random, ratio 32", "FPS, ratio 128"]  # fmt: skip
    assert sorted(names[::-1], key=row_order) == names
