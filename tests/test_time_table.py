import math
from pathlib import Path

import pandas as pd
import pytest

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES
from morphoskel.reporting.table import write_table
from morphoskel.reporting.time_table import TIME_COLUMNS, processing_time
from morphoskel.stages import STAGES

FOLDER = Path(__file__).resolve().parents[1] / "config" / "paper"
CATEGORIES = ["Airplane", "Chair", "Table", "Lamp", "Guitar", "Earphone", "Mug", "Rifle"]


def times_of(shape, category, surface="poisson", seconds=(1, 2, 3, 4, 5, 6)):
    return [(shape, category, surface, stage, float(time)) for stage, time in zip(STAGES, seconds, strict=False)]


def build(*rows):
    return processing_time(pd.DataFrame(rows, columns=list(TIME_COLUMNS)), FOLDER, dataset="synthetic", seeds=[7])


def cell(result, method, group):
    frame = result.frame
    return frame[(frame["method"] == method) & (frame["group"] == group)].iloc[0]


def test_by_hand():
    result = build(*times_of("a", "Chair"), *times_of("b", "Chair", seconds=(3, 4, 5, 6, 7, 8)))
    expected = {"Poisson": 2, "Watertight": 3, "MS3D": 4 + 5 + 6 + 7, "MS3D: udf": 5, "MS3D: select_skeleton": 7}
    for method, seconds in expected.items():
        assert cell(result, method, "Chair")["value"] == pytest.approx(seconds)
        assert cell(result, method, MEAN_OVER_SHAPES)["n"] == 2
    assert cell(result, "MS3D", "Chair")["paper"] == 1.61
    assert math.isnan(cell(result, "MS3D: udf", "Chair")["paper"])
    assert set(result.frame["metric"]) == {"seconds"}


def test_other_surfaces_are_named():
    result = build(*times_of("a", "Chair"), *times_of("a", "Chair", "ball_pivoting", (9, 8, 1, 1, 1, 1)))
    for method, seconds in {"BPA": 9, "Watertight after BPA": 8, "MS3D after BPA": 4}.items():
        assert cell(result, method, "Chair")["value"] == seconds
        assert math.isnan(cell(result, method, "Chair")["paper"])


def test_a_shape_without_a_stage_is_counted_as_failed_there():
    result = build(*times_of("a", "Chair"), *times_of("b", "Chair", seconds=(1, 2, 3)))
    assert (cell(result, "Poisson", "Chair")["n"], cell(result, "Poisson", "Chair")["n_failed"]) == (2, 0)
    assert (cell(result, "MS3D", "Chair")["n"], cell(result, "MS3D", "Chair")["n_failed"]) == (1, 1)
    assert cell(result, "MS3D", "Chair")["value"] == 3 + 4 + 5 + 6
    assert any("without a time" in note and "MS3D 1 of 2" in note for note in result.footnotes)


def test_everything_printed_appears_and_is_not_run(tmp_path):
    result = build()
    assert len(result.frame) == 3 * (8 + 1)
    assert result.frame["value"].isna().all()
    write_table(result.frame, tmp_path / "table", "Caption.", result.footnotes)
    assert "| Watertight | paper | 1.20 | 1.70 |" in (tmp_path / "table.md").read_text(encoding="utf-8")


def test_the_misprint_is_a_footnote():
    assert any("590.40 s for 334 shapes makes 1.77" in note for note in build().footnotes)


def test_the_mean_over_shapes_of_the_paper_stands_beside_ours_over_its_categories():
    rows = [line for category in CATEGORIES for line in times_of(category, category)]
    result = build(*rows)
    assert cell(result, "MS3D", MEAN_OVER_SHAPES)["paper"] == pytest.approx(1976.04 / 1184)
    assert math.isnan(cell(result, "MS3D", MEAN_OVER_CATEGORIES)["paper"])
    result = build(*rows, *times_of("t", "Torus"))
    assert math.isnan(cell(result, "MS3D", MEAN_OVER_SHAPES)["paper"])


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([("a", "Chair", "poisson", "udf", -1.0)], "shape a, poisson, udf: expected a finite number of seconds"),
        ([("a", "Chair", "poisson", "udf", math.inf)], "expected a finite number of seconds"),
        ([("a", "Chair", "poisson", "ms3d", 1.0)], "unknown stage; expected one of reconstruct, watertight"),
        ([("a", "Chair", None, "udf", 1.0)], "id, category and surface must not be empty"),
        (times_of("a", "Chair") * 2, "shape a, poisson, reconstruct: a second time"),
    ],
)
def test_illegal_rows_are_named(rows, message):
    with pytest.raises(InputError, match=message):
        build(*rows)


def test_missing_columns_are_named():
    with pytest.raises(InputError, match="the columns seconds are missing"):
        processing_time(pd.DataFrame(columns=list(TIME_COLUMNS[:-1])), FOLDER, dataset="set", seeds=[])
