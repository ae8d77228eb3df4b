import math
import statistics

import pytest
from charts import entries, lines_of, page
from conftest import REPOSITORY
from PIL import Image
from sampled import draw_frame, draw_rows, shape_frame, shape_rows

from morphoskel.errors import InputError
from morphoskel.reporting.figure_page import TEXT_WIDTH
from morphoskel.reporting.figures.against_ratio import (
    HEIGHT,
    PANELS,
    TABLES,
    draw_against_ratio_from_files,
    plot_against_ratio,
    sampler_curves,
)
from morphoskel.reporting.figures.marks import mark_of
from morphoskel.reporting.sampling_names import SAMPLER_NAMES, row_name
from morphoskel.reporting.sampling_tables import build_sampling_table
from morphoskel.reporting.table import read_table, write_table
from morphoskel.sampling.choice import FIXED
from morphoskel.sampling.samplers import SAMPLERS

FOLDER = REPOSITORY / "config" / "paper"
RATIOS = ("8", "16", "32", "64")


def tables(folder, metric, shapes=(), draws=()):
    """Write the tables of a metric and return their CSV files."""
    paths = []
    for name in TABLES[metric]:
        table = build_sampling_table(
            name, shape_frame(*shapes), draw_frame(*draws), FOLDER, dataset="mine", protocol="correct"
        )
        write_table(table.frame, folder / name, "Caption.", table.footnotes)
        paths.append(folder / f"{name}.csv")
    return paths


def curves(folder, metric="oa", shapes=(), draws=(), cloud_points=512):
    frames = [read_table(path) for path in tables(folder, metric, shapes, draws)]
    return sampler_curves(metric, frames, draw_frame(*draws), cloud_points)


def everything():
    """Two draws of every sampler at every ratio, all of one quality, and all points."""
    shapes, draws = [], []
    for number, sampler in enumerate(SAMPLERS):
        choice = FIXED if sampler in ("fps", "lfs") else "drawn"
        for ratio in RATIOS:
            accuracy = 1 - (number + int(ratio)) / 100
            shapes.append(shape_rows(sampler, [accuracy, accuracy], ratio, choice=choice))
            draws.append(draw_rows(sampler, [accuracy, accuracy - 0.02][: 1 if choice == FIXED else 2], ratio,
                                   choice=choice))  # fmt: skip
    return [*shapes, shape_rows("all_points", [1.0, 0.9], "1", choice=FIXED)], draws


def test_every_sampler_has_a_panel_and_ms3d_is_in_all():
    assert {sampler for panel in PANELS.values() for sampler in panel} == set(SAMPLERS)
    assert all(panel[0] == "ms3d" for panel in PANELS.values())


def test_own_values_stand_at_own_numbers_of_points_and_published_ones_at_theirs(tmp_path):
    shapes = [shape_rows("fps", [1.0, 0.5], ratio, choice=FIXED) for ratio in ("8", "64")]
    fps = curves(tmp_path, shapes=shapes)["fps"]
    assert fps.measured[:, :2].tolist() == [[8, 75], [64, 75]]
    assert fps.published.tolist() == [[16, 13.5], [32, 26.3], [64, 46.3], [128, 70.4]]


def test_deviations_are_over_trainings_if_there_are_several(tmp_path):
    shapes = [shape_rows("ms3d", [value], seed=seed) for seed, value in enumerate((0.5, 0.7, 0.9))]
    draws = [draw_rows("ms3d", [0.1, 0.9], seed=seed) for seed in range(3)]
    (row,) = curves(tmp_path, shapes=shapes, draws=draws)["ms3d"].measured
    assert row == pytest.approx([64, 70, 100 * statistics.stdev([0.5, 0.7, 0.9])])


@pytest.mark.parametrize("metric", ["oa", "map"])
def test_deviations_are_over_draws_if_there_is_one_training(tmp_path, metric):
    shapes, draws = [shape_rows("ms3d", [0.5])], [draw_rows("ms3d", [0.2, 0.9, 0.4])]
    draws.append(draw_rows("ms3d", [0.0, 1.0], classifier="plain"))
    draws.append(draw_rows("ms3d", [0.0], choice="argmax"))
    (row,) = curves(tmp_path, metric, shapes, draws)["ms3d"].measured
    assert row[2] == pytest.approx(100 * statistics.stdev([0.2, 0.9, 0.4]))


def test_without_noise_there_is_no_deviation(tmp_path):
    shapes, draws = [shape_rows("fps", [0.5], choice=FIXED)], [draw_rows("fps", [0.5], choice=FIXED)]
    assert math.isnan(curves(tmp_path, shapes=shapes, draws=draws)["fps"].measured[0, 2])


