import math

from conftest import REPOSITORY
from sampled import draw_frame, draw_rows, shape_frame, shape_rows

from morphoskel.reporting.sampling_tables import build_sampling_table


def notes_of(name, *shapes, draws=(), protocol="correct"):
    result = build_sampling_table(
        name,
        shape_frame(*shapes),
        draw_frame(*draws),
        REPOSITORY / "config" / "paper",
        dataset="mine",
        protocol=protocol,
    )
    return result.footnotes


def holds(notes, *words):
    return any(all(word in note for word in words) for note in notes)


def test_a_table_without_results_explains_the_paper_only():
    notes = notes_of("object_classification")
    assert len(notes) == 3
    assert holds(notes, "Columns: sampling ratio", "data set mine")
    assert holds(notes, "FPS, S-NET, SampleNet", "another task network", "without point dropout")
    assert holds(notes, "best of 250 noisy evaluations on the test shapes")


def test_the_table_of_priors_has_no_row_of_the_other_task_network():
    assert not holds(notes_of("skeleton_prior"), "another task network")


def test_draws_are_counted():
    notes = notes_of(
        "object_classification",
        shape_rows("ms3d", [1.0]),
        shape_rows("random", [1.0]),
        draws=[draw_rows("ms3d", [1.0, 0.0, 0.5]), draw_rows("random", [1.0, 0.0, 0.5]), draw_rows("dpc", [1.0] * 9)],
    )
    assert holds(notes, "Random, MS3D: means over 3 draws", "noise of the learned samplers is on, as in the paper")
    assert holds(notes, "over trainings of the sampler, all with one task network; over draws for random points")
    assert holds(notes, "Standard deviation over draws")


def test_notes_of_absent_rows_are_absent():
    notes = notes_of("object_classification", shape_rows("random", [1.0]), draws=[draw_rows("random", [1.0, 0.0])])
    assert holds(notes, "CSV file: over draws.")
    for word in ("noise of the learned", "Arg-max", "Completed", "LFS-weighted", "Uniform", "Shuffled", "±", "before",
                 "Classifier without", "over trainings of the", "query", "McNemar", "failed"):  # fmt: skip
        assert not holds(notes, word), word


def test_each_kind_of_row_is_explained():
    rows = [shape_rows("ms3d", [1.0, 0.5], choice=choice) for choice in ("argmax", "completed")]
    rows += [shape_rows(sampler, [1.0, 0.5]) for sampler in ("uniform", "shuffled")]
    rows += [shape_rows(sampler, [1.0, 0.5], choice="fixed") for sampler in ("lfs", "snet")]
    notes = notes_of("object_classification", *rows, shape_rows("lfs", [1.0, 0.5], choice="fixed", classifier="plain"))
    for word in ("Arg-max:", "Completed:", "LFS-weighted FPS:", "Uniform prior:", "Shuffled prior:", "±:",
                 "before S-NET", "Classifier without point dropout:"):  # fmt: skip
        assert holds(notes, word), word


def test_retrieval_says_what_happens_to_the_query():
    alone = shape_rows("metasampler", [1.0, 0.5], choice="fixed")
    alone[1]["average_precision_excluded"] = math.nan
    notes = notes_of("point_cloud_retrieval", alone)
    assert holds(notes, "itself ranked first", "leaves it out", "1 shapes without another of their class")
    assert holds(notes, "MetaSampler: no mean average precision was published")
    released = notes_of("point_cloud_retrieval", alone, protocol="released")
    assert holds(released, "itself ranked first")
    assert not holds(released, "leaves it out")


def test_differences_and_the_test_are_explained():
    rows = [shape_rows(sampler, [1.0, 0.0], choice="argmax") for sampler in ("ms3d", "skeleton_aware")]
    notes = notes_of("skeleton_prior", *rows)
    assert holds(notes, "Differences:", "paired bootstrap over shapes")
    assert holds(notes, "McNemar's test")


def test_many_failures_are_not_all_named():
    notes = notes_of("object_classification", shape_rows("ms3d", [math.nan] * 12), shape_rows("dpc", [math.nan]))
    assert holds(notes, "MS3D: 12 of 12 shapes failed", "j (no inside) and 2 more.")
    assert not holds(notes, "DPC")
