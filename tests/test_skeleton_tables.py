import math
from pathlib import Path

import pandas as pd
import pytest

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES, MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES
from morphoskel.reporting.shape_values import AXIS_COLUMNS
from morphoskel.reporting.skeleton_tables import SHAPE_COLUMNS, skeleton_reconstruction, surface_reconstruction
from morphoskel.reporting.table import write_table

FOLDER = Path(__file__).resolve().parents[1] / "config" / "paper"
CATEGORIES = ["Airplane", "Chair", "Table", "Lamp", "Guitar", "Earphone", "Mug", "Rifle"]


def row(shape, category, surface="poisson", method="ms3d", total=1.0, balls="as is", **more):
    """A shape of 10 points and 5 spheres whose distances sum up to `total` each way."""
    values = (shape, category, surface, method, balls, "ok", "", 10, 5, total, 0.4, total, 0.3)
    return dict(zip(SHAPE_COLUMNS, values, strict=True)) | more


def failed(shape, category, surface="poisson", method="ms3d"):
    nothing = [math.nan] * 6
    values = (shape, category, surface, method, "as is", "failed", "no inside\nmore", *nothing)
    return dict(zip(SHAPE_COLUMNS, values, strict=True))


def with_axis(total, **of_row):
    """A row that also has distances to 10 axis points, which sum up to `total` each way."""
    distances = dict(zip(AXIS_COLUMNS, (10, 5, total, 0.6, total, 0.5), strict=True))
    return row(**of_row) | distances


def build(table, *rows, protocol="correct", **options):
    frame = pd.DataFrame(rows, columns=None if rows else list(SHAPE_COLUMNS))
    return table(frame, FOLDER, dataset="synthetic", seeds=[7], protocol=protocol, **options)


def cell(result, method, group, metric):
    frame = result.frame
    return frame[(frame["method"] == method) & (frame["group"] == group) & (frame["metric"] == metric)].iloc[0]


def all_categories():
    return [row(f"{category}-{number}", category) for category in CATEGORIES for number in (1, 2)]


def test_by_hand_under_both_protocols():
    rows = [row("a", "Chair", total=1.0), row("b", "Chair", total=2.0)]
    correct = build(skeleton_reconstruction, *rows)
    assert cell(correct, "MS3D", "Chair", "cd_recon")["value"] == pytest.approx(1.5 * (1 / 10 + 1 / 5))
    assert cell(correct, "MS3D", "Chair", "cd_recon_points")["value"] == pytest.approx(1.5 / 10)
    assert cell(correct, "MS3D", "Chair", "cd_recon_spheres")["value"] == pytest.approx(1.5 / 5)
    assert cell(correct, "MS3D", "Chair", "hd_recon")["value"] == pytest.approx(0.4)
    assert cell(correct, "MS3D", "Chair", "cd_recon")["paper"] == 0.0296
    released = build(skeleton_reconstruction, *rows, protocol="released")
    assert cell(released, "MS3D", "Chair", "cd_recon")["value"] == pytest.approx(3.0 * (1 / 10 + 1 / 10) / 3)
    assert cell(released, "MS3D", "Chair", "hd_recon")["value"] == pytest.approx(0.8 / 3)
    assert set(released.frame["protocol"]) == {"released"}


def test_ms3d_is_the_poisson_surface_in_one_table_and_every_surface_in_the_other():
    rows = [
        row("a", "Chair", total=1.0),
        row("a", "Chair", "ball_pivoting", total=2.0),
        row("a", "Chair", "", "l1_medial", total=3.0),
        row("a", "Chair", "cloud", "point2skeleton", total=4.0, balls="dense"),
    ]
    skeletons = build(skeleton_reconstruction, *rows)
    for method, total in (("MS3D", 1.0), ("L1", 3.0), ("P2S", 4.0)):
        assert cell(skeletons, method, "Chair", "cd_recon_points")["value"] == pytest.approx(total / 10)
    assert "BPA" not in set(skeletons.frame["method"])
    surfaces = build(surface_reconstruction, *rows)
    for method, total in (("Poisson", 1.0), ("BPA", 2.0), ("P2S", 4.0)):
        assert cell(surfaces, method, "Chair", "cd_recon_points")["value"] == pytest.approx(total / 10)
    assert math.isnan(cell(surfaces, "Alpha", "Chair", "cd_recon")["value"])
    assert "L1" not in set(surfaces.frame["method"])


