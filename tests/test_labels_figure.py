import math
import statistics

import pytest
from charts import entries, lines_of, page
from conftest import REPOSITORY
from matplotlib.colors import to_hex
from segmented import segmentation_frame, segmentation_rows

from morphoskel.errors import InputError
from morphoskel.reporting.figure_page import COLUMN_WIDTH
from morphoskel.reporting.figures.curves import Curve
from morphoskel.reporting.figures.labels import draw_labels_from_files, plot_labels, strategy_curves
from morphoskel.reporting.figures.marks import mark_of
from morphoskel.reporting.segmentation_footnotes import PUBLISHED_SHAPES
from morphoskel.reporting.segmentation_names import FULL, STRATEGY_NAMES
from morphoskel.reporting.segmentation_table import build_segmentation_table
from morphoskel.reporting.table import read_table, write_table

FOLDER = REPOSITORY / "config" / "paper"


def everywhere(strategy, value, **options):
    """One shape of every category that the paper has, so that its means stand beside ours."""
    return [
        row
        for category in PUBLISHED_SHAPES
        for row in segmentation_rows(strategy, [value], category=category, **options)
    ]


def table(folder, *parts):
    result = build_segmentation_table(segmentation_frame(*parts), FOLDER, dataset="mine", protocol="correct")
    write_table(result.frame, folder / "table", "Caption.", result.footnotes)
    return folder / "table.csv"


def curves(folder, *parts):
    return strategy_curves(read_table(table(folder, *parts)))


def test_own_values_stand_at_the_labels_counted_and_published_ones_at_those_of_the_ratio(tmp_path):
    parts = [everywhere("ms3d", 0.75, labels=15.5, seed=seed) for seed in range(2)]
    ms3d = curves(tmp_path, *parts)["ms3d"]
    assert ms3d.measured.tolist() == [pytest.approx([15.5, 75, 0])]
    assert ms3d.published.tolist() == [[16, 73.3], [32, 76.9], [64, 77.5], [128, 79.4]]


def test_deviations_are_over_trainings(tmp_path):
    parts = [everywhere("fps", value, seed=seed) for seed, value in enumerate((0.5, 0.6, 0.8))]
    parts.append(everywhere("random", 0.5))
    found = curves(tmp_path, *parts)
    assert found["fps"].measured[0, 1:] == pytest.approx([100 * 1.9 / 3, 100 * statistics.stdev([0.5, 0.6, 0.8])])
    assert math.isnan(found["random"].measured[0, 2])


def test_strategies_are_those_with_a_value_or_a_published_one(tmp_path):
    found = curves(tmp_path, everywhere("lfs", 0.5), everywhere("dpc", math.nan))
    assert list(found) == [FULL, "fps", "lfs", "ms3d"]
    assert found["fps"].entry == "FPS (not run)"
    assert found["lfs"].entry == "LFS-weighted FPS"


def test_full_supervision_is_a_horizontal_line_with_a_band(tmp_path):
    parts = [everywhere("ms3d", 0.7, ratio=ratio) for ratio in ("16", "32")]
    parts += [everywhere(FULL, value, ratio="1", seed=seed, labels=2048) for seed, value in enumerate((0.8, 0.9))]
    found = curves(tmp_path, *parts)
    full = found.pop(FULL)
    with page(COLUMN_WIDTH, 3.6) as figure:
        plot_labels(figure, list(found.values()), full)
        (axes,) = figure.axes
        lines = [line for line in axes.get_lines() if to_hex(line.get_color()) == mark_of(FULL).colour]
        assert [line.get_ydata() for line in lines] == [[pytest.approx(85)] * 2, [83.7] * 2]
        (band,) = axes.patches
        deviation = 100 * statistics.stdev([0.8, 0.9])
        assert (band.get_y(), band.get_height()) == pytest.approx((85 - deviation, 2 * deviation))
        assert axes.get_xlim()[1] < 256  # the number of all labels is no place on the axis
        assert entries(figure) == [
            *("this run", "± one standard deviation", "published", "FPS (not run)", "MS3D"),
            *("all labels", "all labels, published"),
        ]


def test_all_strategies_can_be_read():
    strategies = {strategy: title for strategy, title in STRATEGY_NAMES.items() if strategy != FULL}
    drawn = [
        Curve.of(strategy, title, [(2**power, 60 + 5 * power - number, 0.5) for power in (4, 5, 6, 7)], [(16, 70)])
        for number, (strategy, title) in enumerate(strategies.items())
    ]
    with page(COLUMN_WIDTH, 4.2) as figure:
        plot_labels(figure, drawn, Curve.of(FULL, "all", [], [(2048, 99)]))
        for number, strategy in enumerate(strategies):
            ((points, values),) = lines_of(figure.axes[0], mark_of(strategy).colour)
            assert points == [16, 32, 64, 128]
            assert values == [80 - number, 85 - number, 90 - number, 95 - number]
        assert entries(figure)[-1] == "all labels, published (not run)"


def test_files_are_written_from_a_table(tmp_path):
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_labels_from_files(paths, table(tmp_path, everywhere("ms3d", 0.7), everywhere(FULL, 0.8, ratio="1")))
    assert paths[0].read_bytes().startswith(b"\x89PNG")
    assert paths[1].read_bytes().startswith(b"%PDF")


def test_a_run_of_other_categories_has_nothing_published(tmp_path):
    found = curves(tmp_path, segmentation_rows("ms3d", [0.7]))
    assert list(found) == ["ms3d"]
    assert found["ms3d"].published.shape == (0, 2)


def test_another_table_is_refused(tmp_path):
    path = table(tmp_path, segmentation_rows("ms3d", [0.7]))
    path.write_text(path.read_text().splitlines()[0] + "\n")
    with pytest.raises(InputError, match="no mean over shapes of any strategy"):
        draw_labels_from_files([tmp_path / "a.png"], path)
