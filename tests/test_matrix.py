import math

import pandas as pd
import pytest

from morphoskel.evaluation.averages import AVERAGES
from morphoskel.reporting.matrix import WIDEST, cell_text, metric_matrices, rivals
from morphoskel.reporting.metrics import find_metric
from morphoskel.reporting.table import COLUMNS


def frame_of(*rows):
    """Rows of (method, group, metric, value, paper, n, n failed)."""
    return pd.DataFrame(
        [
            ("set", method, group, metric, value, math.nan, paper, n, n_failed, "0", "correct")
            for method, group, metric, value, paper, n, n_failed in rows
        ],
        columns=list(COLUMNS),
    )


def line(block, label):
    return next(line for line in block.lines if line.label == label)


def test_cells_not_printed_not_run_and_failed_differ():
    (matrix,) = metric_matrices(
        frame_of(
            ("A", "Mug", "oa", math.nan, 50.0, 0, 0),
            ("B", "Mug", "oa", 60.0, math.nan, 3, 0),
            ("B", "Cup", "oa", math.nan, 70.0, 0, 2),
        )
    )
    first, second = matrix.blocks
    assert matrix.groups == ("Mug", "Cup")
    assert [(row.label, row.cells) for row in first.lines] == [("paper", ("50.0", None)), ("ours", ("not run", None))]
    assert [(row.label, row.cells) for row in second.lines] == [
        ("paper", (None, "70.0")),
        ("ours", ("60.0", "failed")),
    ]


@pytest.mark.parametrize(("metric", "best"), [("cd_recon", [True, False]), ("oa", [False, True])])
def test_the_best_of_ours_depends_on_the_direction(metric, best):
    (matrix,) = metric_matrices(
        frame_of(("A", "Mug", metric, 0.1, math.nan, 1, 0), ("B", "Mug", metric, 0.2, 0.01, 1, 0))
    )
    assert [line(block, "ours").best[0] for block in matrix.blocks] == best
    assert line(matrix.blocks[1], "paper").best == (False,)


def test_values_that_look_equal_are_both_best():
    rows = [(method, "Mug", "cd_recon", value, math.nan, 1, 0) for method, value in (("A", 0.10001), ("B", 0.10002))]
    (matrix,) = metric_matrices(frame_of(*rows))
    assert [line(block, "ours").best for block in matrix.blocks] == [(True,), (True,)]


def test_a_value_without_rival_is_not_best():
    (matrix,) = metric_matrices(
        frame_of(("A", "Mug", "cd_recon", 0.1, math.nan, 1, 0), ("B", "Mug", "cd_recon", math.nan, 0.2, 0, 0))
    )
    assert not any(row.best[0] for block in matrix.blocks for row in block.lines)


def test_stages_are_no_rivals():
    (matrix,) = metric_matrices(
        frame_of(("A", "Mug", "seconds", 0.1, math.nan, 1, 0), ("B", "Mug", "seconds", 0.2, math.nan, 1, 0))
    )
    assert not any(line(block, "ours").best[0] for block in matrix.blocks)


@pytest.mark.parametrize(
    ("value", "paper", "text"), [(0.1234, 0.1, "+0.0234"), (0.1, 0.1234, "-0.0234"), (0.1, 0.10001, "0.0000")]
)
def test_differences_have_a_sign_unless_they_round_to_zero(value, paper, text):
    (matrix,) = metric_matrices(frame_of(("A", "Mug", "cd_recon", value, paper, 1, 0)))
    assert line(matrix.blocks[0], "difference").cells == (text,)


def test_metrics_come_in_the_order_of_the_registry():
    rows = [("A", "Mug", metric, 1.0, math.nan, 1, 0) for metric in ("oa", "hd_recon", "cd_recon")]
    assert [matrix.metric.name for matrix in metric_matrices(frame_of(*rows))] == ["cd_recon", "hd_recon", "oa"]


def test_decimals_of_the_metric():
    assert [cell_text(1.23456, 1, 0, find_metric(name)) for name in ("cd_recon", "seconds", "oa")] == [
        "1.2346",
        "1.23",
        "1.2",
    ]


@pytest.mark.parametrize(("value", "text"), [(0.0, "0.0000"), (1e-9, "< 0.0001"), (4e-5, "< 0.0001"), (6e-5, "0.0001")])
def test_a_probability_above_0_is_never_shown_as_0(value, text):
    assert cell_text(value, 5, 0, find_metric("mcnemar_p")) == text
    assert cell_text(1e-9, 5, 0, find_metric("cd_recon")) == "0.0000"


