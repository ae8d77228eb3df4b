import math
import statistics

import numpy as np
import pytest
from sampled import draw_frame, draw_rows, shape_frame, shape_rows

from morphoskel.errors import InputError
from morphoskel.evaluation.classification import mean_interval
from morphoskel.reporting.sampling_values import (
    deviation_over_draws,
    equality_test,
    interval_half_width,
    mean_over_categories,
    mean_over_shapes,
    subtract,
)
from morphoskel.seeds import derive_generator


def trainings(*values_of_trainings, sampler="ms3d", **more):
    return shape_frame(
        *(shape_rows(sampler, values, seed=seed, **more) for seed, values in enumerate(values_of_trainings))
    )


def naive_mean(values_of_trainings):
    """Mean, deviation and counts by loops over shapes and trainings."""
    whole = [s for s in zip(*values_of_trainings, strict=True) if not any(math.isnan(value) for value in s)]
    means = [100 * sum(shape[t] for shape in whole) / len(whole) for t in range(len(values_of_trainings))]
    spread = statistics.stdev(means) if len(means) > 1 else math.nan
    return sum(means) / len(means), spread, len(whole), len(values_of_trainings[0]) - len(whole)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_means_agree_with_loops(count):
    values = np.random.default_rng(count).random((count, 12))
    values[0, 3] = values[-1, 5] = math.nan
    mean = mean_over_shapes(trainings(*values).sample(frac=1, random_state=1), "correct")
    expected = naive_mean(values)
    assert (mean.value, mean.std) == pytest.approx(expected[:2], nan_ok=True)
    assert (mean.n, mean.n_failed) == expected[2:]


def test_a_row_whose_shapes_all_failed_has_no_value():
    mean = mean_over_shapes(trainings([math.nan, math.nan], [math.nan, math.nan]), "correct")
    assert math.isnan(mean.value)
    assert math.isnan(mean.std)
    assert (mean.n, mean.n_failed) == (0, 2)


def test_a_value_that_is_not_defined_is_no_failure():
    rows = trainings([0.4, 0.6])
    rows.loc[1, "average_precision_excluded"] = math.nan
    mean = mean_over_shapes(rows, "average_precision_excluded")
    assert (mean.value, mean.n, mean.n_failed) == (pytest.approx(20.0), 1, 0)


def test_the_same_id_in_two_categories_is_two_shapes():
    rows = shape_frame(shape_rows("fps", [1.0]), shape_rows("fps", [0.0], category="table"))
    assert mean_over_shapes(rows, "correct").value == 50.0


def test_categories_weigh_the_same_whatever_their_size():
    values = {"chair": [[1.0, 0.5, 0.6], [0.2, 0.4, math.nan]], "mug": [[0.1], [0.3]]}
    rows = shape_frame(
        *(
            shape_rows("ms3d", of_training, seed=seed, category=category)
            for category, trainings_ in values.items()
            for seed, of_training in enumerate(trainings_)
        )
    )
    mean = mean_over_categories(rows, "correct")
    of_trainings = [100 * ((1.0 + 0.5) / 2 + 0.1) / 2, 100 * ((0.2 + 0.4) / 2 + 0.3) / 2]
    assert mean.value == pytest.approx(sum(of_trainings) / 2)
    assert mean.std == pytest.approx(statistics.stdev(of_trainings))
    assert (mean.n, mean.n_failed) == (3, 1)
    shuffled = mean_over_categories(rows.sample(frac=1, random_state=0), "correct")
    assert (shuffled.value, shuffled.std) == (mean.value, mean.std)


def test_a_category_without_a_value_leaves_no_mean_over_categories():
    rows = shape_frame(shape_rows("ms3d", [1.0]), shape_rows("ms3d", [math.nan], category="mug"))
    assert math.isnan(mean_over_categories(rows, "correct").value)


def test_deviation_over_draws_is_pooled_over_trainings():
    draws = draw_frame(draw_rows("ms3d", [0.1, 0.3]), draw_rows("ms3d", [0.5, 0.6, 0.7], seed=1))
    expected = 100 * math.sqrt((statistics.variance([0.1, 0.3]) + statistics.variance([0.5, 0.6, 0.7])) / 2)
    assert deviation_over_draws(draws, "oa") == pytest.approx(expected)
    assert deviation_over_draws(draws, "map_excluded") == pytest.approx(expected / 2)
    assert math.isnan(deviation_over_draws(draw_frame(draw_rows("ms3d", [0.1])), "oa"))
    assert math.isnan(deviation_over_draws(draw_frame(), "oa"))


