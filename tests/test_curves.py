import math

import numpy as np
import pandas as pd
import pytest
from charts import lines_of, page

from morphoskel.reporting.figures.curves import (
    Curve,
    absence,
    count_axis,
    has_deviations,
    has_published,
    numbers_of_points,
    plot_curve,
    reading_guide,
)
from morphoskel.reporting.figures.marks import mark_of

NONE = math.nan


def curve(measured=(), published=(), **more):
    return Curve.of("fps", "FPS", measured, published, **more)


def test_rows_are_sorted_by_the_number_of_points():
    made = curve([(64, 80, 1), (16, 60, NONE)], [(128, 70.4), (16, 13.5)])
    assert made.measured[:, 0].tolist() == [16, 64]
    assert made.measured[:, 1].tolist() == [60, 80]
    assert made.published.tolist() == [[16, 13.5], [128, 70.4]]
    assert curve().measured.shape == (0, 3)


def test_a_legend_says_what_was_not_run():
    assert curve([(16, 60, NONE)]).entry == "FPS"
    assert curve(published=[(16, 13.5)]).entry == "FPS (not run)"
    assert curve(absence="failed").entry == "FPS (failed)"


@pytest.mark.parametrize(("counts", "word"), [((0, 0), "not run"), ((0, 3), "failed"), ((3, 0), "failed")])
def test_absence_tells_failures_from_what_was_not_run(counts, word):
    rows = pd.DataFrame([(0, 0), counts], columns=["n", "n_failed"])
    assert absence(rows) == word


def test_own_values_are_a_line_and_published_ones_hollow():
    with page(4, 3) as figure:
        axes = figure.subplots()
        plot_curve(axes, curve([(16, 60, NONE), (32, 70, NONE)], [(16, 13.5)]))
        colour = mark_of("fps").colour
        assert lines_of(axes, colour) == [([16, 32], [60, 70])]
        assert lines_of(axes, colour, hollow=True) == [([16], [13.5])]


def test_bands_reach_one_deviation_up_and_down_and_only_where_there_is_one():
    with page(4, 3) as figure:
        axes = figure.subplots()
        plot_curve(axes, curve([(16, 60, 2), (32, 70, NONE)]))
        (band,) = axes.collections
        corners = {tuple(corner) for corner in band.get_paths()[0].vertices}
        assert corners == {(16, 58), (16, 62), (32, 70)}
        plot_curve(axes, curve([(16, 60, NONE)]))
        assert len(axes.collections) == 1


def test_a_guide_has_entries_for_what_is_drawn():
    def words(**given):
        return [entry.get_label() for entry in reading_guide(**given)]

    assert words(deviations=False, published=False) == ["this run"]
    assert words(deviations=True, published=True, level="all points") == [
        *("this run", "± one standard deviation", "published", "all points")
    ]


def test_what_a_guide_depends_on():
    plain, banded, printed = curve([(16, 60, NONE)]), curve([(16, 60, 1)]), curve(published=[(16, 1)])
    assert not has_deviations([plain, printed])
    assert has_deviations([plain, banded])
    assert not has_published([plain, banded])
    assert has_published([plain, printed])


def test_numbers_of_points_are_rounded_to_powers_of_two():
    assert numbers_of_points([curve([(15.5, 60, NONE), (125, 60, NONE)], [(32, 1)]), curve()]) == [16, 32, 128]
    assert numbers_of_points([]) == []


def test_the_axis_of_points_has_equal_steps_and_plain_numbers():
    with page(4, 3) as figure:
        axes = figure.subplots()
        plot_curve(axes, curve([(16, 60, NONE), (128, 70, NONE)]))
        count_axis(axes, [16, 32, 64, 128], "points")
        figure.draw_without_rendering()
        assert [label.get_text() for label in axes.get_xticklabels()] == ["16", "32", "64", "128"]
        steps = np.diff([axes.transData.transform((count, 60))[0] for count in (16, 32, 64, 128)])
        assert steps == pytest.approx(np.full(3, steps[0]))