@pytest.mark.parametrize("table", [skeleton_reconstruction, surface_reconstruction])
def test_every_printed_cell_appears_and_is_not_run(table, tmp_path):
    result = build(table)
    assert len(result.frame) == 4 * 4 * (8 + 2)
    assert result.frame["value"].isna().all()
    assert result.frame["paper"].notna().all()
    write_table(result.frame, tmp_path / "table", "Caption.", result.footnotes)
    assert (tmp_path / "table.csv").read_text().count(",not run,") == len(result.frame)


def test_each_method_has_a_row_for_its_own_balls_then_for_equal_counts():
    rows = [
        row("a", "Chair", "poisson", "ms3d_coverage", balls="100"),
        row("a", "Chair", "repaired_poisson", "ms3d_coverage", balls="1024"),
        row("a", "Chair", "repaired_poisson", "ms3d_coverage"),
        row("a", "Chair", "cloud", "point2skeleton", balls="dense"),
        row("a", "Chair", "cloud", "point2skeleton"),
    ]
    measured = build(skeleton_reconstruction, *rows).frame.query("n > 0")["method"]
    assert list(dict.fromkeys(measured)) == [
        "P2S",
        "MS3D coverage, repaired Poisson",
        "P2S, own balls",
        "MS3D coverage, 100 balls",
        "MS3D coverage, repaired Poisson, 1024 balls",
    ]
    assert "P2S, own balls" not in set(build(surface_reconstruction, *rows).frame["method"])


def test_computed_axes_never_stand_beside_the_papers():
    shape = with_axis(2.0, shape="a", category="Chair")
    computed = build(skeleton_reconstruction, shape)
    assert cell(computed, "MS3D", "Chair", "cd_mat_computed")["value"] == pytest.approx(2.0 * (1 / 10 + 1 / 5))
    assert cell(computed, "MS3D", "Chair", "hd_mat_computed")["value"] == pytest.approx(0.6)
    assert math.isnan(cell(computed, "MS3D", "Chair", "cd_mat_computed")["paper"])
    assert computed.frame.loc[computed.frame["metric"].isin(["cd_mat", "hd_mat"]), "n"].eq(0).all()
    assert any(note.startswith("MAT*") for note in computed.footnotes)
    given = build(skeleton_reconstruction, shape, axis="given")
    assert cell(given, "MS3D", "Chair", "cd_mat")["value"] == pytest.approx(2.0 * (1 / 10 + 1 / 5))
    assert not given.frame["metric"].str.endswith("_computed").any()


def test_a_shape_without_an_axis_counts_as_failed_for_these_metrics_alone():
    result = build(skeleton_reconstruction, with_axis(2.0, shape="a", category="Chair"), row("b", "Chair"))
    assert cell(result, "MS3D", "Chair", "cd_recon")["n"] == 2
    assert tuple(cell(result, "MS3D", "Chair", "cd_mat_computed")[["n", "n_failed"]]) == (1, 1)


def test_the_time_a_shape_is_a_metric_of_the_methods_own_balls():
    rows = [row("a", "Chair", seconds=2.0), row("b", "Chair", seconds=4.0), row("a", "Chair", balls="100")]
    result = build(skeleton_reconstruction, *rows)
    assert cell(result, "MS3D", "Chair", "seconds")["value"] == pytest.approx(3.0)
    assert set(result.frame.query("metric == 'seconds'")["method"]) == {"MS3D"}


def test_averages_of_the_paper_stand_beside_ours_over_its_eight_categories():
    result = build(skeleton_reconstruction, *all_categories())
    both = [cell(result, "MS3D", group, "cd_recon") for group in AVERAGES]
    assert [average["paper"] for average in both] == pytest.approx([0.026075, 0.0274])
    assert [average["n"] for average in both] == [16, 16]
    assert any("in another proportion" in note for note in result.footnotes)


