import math

import pytest
from sampled import draw_frame, draw_rows, shape_frame, shape_rows

from morphoskel.errors import InputError
from morphoskel.reporting.sampling_rows import check_draw_rows, check_shape_rows


def test_complete_rows_pass():
    check_shape_rows(shape_frame(shape_rows("ms3d", [0.5, math.nan]), shape_rows("ms3d", [1.0, 0.0], seed=1)))
    check_shape_rows(shape_frame(shape_rows("fps", [1.0], average_precision_excluded=math.nan)))
    check_draw_rows(draw_frame(draw_rows("ms3d", [0.5, 1.0]), draw_rows("random", [math.nan])))
    check_shape_rows(shape_frame())
    check_draw_rows(draw_frame())


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (
            shape_rows("pointnet", [1.0]),
            r"shape a \(sampler pointnet, ratio 8, .*unknown sampler; known are all_points",
        ),
        (shape_rows("fps", [1.0], choice="best"), "unknown choice; known are fixed, drawn"),
        (shape_rows("fps", [1.0], classifier="b"), "unknown classifier; known are dropout, plain"),
        (shape_rows("fps", [1.0], ratio="0"), "expected a whole number of at least 1 as ratio"),
        (shape_rows("fps", [1.0], ratio="8.0"), "expected a whole number of at least 1 as ratio"),
        (shape_rows("fps", [1.0], seed=-1), "expected a whole number of at least 0 as seed"),
        (shape_rows("fps", [1.0], id=None), "id and category must not be empty"),
        (shape_rows("fps", [1.0], status="done"), "expected the status ok or failed"),
        (shape_rows("fps", [89.1]), r"status is ok, but correct is not in \[0, 1\]"),
        (shape_rows("fps", [1.0], average_precision=math.nan), "but average_precision is not in"),
        (shape_rows("fps", [1.0], average_precision_excluded=1.1), "average_precision_excluded is neither"),
        (shape_rows("fps", [1.0], distinct=0), "number of distinct points is not at least 1"),
        (shape_rows("fps", [1.0], status="failed"), "the status is failed, but there are numbers"),
        (shape_rows("fps", [1.0, 1.0], id="a"), "a second row; expected one a shape and setting"),
        (
            [*shape_rows("ms3d", [1.0, 0.5]), *shape_rows("ms3d", [1.0], seed=1)],
            r"shape b \(.*not every training has this shape",
        ),
    ],
)
def test_illegal_shapes_are_named(rows, message):
    with pytest.raises(InputError, match=message):
        check_shape_rows(shape_frame(rows))


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (draw_rows("fps", [1.5]), r"draw 0 \(sampler fps, .*oa is neither in \[0, 1\] nor empty"),
        (draw_rows("fps", [0.5]) * 2, "a second row; expected one a draw and setting"),
        (draw_rows("mine", [0.5]), "unknown sampler"),
    ],
)
def test_illegal_draws_are_named(rows, message):
    with pytest.raises(InputError, match=message):
        check_draw_rows(draw_frame(rows))


def test_missing_columns_are_named():
    with pytest.raises(InputError, match="per-shape rows: the columns distinct are missing"):
        check_shape_rows(shape_frame().drop(columns="distinct"))
    with pytest.raises(InputError, match="per-draw rows: the columns oa, map are missing"):
        check_draw_rows(draw_frame().drop(columns=["oa", "map"]))
