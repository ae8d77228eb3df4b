import math
import statistics

import numpy as np
import pytest
from conftest import REPOSITORY
from sampled import draw_frame, draw_rows, shape_frame, shape_rows

from morphoskel.errors import InputError
from morphoskel.reporting.sampling_names import SAMPLING_TABLES
from morphoskel.reporting.sampling_tables import build_sampling_table
from morphoskel.reporting.table import COLUMNS, write_table

FOLDER = REPOSITORY / "config" / "paper"
PRINTED = {"object_classification": 24, "point_cloud_retrieval": 20, "skeleton_prior": 16}


def build(name, shapes=(), draws=(), protocol="correct"):
    return build_sampling_table(
        name, shape_frame(*shapes), draw_frame(*draws), FOLDER, dataset="mine", protocol=protocol
    )


def find(result, method, metric, ratio="8"):
    frame = result.frame
    found = frame[(frame["method"] == method) & (frame["group"] == ratio) & (frame["metric"] == metric)]
    return found.iloc[0] if len(found) else None


@pytest.mark.parametrize("name", SAMPLING_TABLES)
def test_every_printed_cell_appears_and_is_not_run(name, tmp_path):
    result = build(name)
    assert tuple(result.frame.columns) == COLUMNS
    assert len(result.frame) == PRINTED[name]
    assert result.frame["paper"].notna().all()
    write_table(result.frame, tmp_path / "table", "Caption.", result.footnotes)
    assert (tmp_path / "table.csv").read_text().count(",not run,") == PRINTED[name]


def test_a_sampler_that_was_not_run_stands_beside_one_that_was(tmp_path):
    result = build("object_classification", [shape_rows("fps", [1.0, 0.0], choice="fixed")])
    write_table(result.frame, tmp_path / "table", "Caption.", result.footnotes)
    text = (tmp_path / "table.md").read_text(encoding="utf-8")
    assert (
        "| FPS | paper | 70.4 | 46.3 | 26.3 | 13.5 |\n|  | ours | 50.0 ± 50.0 | not run | not run | not run |" in text
    )
    assert "| S-NET | paper | 77.5 | 70.4 | 60.6 | 36.1 |\n|  | ours | not run | not run | not run | not run |" in text


def test_values_agree_with_loops():
    rng = np.random.default_rng(0)
    values = rng.integers(0, 11, (3, 15)) / 10
    shapes = [shape_rows("ms3d", of_training, ratio="64", seed=seed) for seed, of_training in enumerate(values)]
    draws = [draw_rows("ms3d", of_training[:4], ratio="64", seed=seed) for seed, of_training in enumerate(values)]
    result = build("object_classification", shapes, draws)
    total = 0.0
    for shape in range(15):
        total += sum(values[training][shape] for training in range(3)) / 3
    cell = find(result, "MS3D", "oa", "64")
    assert cell["value"] == pytest.approx(100 * total / 15)
    assert cell["std"] == pytest.approx(statistics.stdev([100 * sum(row) / 15 for row in values]))
    assert (cell["paper"], cell["n"], cell["n_failed"], cell["seeds"]) == (85.5, 15, 0, "0 1 2")
    pooled = math.sqrt(sum(statistics.variance(row[:4]) for row in values) / 3)
    assert find(result, "MS3D", "oa_draws", "64")["value"] == pytest.approx(100 * pooled)
    assert find(result, "MS3D", "distinct_points", "64")["value"] == 100.0
    assert 5 < find(result, "MS3D", "oa_interval", "64")["value"] < 20


def test_one_training_has_no_deviation_and_random_points_have_that_of_their_draws():
    shapes = [shape_rows("ms3d", [1.0, 0.5]), shape_rows("random", [1.0, 0.5])]
    draws = [draw_rows("ms3d", [0.5, 1.0]), draw_rows("random", [0.5, 1.0])]
    for name, metric in (("object_classification", "oa"), ("point_cloud_retrieval", "map")):
        result = build(name, shapes, draws)
        assert math.isnan(find(result, "MS3D", metric)["std"])
        assert find(result, "Random", metric)["std"] == pytest.approx(100 * statistics.stdev([0.5, 1.0]))


def test_failed_shapes_are_left_out_and_counted():
    result = build("object_classification", [shape_rows("ms3d", [1.0, math.nan, 0.0]), shape_rows("fps", [1.0] * 3)])
    cell = find(result, "MS3D", "oa")
    assert (cell["value"], cell["n"], cell["n_failed"]) == (50.0, 2, 1)
    assert any("MS3D: 1 of 3 shapes failed" in note and "b (no inside)" in note for note in result.footnotes)
    nothing = build("object_classification", [shape_rows("ms3d", [math.nan])])
    assert math.isnan(find(nothing, "MS3D", "oa")["value"])
    assert find(nothing, "MS3D", "oa")["n_failed"] == 1
    assert find(nothing, "MS3D", "oa_interval") is None


def test_retrieval_shows_the_query_left_out_unless_released():
    shapes = [shape_rows("skeleton_aware", [0.8, 0.6])]
    correct, released = (
        build("point_cloud_retrieval", shapes, protocol=protocol) for protocol in ("correct", "released")
    )
    for result in (correct, released):
        assert find(result, "SA", "map")["value"] == pytest.approx(70.0)
        assert find(result, "SA", "map")["paper"] == 72.2
    assert find(correct, "SA", "map_excluded")["value"] == pytest.approx(35.0)
    assert find(released, "SA", "map_excluded") is None
    assert set(correct.frame["metric"]) == {"map", "map_interval", "map_excluded"}