def test_averages_of_the_paper_are_withheld_over_other_categories():
    result = build(skeleton_reconstruction, *all_categories(), row("t", "Torus"))
    averages = result.frame[result.frame["group"].isin(AVERAGES)]
    assert averages["paper"].isna().all()
    assert {"L1", "DPC", "P2S", "MS3D"} == set(averages["method"])
    assert any("averages are over Airplane, Chair" in note for note in result.footnotes)
    assert cell(result, "MS3D", "Chair", "cd_recon")["paper"] == 0.0296
    assert math.isnan(cell(result, "MS3D", "Torus", "cd_recon")["paper"])


def test_failed_shapes_are_counted_and_named():
    result = build(skeleton_reconstruction, *all_categories()[:2], failed("broken", "Airplane"), failed("c", "Chair"))
    airplane = cell(result, "MS3D", "Airplane", "cd_recon")
    assert (airplane["n"], airplane["n_failed"]) == (2, 1)
    chair = cell(result, "MS3D", "Chair", "cd_recon")
    assert math.isnan(chair["value"])
    assert (chair["n"], chair["n_failed"]) == (0, 1)
    shapes = cell(result, "MS3D", MEAN_OVER_SHAPES, "cd_recon")
    assert (shapes["value"], shapes["n_failed"]) == (pytest.approx(0.3), 2)
    assert math.isnan(cell(result, "MS3D", MEAN_OVER_CATEGORIES, "cd_recon")["value"])
    expected = "MS3D: 2 of 4 shapes failed and are left out of its means: broken (no inside); c (no inside)."
    assert expected in result.footnotes


def test_many_failures_are_not_all_named():
    result = build(skeleton_reconstruction, *(failed(f"s{number:02}", "Chair") for number in range(12)))
    (note,) = [note for note in result.footnotes if note.startswith("MS3D: 12 of 12")]
    assert note.endswith("s09 (no inside) and 2 more.")


def test_the_known_slips_are_footnotes():
    notes = build(skeleton_reconstruction).footnotes
    assert any("0.0993 in the supplement" in note for note in notes)
    assert any("implies about 0.280" in note for note in build(surface_reconstruction).footnotes)


def test_the_order_of_the_shapes_does_not_change_a_byte(tmp_path):
    rows = [row(f"{category}-{n}", category, total=n / 7) for n in range(1, 9) for category in CATEGORIES]
    for name, ordered in (("first", rows), ("second", rows[:8] + rows[:7:-1])):
        result = build(skeleton_reconstruction, *ordered)
        write_table(result.frame, tmp_path / name, "Caption.", result.footnotes)
    for suffix in ("csv", "md", "tex"):
        assert (tmp_path / f"first.{suffix}").read_bytes() == (tmp_path / f"second.{suffix}").read_bytes()


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([row("a", "Chair"), row("a", "Chair")], "shape a: more than one row for MS3D"),
        ([{**row("a", "Chair"), "status": "done"}], "shape a, method ms3d, status done: expected the status"),
        ([{**row("a", "Chair"), "category": None}], "shape a, .*: id, category and method must not be empty"),
        ([row("a", "Chair", surface="")], "shape a, .*: MS3D works on a surface; name it"),
        ([{**row("a", "Chair"), "sphere_to_point_sum": math.nan}], "shape a, MS3D: status is ok, but sphere_to_point"),
        ([row("a", "Chair", balls="some")], "shape a, .*: expected balls to be"),
        ([{**row("a", "Chair"), "spheres": 0}], "shape a, MS3D: status is ok, but a count"),
    ],
)
def test_illegal_rows_are_named(rows, message):
    with pytest.raises(InputError, match=message):
        build(skeleton_reconstruction, *rows)


def test_missing_columns_are_named():
    with pytest.raises(InputError, match="the columns status, reason are missing"):
        surface_reconstruction(
            pd.DataFrame(columns=list(SHAPE_COLUMNS)).drop(columns=["status", "reason"]),
            FOLDER,
            dataset="synthetic",
            seeds=[],
            protocol="correct",
        )
