import math

import pandas as pd
import pytest
from small_run import result_frame

from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.page.summary import NOTHING, compare, summarise


def table(metric, group, **methods):
    """Rows with a value a method, NaN for one that was not run; the paper prints nothing."""
    rows = [(name.replace("__", ", ").replace("_", " "), group, metric, value, math.nan, 0 if math.isnan(value) else 9)
            for name, value in methods.items()]  # fmt: skip
    return pd.DataFrame(rows, columns=["method", "group", "metric", "value", "paper", "n"])


def test_one_sentence_from_all_tables():
    frame = result_frame()
    segmentation = table("miou", MEAN_OVER_SHAPES, MS3D__ratio_32=70.0, FPS__ratio_32=70.04, Random__ratio_16=99.0)
    text = summarise(
        {"skeleton_reconstruction": frame, "object_classification": frame, "part_segmentation": segmentation}
    )
    assert text.replace("\N{NO-BREAK SPACE}", " ") == (
        "The balls of MS3D have a mean CD-Recon of 0.0200 over 3 shapes (paper: 0.0274), worse than DPC, the best "
        "other skeleton method, with 0.0110; from one point in 8, chosen by MS3D, a classifier recognises 90.2 % of 4 "
        "shapes (paper: 91.0 %), better than FPS, the best other sampler, with 85.0 %; taught with one label in 32, "
        "placed by MS3D, part segmentation has a mean IoU of 70.0 % over 9 shapes, as good as FPS, the best other "
        "sampler, with 70.0 %."
    )


@pytest.mark.parametrize(("ours", "verdict"), [(0.1, "better than"), (0.3, "worse than"), (0.20001, "as good as")])
def test_the_verdict_is_of_the_values_as_shown_and_lower_is_better(ours, verdict):
    found = compare(table("cd_recon", "x", MS3D=ours, DPC=0.2, L1=0.9), "cd_recon", "x")
    assert (found.method, found.verdict) == ("DPC", verdict)


def test_variants_of_ms3d_and_rows_under_other_conditions_are_no_rivals():
    frame = table("cd_recon", "x", MS3D=0.5, MS3D_coverage=0.1, MS3D__PoNQ=0.1, DPC__100_balls=0.1, L1__Poisson=0.7)
    found = compare(frame, "cd_recon", "x")
    assert (found.ours, found.method) == (0.5, "L1, Poisson")
    assert "worse than L1 (Poisson)" not in found.told("", "method")
    assert "better than L1 (Poisson)" in found.told("", "method")
    assert compare(frame, "cd_recon", "x", ", 100 balls") is None


@pytest.mark.parametrize(
    ("values", "told"),
    [
        (
            {"MS3D_coverage": 0.1, "MS3D_coverage__repaired_Poisson": 0.05},
            "MS3D coverage (repaired Poisson), has 0.0500.",
        ),
        ({"MS3D_coverage": 0.1, "MS3D_coverage__100_balls": 0.05}, "MS3D coverage, has 0.1000."),
        ({"MS3D_coverage": 0.4}, None),
        ({}, None),
    ],
)
def test_our_own_selection_is_told_where_it_is_the_best(values, told):
    frame = table("cd_recon", MEAN_OVER_SHAPES, MS3D=0.5, DPC=0.3, **values)
    text = summarise({"skeleton_reconstruction": frame}).replace("\N{NO-BREAK SPACE}", " ")
    assert "our own selection" not in text if told is None else text.endswith(f"our own selection of its balls, {told}")


def test_the_largest_ratio_at_which_there_is_something_to_compare():
    frame = pd.concat([table("oa", "8", MS3D=9.0, FPS=8.0), table("oa", "16", MS3D=7.0, FPS=6.0),
                       table("oa", "32", MS3D=math.nan, FPS=5.0)])  # fmt: skip
    assert "one point in 16," in summarise({"object_classification": frame})


@pytest.mark.parametrize(
    "frames",
    [
        {},
        {"skeleton_reconstruction": table("cd_recon", MEAN_OVER_SHAPES, MS3D=0.1, DPC=math.nan)},
        {"object_classification": table("oa", "16", MS3D=math.nan)},
    ],
)
def test_a_run_that_compares_nothing_says_so(frames):
    assert summarise(frames) == NOTHING