def test_the_protocol_does_not_change_an_accuracy():
    shapes = [shape_rows("ms3d", [1.0, 0.5, 0.0])]
    frames = [build("object_classification", shapes, protocol=name).frame for name in ("correct", "released")]
    assert frames[0].drop(columns="protocol").equals(frames[1].drop(columns="protocol"))


def test_rows_are_in_one_order_whatever_that_of_the_files():
    settings = [("ms3d", "argmax"), ("ms3d", "drawn"), ("lfs", "fixed"), ("uniform", "drawn"), ("random", "drawn")]
    shapes = [
        shape_rows(sampler, [1.0, 0.5], ratio=ratio, choice=choice, classifier=classifier)
        for classifier in ("plain", "dropout")
        for sampler, choice in settings
        for ratio in ("64", "8")
    ]
    result = build("object_classification", shapes)
    rows = result.frame[(result.frame["metric"] == "oa") & (result.frame["n"] > 0)]
    twins = [
        f"{name}, classifier without point dropout" for name in ("Random", "LFS-weighted FPS", "MS3D", "uniform prior")
    ]
    names = ["Random", "LFS-weighted FPS", "MS3D", "uniform prior", "MS3D, arg-max", *twins]
    assert list(dict.fromkeys(rows["method"])) == names
    assert list(rows["group"]) == ["8", "64"] * len(names)
    assert build("object_classification", shapes[::-1]).frame.equals(result.frame)


def test_all_points_are_a_metric_of_their_own():
    shapes = [
        shape_rows("all_points", [1.0, 0.5], ratio="1", choice="fixed"),
        shape_rows("all_points", [0.0, 0.5], ratio="1", choice="fixed", classifier="plain"),
    ]
    result = build("object_classification", shapes)
    assert find(result, "All points", "oa_all_points", "1")["value"] == 75.0
    assert find(result, "All points, classifier without point dropout", "oa_all_points", "1")["value"] == 25.0
    assert set(result.frame.loc[result.frame["metric"] == "oa", "group"]) == {"8", "16", "32", "64"}
    assert find(build("point_cloud_retrieval", shapes), "All points", "map_all_points", "1")["value"] == 75.0
    priors = build("skeleton_prior", shapes).frame
    assert list(priors.loc[priors["metric"] == "oa_all_points", "method"]) == ["All points"]


def test_differences_of_the_priors_stand_beside_the_papers():
    first, second = [1.0, 1.0, 1.0, 0.0, math.nan], [1.0, 0.0, 0.0, 0.0, 1.0]
    shapes = [
        shape_rows(sampler, values, choice=choice)
        for choice in ("drawn", "argmax")
        for sampler, values in (("ms3d", first), ("skeleton_aware", second))
    ]
    result = build("skeleton_prior", [*shapes, shape_rows("random", [0.0] * 5)])
    cell = find(result, "MS3D minus SA", "oa_difference")
    assert (cell["value"], cell["paper"]) == (pytest.approx(50.0), pytest.approx(0.4))
    assert (cell["n"], cell["n_failed"]) == (4, 1)
    ends = [find(result, "MS3D minus SA", f"oa_difference_{end}")["value"] for end in ("low", "high")]
    assert ends[0] < 50.0 < ends[1]
    assert find(result, "MS3D minus Random", "oa_difference")["value"] == pytest.approx(75.0)
    assert find(result, "MS3D minus SA, arg-max", "mcnemar_p")["value"] == pytest.approx(0.5)
    assert find(result, "MS3D minus SA", "mcnemar_p") is None
    assert find(result, "MS3D minus uniform prior", "oa_difference") is None


def test_several_trainings_have_differences_but_no_p_value():
    shapes = [
        shape_rows(sampler, values, choice="argmax", seed=seed)
        for seed in (0, 1)
        for sampler, values in (("ms3d", [1.0, 0.0]), ("skeleton_aware", [1.0, 1.0]))
    ]
    result = build("skeleton_prior", shapes)
    assert find(result, "MS3D minus SA, arg-max", "oa_difference")["value"] == pytest.approx(-50.0)
    assert "mcnemar_p" not in set(result.frame["metric"])


def test_what_belongs_to_another_table_is_left_aside():
    shapes = [shape_rows(sampler, [1.0, 0.5]) for sampler in ("dpc", "l1_medial", "random")]
    computed = {name: set(build(name, shapes).frame.query("n > 0")["method"]) for name in SAMPLING_TABLES}
    assert computed["object_classification"] == {"Random"}
    assert computed["skeleton_prior"] == {"Random", "DPC", "L1"}


def test_a_sampler_chooses_in_one_usual_way():
    shapes = [shape_rows("fps", [1.0], choice=choice) for choice in ("fixed", "drawn")]
    with pytest.raises(InputError, match="a second value for FPS, 8, oa"):
        build("object_classification", shapes)


def test_bad_rows_and_unknown_tables_are_refused():
    with pytest.raises(InputError, match="legal are object_classification"):
        build("segmentation")
    with pytest.raises(InputError, match="unknown sampler"):
        build("skeleton_prior", [shape_rows("pointnet", [1.0])])
    with pytest.raises(InputError, match="a second row"):
        build("skeleton_prior", draws=[draw_rows("ms3d", [1.0]) * 2])
