import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.metrics import METRICS, find_metric


def test_headings_tell_unit_and_direction():
    assert find_metric("cd_recon").heading == "CD-Recon (lower is better)"
    assert find_metric("oa").heading == "Overall accuracy (%, higher is better)"
    assert find_metric("seconds").heading == "Time a shape (seconds)"


def test_decimals_are_those_of_the_paper():
    assert [METRICS[name].decimals for name in ("hd_mat", "seconds", "map")] == [4, 2, 1]


def test_an_unknown_metric_is_named_with_the_known_ones():
    with pytest.raises(InputError, match=r"no metric 'chamfer'; known are cd_recon, "):
        find_metric("chamfer")


def test_parts_belong_to_metrics_that_have_a_table_and_hold_one_number():
    parts = [metric for metric in METRICS.values() if metric.part_of]
    assert {part.name for part in parts} == {
        "oa_interval", "oa_difference_low", "oa_difference_high", "map_interval",
        "miou_interval", "miou_difference_low", "miou_difference_high",
    }  # fmt: skip
    for part in parts:
        assert not METRICS[part.part_of].part_of
        assert part.form.format("1.0").count("1.0") == 1


def test_what_describes_a_sample_is_not_contested():
    assert [METRICS[name].better for name in ("distinct_points", "oa_draws", "mcnemar_p", "labels")] == [None] * 4
    assert METRICS["map_excluded"].better == "higher"
