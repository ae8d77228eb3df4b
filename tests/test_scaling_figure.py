import numpy as np
import pandas as pd
import pytest
from charts import entries, lines_of, page
from matplotlib.colors import to_hex
from PIL import Image

from morphoskel.evaluation.scaling import SCALED_STAGES, SCALING_COLUMNS
from morphoskel.reporting.figure_page import COLUMN_WIDTH
from morphoskel.reporting.figures.curves import GREY
from morphoskel.reporting.figures.marks import TOTAL, mark_of
from morphoskel.reporting.figures.scaling import HEIGHT, draw_scaling_from_files, plot_scaling

COUNTS = [10**4, 10**5, 10**6, 10**7]


def times(repeats=(1.0, 4.0, 2.0)):
    """Each stage has its own power of the number of candidates."""
    rows = [
        (count, repeat, stage, factor * 1e-6 * count ** (0.5 + number / 4), count // 2, 2)
        for repeat, factor in enumerate(repeats)
        for count in COUNTS
        for number, stage in enumerate(SCALED_STAGES)
    ]
    return pd.DataFrame(rows, columns=list(SCALING_COLUMNS))


def test_lines_are_medians_and_the_total_is_that_of_each_repetition():
    with page(COLUMN_WIDTH, HEIGHT) as figure:
        plot_scaling(figure, times())
        (axes,) = figure.axes
        of_stages = {}
        for number, stage in enumerate(SCALED_STAGES):
            ((counts, of_stages[stage]),) = lines_of(axes, mark_of(stage).colour)
            assert counts == COUNTS
            assert of_stages[stage] == pytest.approx([2e-6 * count ** (0.5 + number / 4) for count in COUNTS])
        ((_, total),) = lines_of(axes, mark_of(TOTAL).colour)
        assert total == pytest.approx(np.sum(list(of_stages.values()), axis=0))
        assert axes.get_ylabel() == "seconds, 2 threads"
        assert entries(figure) == ["total", "occupancy", "UDF", "dilation"]


def test_the_total_of_a_median_repetition_is_no_sum_of_medians():
    frame = times(repeats=(1.0, 1.0, 1.0))
    for stage, repeat in zip(SCALED_STAGES, (0, 1, 2), strict=True):
        frame.loc[(frame["stage"] == stage) & (frame["repeat"] == repeat), "seconds"] *= 100
    with page(COLUMN_WIDTH, HEIGHT) as figure:
        plot_scaling(figure, frame)
        ((_, total),) = lines_of(figure.axes[0], mark_of(TOTAL).colour)
    by_hand = [frame[frame["candidates"] == count].groupby("repeat")["seconds"].sum().median() for count in COUNTS]
    assert total == pytest.approx(by_hand)


def test_bands_reach_from_the_fastest_to_the_slowest():
    with page(COLUMN_WIDTH, HEIGHT) as figure:
        plot_scaling(figure, times())
        band = figure.axes[0].collections[1]  # of the first stage, behind that of the total
        corners = {round(float(y), 9) for x, y in band.get_paths()[0].vertices if x == 10**4}
    assert corners == {1e-4, 4e-4}


def test_guides_have_the_slopes_that_they_are_called_by():
    with page(COLUMN_WIDTH, HEIGHT) as figure:
        plot_scaling(figure, times())
        guides = [line.get_xydata() for line in figure.axes[0].get_lines() if to_hex(line.get_color()) == GREY]
    slopes = [np.diff(np.log(guide[:, 1])) / np.diff(np.log(guide[:, 0])) for guide in guides]
    assert np.ravel(slopes) == pytest.approx([1, 2])


def test_files_are_written_from_a_file(tmp_path):
    times(repeats=(1.0,)).to_csv(tmp_path / "times.csv", index=False)
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_scaling_from_files(paths, tmp_path / "times.csv")
    with Image.open(paths[0]) as picture:
        assert picture.size == (round(300 * COLUMN_WIDTH), round(300 * HEIGHT))
    assert paths[1].read_bytes().startswith(b"%PDF")
