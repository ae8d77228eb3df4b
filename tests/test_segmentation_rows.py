import math

import pytest
from segmented import segmentation_frame, segmentation_rows

from morphoskel.errors import InputError
from morphoskel.reporting.segmentation_rows import check_segmentation_rows


def test_legal_rows_pass():
    check_segmentation_rows(segmentation_frame())
    parts = [segmentation_rows("ms3d", [0.5, math.nan], seed=seed, labels=9.0 + seed) for seed in (0, 1)]
    check_segmentation_rows(segmentation_frame(*parts, segmentation_rows("full", [0.0, 1.0], ratio="1")))


def test_the_same_id_in_two_categories_is_two_shapes():
    check_segmentation_rows(segmentation_frame(*(segmentation_rows("fps", [0.5], category=name) for name in "XY")))


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"strategy": "all_points"}, "unknown strategy; known are full, random"),
        ({"ratio": "0"}, "whole number of at least 1 as ratio"),
        ({"seed": -1}, "whole number of at least 0 as seed"),
        ({"category": None}, "must not be empty"),
        ({"category": "Mean over shapes"}, "the name of an average"),
        ({"status": "fine"}, "expected the status ok or failed"),
        ({"iou": 50.0}, r"iou is not in \[0, 1\]"),
        ({"accuracy": math.nan}, r"accuracy is not in \[0, 1\]"),
        ({"status": "failed"}, "failed, but there are numbers"),
        ({"labels": math.nan}, "number of labels is not at least 1"),
    ],
)
def test_illegal_rows_are_named(change, problem):
    frame = segmentation_frame([{**segmentation_rows("fps", [0.5])[0], **change}])
    with pytest.raises(InputError, match=problem) as caught:
        check_segmentation_rows(frame)
    assert str(caught.value).startswith("shape a (strategy ")


def test_rows_must_appear_once_for_every_training():
    row = segmentation_rows("fps", [0.5])
    with pytest.raises(InputError, match="a second row"):
        check_segmentation_rows(segmentation_frame(row, row))
    with pytest.raises(InputError, match=r"shape b .*not every training has this shape"):
        check_segmentation_rows(segmentation_frame(row, segmentation_rows("fps", [0.5, 0.5], seed=1)))


def test_a_training_has_one_number_of_labels():
    rows = segmentation_rows("fps", [0.5, 0.5])
    rows[1]["labels"] = 11.0
    with pytest.raises(InputError, match=r"shape a \(strategy fps, ratio 16, seed 0\): .*another number of labels"):
        check_segmentation_rows(segmentation_frame(rows))


def test_missing_columns_are_named():
    with pytest.raises(InputError, match="the columns iou, labels are missing"):
        check_segmentation_rows(segmentation_frame().drop(columns=["iou", "labels"]))