def test_the_interval_is_that_of_the_means_over_trainings():
    values = np.random.default_rng(0).random((2, 20))
    values[1, 4] = math.nan
    low_to_high = mean_interval(
        np.delete(values.mean(axis=0), 4), derive_generator(0, "interval over shapes", "oa", "ms3d")
    )
    expected = 50 * (low_to_high.high - low_to_high.low)
    rows = trainings(*values)
    assert interval_half_width(rows, "correct", "oa", "ms3d") == pytest.approx(expected)
    assert interval_half_width(rows[::-1], "correct", "oa", "ms3d") == pytest.approx(expected, rel=1e-12)
    assert interval_half_width(rows, "correct", "oa", "fps") != pytest.approx(expected, rel=1e-6)


def test_the_interval_is_about_two_standard_errors():
    values = np.random.default_rng(3).integers(0, 2, 26)
    error = 100 * values.std() / math.sqrt(26)
    assert interval_half_width(trainings(values), "correct", "x") == pytest.approx(1.96 * error, rel=0.12)


def test_one_shape_has_no_interval():
    assert math.isnan(interval_half_width(trainings([1.0, math.nan]), "correct", "oa"))


def test_differences_are_over_the_shapes_of_both():
    first, second = trainings([1.0, 0.5, math.nan, 1.0]), trainings([0.0, 0.5, 1.0], sampler="skeleton_aware")
    cells = subtract(first, second, "correct", "x")
    assert cells["oa_difference"].value == pytest.approx(50.0)
    assert {(cell.n, cell.n_failed) for cell in cells.values()} == {(2, 1)}
    assert cells["oa_difference_low"].value == 0.0
    assert cells["oa_difference_high"].value == 100.0


def test_a_row_minus_itself_is_exactly_nothing():
    rows = trainings(np.random.default_rng(0).random(10))
    assert {cell.value for cell in subtract(rows, rows, "correct", "x").values()} == {0.0}


def test_differences_are_named_after_their_metric():
    rows = trainings([1.0, 0.5]), trainings([0.0, 0.5])
    names = ["miou_difference", "miou_difference_low", "miou_difference_high"]
    assert list(subtract(*rows, "correct", "x", metric="miou")) == names
    assert list(subtract(*rows, "correct", "x", metric="miou").values()) == list(
        subtract(*rows, "correct", "x").values()
    )


def test_pairs_are_tighter_than_their_parts():
    rng = np.random.default_rng(0)
    values = rng.random(26)
    rows = trainings(values), trainings(values * 0.9)
    cells = subtract(*rows, "correct", "x")
    width = cells["oa_difference_high"].value - cells["oa_difference_low"].value
    assert width < 0.3 * interval_half_width(rows[0], "correct", "x")


def test_differences_without_a_common_shape_are_failed():
    cells = subtract(trainings([math.nan]), trainings([1.0]), "correct", "x")
    assert all(math.isnan(cell.value) for cell in cells.values())
    assert (cells["oa_difference"].n, cells["oa_difference"].n_failed) == (0, 1)


def test_p_value_by_hand():
    """Six shapes differ, five of them in favour of the first: 2 (1 + 6) / 2^6."""
    first, second = [1, 1, 1, 1, 1, 0, 1, 0], [0, 0, 0, 0, 0, 1, 1, 0]
    test = equality_test(trainings(first), trainings(second))
    assert test.value == pytest.approx(2 * 7 / 64)
    assert test.n == 8


def test_several_trainings_and_no_common_shape_have_no_p_value():
    assert equality_test(trainings([1.0], [1.0]), trainings([0.0])) is None
    assert equality_test(trainings([math.nan]), trainings([0.0])) is None


def test_shares_of_draws_have_no_p_value():
    with pytest.raises(InputError, match=r"shape b \(category chair\): expected correct to be 0 or 1"):
        equality_test(trainings([1.0, 1.0]), trainings([1.0, 0.4]))
