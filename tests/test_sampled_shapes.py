import math

import numpy as np
import pandas as pd
import pytest
import torch
from tiny_classifier import NAMES
from tiny_clouds import select, tiny_classifier, tiny_clouds, tiny_priors

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import InputError
from morphoskel.evaluation.sampled_shapes import evaluate_choices, evaluate_files, every_point
from morphoskel.networks.pointnet_classifier import save_classifier
from morphoskel.reporting.sampling_rows import DRAW_COLUMNS, SHAPE_COLUMNS
from morphoskel.sampling.choice import Choice, write_choice
from morphoskel.sampling.prior_set import write_prior_set

CLOUDS = tiny_clouds(shapes=6)
FAILED = 4
MEASURED = ["correct", "average_precision", "average_precision_excluded"]


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


CLASSIFIER = tiny_classifier()


def random_choice(draws=2, samples=8, failed=(), seed=0):
    indices = np.random.default_rng(seed).integers(0, 40, (draws, 6, samples), dtype=np.int32)
    distinct = np.array([[len({*row.tolist()}) for row in rows] for rows in indices], dtype=np.int32)
    indices[:, list(failed)], distinct[:, list(failed)] = -1, 0
    return Choice(indices, distinct)


def evaluate(choices, clouds=CLOUDS, reasons=None, classifiers=None):
    return evaluate_choices("ms3d", choices, clouds, classifiers or {"task": CLASSIFIER}, reasons)


@torch.no_grad()
def judged_naive(indices, known):
    """Judge one draw shape by shape: correct, and both average precisions by sorting in a loop."""
    answers = {}
    for number in known:
        classified = CLASSIFIER(torch.from_numpy(CLOUDS.points[number][indices[number]])[None])
        answers[number] = (int(classified.log_probabilities.argmax()), classified.descriptor[0].double().numpy())
    values = {}
    for query in known:
        ranked = sorted(known, key=lambda other: (other != query, math.dist(answers[query][1], answers[other][1])))
        precisions = []
        for ranking in (ranked, ranked[1:]):
            found, shares = 0, []
            for place, other in enumerate(ranking, start=1):
                if CLOUDS.labels[other] == CLOUDS.labels[query]:
                    found += 1
                    shares.append(found / place)
            precisions.append(math.fsum(shares) / len(shares) if shares else math.nan)
        values[query] = (float(answers[query][0] == CLOUDS.labels[query]), *precisions)
    return values


@pytest.mark.parametrize("failed", [(), (FAILED,)])
def test_the_rows_are_means_of_what_the_naive_twin_finds(failed):
    choice = random_choice(failed=failed)
    shapes, draws = evaluate({(4, 1, "drawn"): choice})
    assert shapes.columns.tolist() == list(SHAPE_COLUMNS)
    assert draws.columns.tolist() == list(DRAW_COLUMNS)
    known = [number for number in range(6) if number not in failed]
    naive = [judged_naive(indices, known) for indices in choice.indices]
    for number in known:
        expected = np.mean([values[number] for values in naive], axis=0)
        np.testing.assert_allclose(shapes.loc[number, MEASURED].astype(float), expected, rtol=1e-9)
        assert shapes.loc[number, "distinct"] == choice.distinct[:, number].mean()
    for draw, values in enumerate(naive):
        expected = np.mean(list(values.values()), axis=0)
        np.testing.assert_allclose(draws.loc[draw, ["oa", "map", "map_excluded"]].astype(float), expected, rtol=1e-9)
    assert draws["draw"].tolist() == [0, 1]
    assert draws["oa"].mean() == pytest.approx(shapes["correct"].mean())
    for frame in (shapes, draws):
        assert (frame["ratio"] == 4).all()
        assert (frame["seed"] == 1).all()
        assert (frame["choice"] == "drawn").all()
        assert (frame["sampler"] == "ms3d").all()


def test_a_failed_shape_is_marked_and_neither_queries_nor_is_retrieved():
    choice = random_choice(failed=(FAILED,))
    shapes, draws = evaluate({(4, 0, "drawn"): choice}, reasons=tiny_priors(CLOUDS, (FAILED,)).reasons)
    assert shapes["status"].tolist() == ["ok"] * 4 + ["failed", "ok"]
    assert shapes["reason"].tolist() == [""] * 4 + ["inner: no inside", ""]
    assert shapes.loc[FAILED, [*MEASURED, "distinct"]].isna().all()
    assert not shapes.drop(index=FAILED)[[*MEASURED, "distinct"]].isna().any(axis=None)
    kept = [0, 1, 2, 3, 5]
    others = Choice(choice.indices[:, kept], choice.distinct[:, kept])
    shapes_without, draws_without = evaluate({(4, 0, "drawn"): others}, select(CLOUDS, kept))
    pd.testing.assert_frame_equal(draws_without, draws)
    pd.testing.assert_frame_equal(shapes_without[MEASURED], shapes.loc[kept, MEASURED].reset_index(drop=True))


