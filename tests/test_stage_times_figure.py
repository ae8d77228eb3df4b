import math
from itertools import pairwise

import pandas as pd
import pytest
from charts import entries, page, visible_words
from conftest import REPOSITORY

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.figure_page import TEXT_WIDTH
from morphoskel.reporting.figures.stage_times import StageTimes, plot_stage_times, stage_times
from morphoskel.reporting.figures.stage_times_files import draw_stage_times_from_files, published_means
from morphoskel.reporting.published import published_shape_counts
from morphoskel.reporting.time_table import TIME_COLUMNS, processing_time
from morphoskel.stages import STAGES, TIMED_STAGES

FOLDER = REPOSITORY / "config" / "paper"
SECONDS = dict(zip(TIMED_STAGES, (1.0, 2.0, 0.25, 0.5, 0.125, 0.002, 0.3), strict=True))
PUBLISHED = {"Poisson": 0.31, "Watertight": 1.65, "MS3D": 1.67}


def rows(shape="a", category="Mug", surface="poisson", factor=1.0, failed=()):
    return [
        dict(zip(TIME_COLUMNS, (shape, category, surface, stage, math.nan if stage in failed else factor * seconds),
                 strict=True))
        for stage, seconds in SECONDS.items()
    ]  # fmt: skip


def frame(*parts):
    return pd.DataFrame([row for part in parts for row in part], columns=list(TIME_COLUMNS))


def write(folder, *parts, name="times.csv"):
    frame(*parts).to_csv(folder / name, index=False)
    return folder / name


def published_of(figure):
    """Widths of the outlined boxes."""
    return [box.get_width() for box in figure.axes[0].patches if box.get_facecolor()[3] == 0]


def test_means_are_those_of_the_table():
    times = frame(rows("a"), rows("b", "Chair", factor=2), rows("a", surface="ponq", factor=3))
    poisson, ponq = stage_times(times)
    table = processing_time(times, FOLDER, dataset="mine", seeds=[0]).frame
    means = table[table["group"] == MEAN_OVER_SHAPES].set_index("method")["value"]
    assert (poisson.title, ponq.title) == ("Poisson", "PoNQ")
    assert poisson.seconds["udf"] == pytest.approx(means["MS3D: udf"]) == pytest.approx(0.75)
    assert poisson.total == pytest.approx(means["Poisson"] + means["Watertight"] + means["MS3D"])
    assert ponq.total == pytest.approx(means["PoNQ"] + means["Watertight after PoNQ"] + means["MS3D after PoNQ"])


def test_a_shape_that_failed_is_in_no_mean_and_is_counted():
    (bar,) = stage_times(frame(rows("a"), rows("b", factor=9, failed=TIMED_STAGES[4:])))
    assert bar.seconds == pytest.approx(SECONDS)
    assert bar.label == "Poisson\n(1 of 2 failed)"
    (bar,) = stage_times(frame(rows("a", failed=["udf"])))
    assert bar.seconds == {}
    assert bar.label == "Poisson\n(1 of 1 failed)"


def test_stages_lie_end_to_end_and_the_other_selection_apart():
    with page(TEXT_WIDTH, 1.6) as figure:
        plot_stage_times(figure, [StageTimes("Poisson", SECONDS)], {})
        boxes = figure.axes[0].patches
        ends = [(box.get_x(), box.get_x() + box.get_width()) for box in boxes]
        for (_, end), (start, _) in pairwise(ends[: len(STAGES)]):
            assert start == pytest.approx(end)
        assert [end - start for start, end in ends] == pytest.approx(list(SECONDS.values()))
        assert ends[-1][0] > ends[-2][1] + 0.01
        assert boxes[-1].get_hatch()
        words = [word.get_text() for word in visible_words(figure)]
    assert "3.88 s, or 4.17 s" in words
    assert "selection by residue (at most 2 ms)" in words


def test_without_the_other_selection_there_is_one_total():
    seconds = {stage: SECONDS[stage] for stage in STAGES}
    with page(TEXT_WIDTH, 1.6) as figure:
        plot_stage_times(figure, [StageTimes("Poisson", seconds)], PUBLISHED)
        words = [word.get_text() for word in visible_words(figure)]
        assert published_of(figure) == pytest.approx(list(PUBLISHED.values()), abs=0.05)
    assert "3.88 s" in words
    assert "3.63 s" in words
    assert "selection by coverage instead" not in words


def test_every_word_can_be_read_where_shapes_failed():
    bars = [StageTimes(name, SECONDS, 3, 16) for name in ("Poisson", "repaired Poisson", "BPA", "Alpha", "PoNQ")]
    with page(TEXT_WIDTH, 2.75) as figure:
        plot_stage_times(figure, [*bars[:4], StageTimes("PoNQ", {}, 16, 16)], PUBLISHED)
        assert "no shape has all stages" in [word.get_text() for word in visible_words(figure)]
        assert "published, occupancy to selection" in entries(figure)


def test_published_means_stand_beside_the_same_categories_only():
    categories = set(published_shape_counts(FOLDER))
    totals = {"Poisson": 366.47, "Watertight": 1950.97, "MS3D": 1976.04}
    by_hand = {name: total / 1184 for name, total in totals.items()}
    assert published_means(categories, FOLDER) == pytest.approx(by_hand)
    assert published_means(categories - {"Mug"}, FOLDER) == {}
    assert published_means(categories | {"Sofa"}, FOLDER) == {}


def test_files_are_written_from_times(tmp_path):
    files = [write(tmp_path, rows()), write(tmp_path, rows(surface="ponq"), name="more.csv")]
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_stage_times_from_files(paths, files, FOLDER)
    assert paths[0].read_bytes().startswith(b"\x89PNG")
    assert paths[1].read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "no such file; expected a table"),
        ("id,category,surface,stage\n", "the columns seconds are missing"),
        ("id,category,surface,stage,seconds\na,Mug,poisson,udf,fast\n", "a value is not a number"),
        ("id,category,surface,stage,seconds\n" + 2 * "a,Mug,poisson,udf,1\n", "a, poisson, udf: a second time"),
    ],
)
def test_illegal_files_are_refused(tmp_path, content, message):
    if content is not None:
        (tmp_path / "times.csv").write_text(content)
    with pytest.raises(InputError, match=message):
        draw_stage_times_from_files([tmp_path / "a.png"], [tmp_path / "times.csv"], FOLDER)


def test_no_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one file"):
        draw_stage_times_from_files([tmp_path / "a.png"], [], FOLDER)