def test_only_the_usual_choice_and_classifier_are_drawn(tmp_path):
    shapes = [shape_rows("ms3d", [0.5]), shape_rows("ms3d", [0.1], choice="argmax")]
    shapes.append(shape_rows("ms3d", [0.2], classifier="plain"))
    assert curves(tmp_path, shapes=shapes)["ms3d"].measured[:, 1].tolist() == [50]


def test_a_sampler_of_two_tables_is_drawn_once(tmp_path):
    assert len(curves(tmp_path, shapes=[shape_rows("ms3d", [0.5])])["ms3d"].measured) == 1


def test_retrieval_compares_no_other_skeletons(tmp_path):
    assert set(SAMPLERS) - set(curves(tmp_path, "map")) == {"dpc", "l1_medial"}
    assert set(curves(tmp_path, "oa")) == set(SAMPLERS)


def test_failures_are_told_from_what_was_not_run(tmp_path):
    found = curves(tmp_path, shapes=[shape_rows("dpc", [math.nan])])
    assert found["dpc"].entry == "DPC (failed)"
    assert found["snet"].entry == "S-NET (not run)"


def test_all_samplers_can_be_read_and_lie_where_they_should(tmp_path):
    shapes, draws = everything()
    found = curves(tmp_path, shapes=shapes, draws=draws, cloud_points=1024)
    with page(TEXT_WIDTH, HEIGHT) as figure:
        plot_against_ratio(figure, found, label="Overall accuracy (%)", all_points=95.0)
        for axes, samplers in zip(figure.axes, PANELS.values(), strict=True):
            for sampler in samplers:
                ((points, values),) = lines_of(axes, mark_of(sampler).colour)
                assert points == [16, 32, 64, 128]
                assert values == pytest.approx([100 - SAMPLERS.index(sampler) - int(ratio) for ratio in RATIOS[::-1]])
            assert axes.get_xlim() == figure.axes[0].get_xlim()
            assert axes.get_ylim() == figure.axes[0].get_ylim()
        assert set(entries(figure)) == {
            *(SAMPLER_NAMES[sampler] for sampler in SAMPLERS),
            *("this run", "± one standard deviation", "published", "all points of a cloud"),
        }


def test_a_run_of_nothing_shows_what_is_published_and_can_be_read(tmp_path):
    with page(TEXT_WIDTH, HEIGHT) as figure:
        plot_against_ratio(figure, curves(tmp_path), label="Overall accuracy (%)")
        words = entries(figure)
    assert "all points of a cloud" not in words
    assert all(f"{row_name(sampler, 'drawn', 'dropout')} (not run)" in words for sampler in SAMPLERS)


def test_shares_end_at_a_hundred(tmp_path):
    shapes, draws = [shape_rows("random", [1.0])], [draw_rows("random", [0.5, 1.0])]
    with page(TEXT_WIDTH, HEIGHT) as figure:
        plot_against_ratio(figure, curves(tmp_path, shapes=shapes, draws=draws), label="Overall accuracy (%)")
        assert figure.axes[0].get_ylim()[1] <= 101


@pytest.mark.parametrize("metric", ["oa", "map"])
def test_files_are_written_from_files(tmp_path, metric):
    shapes, draws = everything()
    paths = tables(tmp_path, metric, shapes, draws)
    draw_frame(*draws).to_csv(tmp_path / "draws.csv", index=False)
    figures = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_against_ratio_from_files(figures, paths, [tmp_path / "draws.csv"], metric=metric, cloud_points=1024)
    with Image.open(figures[0]) as picture:
        assert picture.size == (round(300 * TEXT_WIDTH), round(300 * HEIGHT))
    assert figures[1].read_bytes().startswith(b"%PDF")


def test_other_tables_and_metrics_are_refused(tmp_path):
    paths = tables(tmp_path, "oa")
    with pytest.raises(InputError, match="no value of the metric 'map'"):
        draw_against_ratio_from_files([tmp_path / "a.png"], paths, [], metric="map", cloud_points=1024)
    with pytest.raises(InputError, match="expected oa or map, got 'miou'"):
        draw_against_ratio_from_files([tmp_path / "a.png"], paths, [], metric="miou", cloud_points=1024)
    with pytest.raises(InputError, match="at least one table"):
        draw_against_ratio_from_files([tmp_path / "a.png"], [], [], metric="oa", cloud_points=1024)
