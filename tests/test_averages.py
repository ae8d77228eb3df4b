import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import (
    MEAN_OVER_CATEGORIES,
    MEAN_OVER_SHAPES,
    averages,
    mean_over_categories,
    mean_over_shapes,
)

VALUES = [1.0, 2.0, 6.0, math.nan, 10.0]
CATEGORIES = ["Mug", "Mug", "Mug", "Mug", "Chair"]


def test_thirteen_shapes_released_are_thirteen_fourteenths():
    values = np.random.default_rng(3).random(13)
    exact, released = (mean_over_shapes(values, protocol).value for protocol in ("correct", "released"))
    assert exact == pytest.approx(values.mean())
    assert released == pytest.approx(exact * 13 / 14)


def test_by_hand():
    means = averages(VALUES, CATEGORIES, "correct")
    assert list(means) == ["Mug", "Chair", MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES]
    assert (means["Mug"].value, means["Mug"].n, means["Mug"].n_failed) == (3.0, 3, 1)
    assert means["Mug"].std == pytest.approx(math.sqrt(((1 - 3) ** 2 + (2 - 3) ** 2 + (6 - 3) ** 2) / 2))
    assert (means["Chair"].value, means["Chair"].n, means["Chair"].n_failed) == (10.0, 1, 0)
    assert math.isnan(means["Chair"].std)
    assert (means[MEAN_OVER_CATEGORIES].value, means[MEAN_OVER_CATEGORIES].n) == (6.5, 4)
    assert math.isnan(means[MEAN_OVER_CATEGORIES].std)
    assert (means[MEAN_OVER_SHAPES].value, means[MEAN_OVER_SHAPES].n) == (4.75, 4)
    assert means[MEAN_OVER_CATEGORIES].n_failed == means[MEAN_OVER_SHAPES].n_failed == 1


def test_by_hand_released():
    """One more than the number of shapes in every divisor, but not in that of the categories."""
    means = averages(VALUES, CATEGORIES, "released")
    assert {name: mean.value for name, mean in means.items()} == {
        "Mug": 9 / 4,
        "Chair": 10 / 2,
        MEAN_OVER_CATEGORIES: (9 / 4 + 10 / 2) / 2,
        MEAN_OVER_SHAPES: 19 / 5,
    }


@pytest.mark.parametrize("protocol", ["correct", "released"])
def test_a_category_that_failed_wholly_leaves_no_mean_over_categories(protocol):
    means = averages([1.0, math.nan], ["Mug", "Chair"], protocol)
    assert math.isnan(means["Chair"].value)
    assert (means["Chair"].n, means["Chair"].n_failed) == (0, 1)
    assert math.isnan(means[MEAN_OVER_CATEGORIES].value)
    assert means[MEAN_OVER_SHAPES].n_failed == 1
    assert not math.isnan(means[MEAN_OVER_SHAPES].value)


@given(st.lists(st.floats(0, 1e6), min_size=1, max_size=30), st.randoms(use_true_random=False))
def test_the_order_of_the_shapes_does_not_matter_to_the_last_bit(values, random):
    shuffled = random.sample(values, len(values))
    for protocol in ("correct", "released"):
        before, after = mean_over_shapes(values, protocol), mean_over_shapes(shuffled, protocol)
        assert np.array_equal([*vars(before).values()], [*vars(after).values()], equal_nan=True)


@given(st.lists(st.floats(0, 1e6), min_size=1, max_size=12), st.integers(2, 4))
def test_both_averages_agree_if_the_categories_are_equally_large(values, copies):
    shapes = values * copies
    names = [str(position) for position in range(len(values))] * copies
    by_category, by_shape = mean_over_categories(shapes, names, "correct"), mean_over_shapes(shapes, "correct")
    assert by_category.value == pytest.approx(by_shape.value)


@pytest.mark.parametrize(
    ("values", "categories", "message"),
    [
        ([], [], "S >= 1"),
        ([[1.0]], ["Mug"], r"got \(1, 1\)"),
        ([1.0, math.inf], ["Mug", "Mug"], "shape number 1 has an infinite value"),
        ([1.0, 2.0], ["Mug"], "categories: expected 2, one a value, got 1"),
        ([1.0], [MEAN_OVER_SHAPES], "is the name of an average"),
    ],
)
def test_illegal_values_are_named(values, categories, message):
    with pytest.raises(InputError, match=message):
        averages(values, categories, "correct")