def test_only_rows_with_equally_many_balls_are_rivals():
    rows = [("A", 0.3), ("B", 0.2), ("A, 100 balls", 0.5), ("B, 100 balls", 0.4), ("B, 1024 balls", 0.1)]
    (matrix,) = metric_matrices(frame_of(*((name, "Mug", "cd_recon", value, math.nan, 1, 0) for name, value in rows)))
    assert [line(block, "ours").best[0] for block in matrix.blocks] == [False, True, False, True, False]


def test_rows_under_another_classifier_are_no_rivals():
    assert rivals("FPS, classifier without point dropout") != rivals("FPS")
    assert rivals("MS3D, arg-max") == rivals("MS3D") == ""
    rows = [("A", 60.0), ("B", 50.0)] + [(f"{name}, classifier without point dropout", 40.0) for name in "AB"]
    (matrix,) = metric_matrices(frame_of(*((name, "8", "oa", value, math.nan, 1, 0) for name, value in rows)))
    assert [line(block, "ours").best[0] for block in matrix.blocks] == [True, False, True, True]


def test_only_rows_with_equally_many_labels_are_rivals():
    rows = [("A", 0.9), ("B, ratio 16", 0.6), ("C, ratio 16", 0.7), ("B, ratio 32", 0.5), ("C, ratio 32", 0.4)]
    (matrix,) = metric_matrices(frame_of(*((name, "Mug", "miou", value, math.nan, 1, 0) for name, value in rows)))
    assert [line(block, "ours").best[0] for block in matrix.blocks] == [False, False, True, True, False]


def test_ratios_are_sorted_by_size():
    rows = [("A", "64"), ("A", "8"), ("B", "16"), ("B", "8")]
    (matrix,) = metric_matrices(frame_of(*((name, group, "oa", 1.0, math.nan, 1, 0) for name, group in rows)))
    assert matrix.groups == ("8", "16", "64")


def test_companions_stand_behind_the_value_and_do_not_change_which_is_best():
    (matrix,) = metric_matrices(
        frame_of(
            ("A", "8", "oa", 60.0, 50.0, 1, 0),
            ("B", "8", "oa", 50.0, math.nan, 1, 0),
            ("A", "8", "oa_interval", 1.23, math.nan, 1, 0),
            ("A", "16", "oa", math.nan, math.nan, 0, 1),
        )
    )
    first, second = matrix.blocks
    assert line(first, "ours").cells == ("60.0 ± 1.2", "failed")
    assert line(first, "ours").best == (True, False)
    assert line(first, "paper").cells == ("50.0", None)
    assert line(first, "difference").cells == ("+10.0", None)
    assert line(second, "ours").cells == ("50.0", None)
    assert matrix.heading == "Overall accuracy (%, higher is better), ± half-width of the 95 % interval over shapes"


def test_two_companions_are_written_one_after_the_other():
    rows = [("oa_difference", 0.4), ("oa_difference_high", 1.0), ("oa_difference_low", -0.2)]
    (matrix,) = metric_matrices(frame_of(*(("A minus B", "8", name, value, math.nan, 1, 0) for name, value in rows)))
    assert line(matrix.blocks[0], "ours").cells == ("0.4 (-0.2 to 1.0)",)
    assert matrix.heading == "Difference of overall accuracies (points of %), 95 % interval over shapes"


def wide(count):
    """A table of so many categories and the two averages, one of them with an interval."""
    groups = [f"c{number}" for number in range(count)] + list(AVERAGES)
    values = [(group, float(number)) for number, group in enumerate(groups)]
    rows = [(method, group, "miou", value, math.nan, 1, 0) for method in "AB" for group, value in values]
    return frame_of(*rows, ("A", AVERAGES[1], "miou_interval", 0.5, math.nan, 1, 0))


def test_a_table_that_fits_on_a_page_stays_whole():
    (matrix,) = metric_matrices(wide(WIDEST - 2))
    assert len(matrix.groups) == WIDEST
    assert matrix.heading == find_metric("miou").heading + ", ± half-width of the 95 % interval over shapes"


@pytest.mark.parametrize(("count", "widths"), [(WIDEST - 1, [2, 11]), (16, [2, 8, 8]), (25, [2, 9, 9, 7])])
def test_a_wide_table_is_split_with_the_averages_first(count, widths):
    matrices = metric_matrices(wide(count))
    assert [len(matrix.groups) for matrix in matrices] == widths
    averages, *others = matrices
    assert averages.groups == AVERAGES
    assert [group for matrix in others for group in matrix.groups] == [f"c{number}" for number in range(count)]
    assert all(matrix.blocks[1].lines[0].cells[-1] == f"{int(matrix.groups[-1][1:])}.0" for matrix in others)
    assert line(averages.blocks[0], "ours").cells[1].endswith(" ± 0.5")
    title = find_metric("miou").heading
    assert averages.heading == f"{title}: averages, ± half-width of the 95 % interval over shapes"
    assert others[0].heading == f"{title}: c0 to c{widths[1] - 1}"
