import math

import pytest
from conftest import REPOSITORY
from segmented import segmentation_frame, segmentation_rows

from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.published import read_published, weighted_mean
from morphoskel.reporting.segmentation_footnotes import PUBLISHED_SHAPES
from morphoskel.reporting.segmentation_table import build_segmentation_table


def notes_of(*parts, **more):
    frame = segmentation_frame(*parts)
    folder = REPOSITORY / "config" / "paper"
    return build_segmentation_table(frame, folder, dataset="mine", protocol="correct", **more).footnotes


def holds(notes, *words):
    return any(all(word in note for word in words) for note in notes)


def everywhere(counts, **more):
    """As many shapes of each category as counts say."""
    return [
        row
        for name, count in counts.items()
        for number in range(count)
        for row in segmentation_rows("fps", [0.5], category=name, id=f"s{number}", **more)
    ]


def test_a_table_without_results_explains_the_paper_only():
    notes = notes_of()
    assert len(notes) == 5
    assert holds(notes, "2874 test shapes of ShapeNetPart", "data set mine")
    assert holds(notes, "neither there nor predicted counts 1", "the paper prints none")
    assert holds(notes, "PointNet (all labels)", "copied by the paper from the PointNet paper")
    assert holds(notes, "MS3D, ratio 128; Mean over shapes", "printed as Mean; it is the mean over the shapes")


def test_the_papers_means_follow_from_its_categories_and_numbers_of_shapes():
    assert sum(PUBLISHED_SHAPES.values()) == 2874
    published = read_published(REPOSITORY / "config" / "paper", "part_segmentation_miou")
    assert published["method"].nunique() == 9
    for _, rows in published.groupby("method"):
        values = dict(zip(rows["group"], rows["value"], strict=True))
        printed = values.pop(MEAN_OVER_SHAPES)
        assert set(values) == set(PUBLISHED_SHAPES)
        assert weighted_mean(values, PUBLISHED_SHAPES) == pytest.approx(printed, abs=0.1)


def test_decisions_are_listed_as_they_were_made():
    notes = notes_of(decisions=["Labels are chosen once.", "The category is known."])
    assert holds(notes, "What the paper leaves open", "Labels are chosen once. The category is known.")
    assert not holds(notes_of(), "What the paper leaves open")


def test_only_learned_samplers_come_from_another_data_set():
    origin = {"transferred_from": "ModelNet40"}
    assert holds(notes_of(segmentation_rows("ms3d", [0.5]), **origin), "Learned samplers: trained on ModelNet40.")
    assert not holds(notes_of(segmentation_rows("lfs", [0.5]), **origin), "ModelNet40")
    assert not holds(notes_of(segmentation_rows("ms3d", [0.5])), "Learned samplers")


def test_each_kind_of_row_is_explained_where_it_is():
    words = ("LFS-weighted FPS:", "Uniform prior:", "Shuffled prior:", "Differences:", "±:", "Points with a label:",
             "over trainings")  # fmt: skip
    strategies = ("lfs", "uniform", "shuffled", "fps", "ms3d")
    parts = [segmentation_rows(name, [0.5, 0.6], seed=seed) for name in strategies for seed in (0, 1)]
    notes = notes_of(*parts)
    for word in words:
        assert holds(notes, word), word
    few = notes_of(segmentation_rows("fps", [0.5]))
    for word in set(words) - {"Points with a label:"}:
        assert not holds(few, word), word


def test_other_weights_are_told():
    one_each = dict.fromkeys(PUBLISHED_SHAPES, 1)
    assert holds(notes_of(everywhere(one_each)), "Airplane 341, Bag 14", "in another proportion")
    assert not holds(notes_of(everywhere(PUBLISHED_SHAPES)), "another proportion")


def test_failed_shapes_are_counted():
    notes = notes_of(segmentation_rows("fps", [0.5, math.nan, math.nan]))
    assert holds(notes, "Test shapes that failed", "FPS, ratio 16 2 of 3.")
    assert not holds(notes_of(segmentation_rows("fps", [0.5])), "failed")