def test_a_reason_is_given_also_where_none_is_known():
    shapes, draws = evaluate({(4, 0, "drawn"): random_choice(failed=range(6))})
    assert shapes["reason"].tolist() == ["nothing was chosen"] * 6
    assert draws[["oa", "map", "map_excluded"]].isna().all(axis=None)


def test_the_order_of_the_shapes_does_not_matter():
    choice, order = random_choice(), [3, 0, 5, 1, 2, 4]
    shapes, draws = evaluate({(4, 0, "drawn"): choice})
    moved = Choice(choice.indices[:, order], choice.distinct[:, order])
    shapes_moved, draws_moved = evaluate({(4, 0, "drawn"): moved}, select(CLOUDS, order))
    pd.testing.assert_frame_equal(shapes_moved, shapes.loc[order].reset_index(drop=True))
    pd.testing.assert_frame_equal(draws_moved, draws)


def test_every_choice_is_judged_by_every_classifier():
    choices = {(4, 0, "argmax"): random_choice(draws=1), (4, 1, "drawn"): random_choice(), (8, 0, "fixed"): every()}
    shapes, draws = evaluate(choices, classifiers={"task": CLASSIFIER, "plain": tiny_classifier(seed=1)})
    assert len(shapes) == 3 * 2 * 6
    keys = ["ratio", "seed", "choice", "classifier"]
    counts = {
        (ratio, seed, kind, name): len(choices[ratio, seed, kind].indices)
        for ratio, seed, kind in choices
        for name in ("task", "plain")
    }
    assert draws.groupby(keys).size().to_dict() == counts
    first, second = (draws[draws["classifier"] == name]["map"].to_numpy() for name in ("task", "plain"))
    assert not np.allclose(first, second)
    alone, _ = evaluate({(4, 1, "drawn"): choices[4, 1, "drawn"]})
    chosen = shapes[(shapes["choice"] == "drawn") & (shapes["classifier"] == "task")].reset_index(drop=True)
    pd.testing.assert_frame_equal(chosen, alone)


def every():
    ((_, choice),) = every_point(CLOUDS).items()
    return choice


@torch.no_grad()
def test_every_point_is_the_whole_cloud():
    choices = every_point(CLOUDS)
    assert list(choices) == [(1, 0, "fixed")]
    choice = choices[1, 0, "fixed"]
    assert choice.indices.shape == (1, 6, 40)
    assert (choice.distinct == 40).all()
    shapes, draws = evaluate(choices)
    predicted = CLASSIFIER(torch.from_numpy(CLOUDS.points)).log_probabilities.argmax(dim=1).numpy()
    assert shapes["correct"].tolist() == (predicted == CLOUDS.labels).astype(float).tolist()
    assert draws["oa"].tolist() == [np.mean(predicted == CLOUDS.labels)]
    shuffled = Choice(choice.indices[..., ::-1], choice.distinct)
    pd.testing.assert_frame_equal(evaluate({(1, 0, "fixed"): shuffled})[0], shapes)  # sets have no order


def test_a_classifier_of_other_classes_is_refused():
    with pytest.raises(InputError, match="expected a classifier of the 2 classes ball, line, got one of line, ball"):
        evaluate(every_point(CLOUDS), classifiers={"task": tiny_classifier(names=NAMES[::-1])})


def test_files_hold_the_same_rows(tmp_path):
    priors = tiny_priors(CLOUDS, failed=(FAILED,))
    choice = random_choice(failed=(FAILED,))
    write_cloud_set(CLOUDS, tmp_path / "clouds.npz")
    write_prior_set(priors, tmp_path / "priors.npz")
    write_choice(choice, tmp_path / "samples" / "4_0_drawn.npz")
    save_classifier(CLASSIFIER, NAMES, tmp_path / "task.pt")
    for name, samples, sizes, choices in (
        ("chosen", tmp_path / "samples", tmp_path / "priors.npz", {(4, 0, "drawn"): choice}),
        ("all", None, None, every_point(CLOUDS)),
    ):
        outputs = (tmp_path / name / "shapes.csv", tmp_path / name / "draws.csv")
        evaluate_files("ms3d", tmp_path / "clouds.npz", samples, sizes, {"task": tmp_path / "task.pt"}, outputs)
        frames = evaluate(choices, reasons=priors.reasons)
        for path, frame in zip(outputs, frames, strict=True):
            assert path.read_text() == frame.to_csv(index=False)


def test_missing_files_are_named(tmp_path):
    outputs = (tmp_path / "shapes.csv", tmp_path / "draws.csv")
    write_cloud_set(CLOUDS, tmp_path / "clouds.npz")
    save_classifier(CLASSIFIER, NAMES, tmp_path / "task.pt")
    for clouds, samples, classifier in (
        ("absent", None, "task.pt"), ("clouds.npz", "absent", "task.pt"), ("clouds.npz", None, "absent")
    ):  # fmt: skip
        with pytest.raises(InputError, match="absent: "):
            evaluate_files("fps", tmp_path / clouds, tmp_path / samples if samples else None, None,
                           {"task": tmp_path / classifier}, outputs)  # fmt: skip
    assert not outputs[0].exists()
