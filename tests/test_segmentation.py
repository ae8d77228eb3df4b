from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from tiny_parts import NAMES, PART_CLASSES, TINY, tiny_parts, tiny_segmentation

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import InputError
from morphoskel.evaluation.segmentation import (
    evaluate_segmentation,
    evaluate_segmentation_files,
    part_ious,
    shape_iou,
)
from morphoskel.networks.part_segmentation import PartSegmentationNetwork, predict_parts, save_segmentation
from morphoskel.reporting.segmentation_rows import SEGMENTATION_COLUMNS, check_segmentation_rows
from morphoskel.sampling.choice import Choice, write_choice

CLOUDS = tiny_parts(shapes=5, points=30, repeated=6)
PARTS = {0: [0, 1], 1: [2, 3, 4]}


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def naive_ious(predicted, truth, parts):
    """Intersection over union of sets of points."""
    ious = []
    for part in parts:
        there = {point for point, label in enumerate(truth) if label == part}
        found = {point for point, label in enumerate(predicted) if label == part and truth[point] != -1}
        ious.append(len(there & found) / len(there | found) if there | found else 1.0)
    return ious


def shapes_of(parts):
    """Points with a true part, -1 for some, and a predicted one, which may be of another category."""
    return st.lists(st.tuples(st.sampled_from([-1, *parts]), st.sampled_from([*parts, 9])), min_size=1, max_size=12)


@given(shape=shapes_of([2, 3, 5]))
def test_intersections_over_unions_are_those_of_sets(shape):
    truth, predicted = np.array(shape).T
    expected = naive_ious(predicted.tolist(), truth.tolist(), [2, 3, 5])
    np.testing.assert_allclose(part_ious(predicted, truth, [2, 3, 5]), expected, rtol=1e-15)
    assert shape_iou(predicted, truth, [2, 3, 5]) == pytest.approx(sum(expected) / 3)
    order = np.random.default_rng(0).permutation(len(truth))
    assert np.array_equal(part_ious(predicted[order], truth[order], [2, 3, 5]), part_ious(predicted, truth, [2, 3, 5]))


@given(shape=shapes_of([0, 1, 2, 3]))
def test_a_perfect_prediction_scores_1_and_another_less(shape):
    truth, predicted = np.array(shape).T
    assert shape_iou(truth, truth, range(4)) == 1.0
    wrong = np.any((predicted != truth) & (truth >= 0))
    assert (shape_iou(predicted, truth, range(4)) < 1.0) == wrong


def test_one_part_everywhere_scores_a_known_number():
    truth, predicted = np.array([0, 0, 0, 1, 1, 1, 1, 1]), np.zeros(8, dtype=np.int64)
    assert part_ious(predicted, truth, [0, 1]).tolist() == [3 / 8, 0.0]
    assert part_ious(predicted, truth, [0, 1, 2]).tolist() == [3 / 8, 0.0, 1.0]  # the third is in neither
    assert part_ious(np.full(8, 2), truth, [0, 1, 2]).tolist() == [0.0, 0.0, 0.0]
    assert shape_iou(predicted, truth, [0, 1]) == pytest.approx(3 / 16)


def test_points_without_a_true_part_do_not_count():
    truth = np.array([0, 0, 1, -1, -1])
    assert part_ious(np.array([0, 1, 1, 0, 1]), truth, [0, 1]).tolist() == [1 / 2, 1 / 2]
    assert part_ious(np.array([0, 0, 1, 2, 2]), truth, [0, 1, 2]).tolist() == [1.0, 1.0, 1.0]


def test_parts_of_other_points_are_refused():
    with pytest.raises(ValueError, match="of the same points"):
        part_ious(np.zeros(3, dtype=np.int64), np.zeros(4, dtype=np.int64), [0])


@pytest.mark.parametrize("restricted", [True, False])
def test_the_rows_are_what_loops_find(restricted):
    network = tiny_segmentation(replace(TINY, restrict_to_category=restricted))
    predicted = predict_parts(network, CLOUDS.points, CLOUDS.labels)
    frame = evaluate_segmentation(network, CLOUDS)
    assert frame["id"].tolist() == ["s0", "s1", "s2", "s3", "s4"]
    assert frame["category"].tolist() == ["ball", "stick", "ball", "stick", "ball"]
    assert set(frame["status"]) == {"ok"}
    for number, (found, truth, label) in enumerate(zip(predicted, CLOUDS.parts, CLOUDS.labels, strict=True)):
        ious = naive_ious(found.tolist(), truth.tolist(), PARTS[int(label)])
        right = [a == b for a, b in zip(found, truth, strict=True) if b >= 0]
        assert frame.loc[number, "iou"] == pytest.approx(sum(ious) / len(ious))
        assert frame.loc[number, "accuracy"] == pytest.approx(sum(right) / 24)
    assert frame["iou"].nunique() > 1


def test_networks_and_clouds_that_do_not_belong_together_are_refused():
    network = tiny_segmentation()
    with pytest.raises(InputError, match="the clouds have no parts"):
        evaluate_segmentation(network, replace(CLOUDS, parts=None, part_classes=None))
    with pytest.raises(InputError, match="of the 2 classes cube, stick, got one of ball, stick; train one"):
        evaluate_segmentation(network, replace(CLOUDS, class_names=np.array(["cube", "stick"])))
    with pytest.raises(InputError, match="whose categories are 0, 1, 1, 1, 1, got one of 0, 0, 1, 1, 1; train one"):
        evaluate_segmentation(network, replace(CLOUDS, part_classes=np.array([0, 1, 1, 1, 1])))


def write_networks(folder, ratios, count):
    """Write untrained networks of different weights and return their paths."""
    paths = [folder / str(ratio) / str(number) / "network.pt" for ratio in ratios for number in range(count)]
    for seed, path in enumerate(paths):
        path.parent.mkdir(parents=True)
        save_segmentation(tiny_segmentation(seed=seed), path)
    return paths


def write_files(folder, choices):
    """Write clouds to segment, two files of clouds to learn from, and points chosen of the latter."""
    write_cloud_set(CLOUDS, folder / "test.npz")
    trained = []
    for split, shapes in (("train", 4), ("val", 2)):
        trained.append(folder / f"{split}.npz")
        write_cloud_set(tiny_parts(shapes=shapes, points=30, repeated=6), trained[-1])
        for name, indices in choices.items():
            of_split = indices[:, :4] if split == "train" else indices[:, 4:]
            write_choice(Choice(of_split, np.zeros(of_split.shape[:2], dtype=np.int32)), folder / split / f"{name}.npz")
    return trained, [folder / "train", folder / "val"]


def draw(draws, samples, seed):
    """Points of six clouds of 24 points, six of which are repeated, with repetitions; of the last cloud none."""
    indices = np.random.default_rng(seed).integers(0, 30, (draws, 6, samples), dtype=np.int32)
    indices[:, -1] = -1
    return indices


def naive_labels(sets):
    """Mean number of different points in all of the sets, of the clouds of which some were chosen."""
    counts = [len({int(index) % 24 for indices in sets for index in indices[shape]}) for shape in range(5)]
    return sum(counts) / len(counts)


def evaluate(folder, networks, trained, samples, completed=False, label_sets=1):
    output = folder / "rows.csv"
    evaluate_segmentation_files(
        "ms3d", folder / "test.npz", networks, trained, samples, output, completed=completed, label_sets=label_sets
    )
    return pd.read_csv(output, dtype={"ratio": str})


@pytest.mark.parametrize(("completed", "label_sets"), [(False, 1), (True, 1), (False, 2)])
def test_files_hold_the_rows_of_every_network_and_the_labels_it_saw(tmp_path, completed, label_sets):
    names = [f"{ratio}_{training}_{kind}" for ratio in (4, 8) for training in (0, 1) for kind in ("drawn", "completed")]
    choices = {name: draw(6, 30 // int(name[0]), seed) for seed, name in enumerate(names)}
    networks = write_networks(tmp_path, (4, 8), 3)
    trained, samples = write_files(tmp_path, choices)
    frame = evaluate(tmp_path, networks, trained, samples, completed, label_sets)
    assert tuple(frame.columns) == SEGMENTATION_COLUMNS
    check_segmentation_rows(frame)
    assert set(frame["strategy"]) == {"ms3d"}
    for number, ((ratio, seed), rows) in enumerate(frame.groupby(["ratio", "seed"])):
        alone = evaluate_segmentation(tiny_segmentation(seed=number), CLOUDS)
        pd.testing.assert_frame_equal(rows[list(alone.columns)].reset_index(drop=True), alone)
        chosen = choices[f"{ratio}_{seed % 2}_{'completed' if completed else 'drawn'}"]
        labels = naive_labels(chosen[seed * label_sets : (seed + 1) * label_sets])
        assert rows["labels"].to_numpy() == pytest.approx([labels] * 5)


def test_a_sampler_that_always_chooses_the_same_has_one_set_of_labels(tmp_path):
    choices = {"4_0_fixed": draw(1, 7, seed=0)}
    trained, samples = write_files(tmp_path, choices)
    frame = evaluate(tmp_path, write_networks(tmp_path, (4,), 2), trained, samples, completed=True, label_sets=3)
    assert frame["labels"].to_numpy() == pytest.approx([naive_labels(choices["4_0_fixed"])] * 10)


def test_all_points_are_labels_but_for_repeated_ones(tmp_path):
    trained, _ = write_files(tmp_path, {})
    frame = evaluate(tmp_path, write_networks(tmp_path, (1,), 1), trained, [])
    assert frame["labels"].tolist() == [24.0] * 5
    assert frame["ratio"].tolist() == ["1"] * 5


def test_files_that_do_not_belong_together_are_named(tmp_path):
    nothing = np.full((1, 6, 7), -1, dtype=np.int32)
    trained, samples = write_files(tmp_path, {"4_0_drawn": draw(1, 7, seed=0), "8_0_fixed": nothing})
    networks = write_networks(tmp_path / "networks", (4, 8), 2)
    other = tmp_path / "other" / "4" / "0" / "network.pt"
    other.parent.mkdir(parents=True)
    save_segmentation(PartSegmentationNetwork(PART_CLASSES, NAMES[::-1], TINY), other)
    save_segmentation(tiny_segmentation(), tmp_path / "network.pt")
    for chosen, folders, message in (
        ([tmp_path / "network.pt"], samples, r"network\.pt: expected its folders to be named by ratio and number"),
        ([tmp_path / "4" / "7" / "network.pt"], [], r"network\.pt: no trained part segmentation there"),
        ([other], samples, r"other/4/0/network\.pt, on .*test\.npz: expected a classifier of the 2 classes ball"),
        (networks[:1], samples[:1], "a folder of chosen points for each of 2 files of clouds, got 1"),
        (networks[:1], samples[::-1], "val: points are chosen of 2 shapes, but there are 4"),
        (networks[:2], samples, "train: expected at least 2 draws at ratio 4"),
        (networks[2:], samples, "train, .*val: nothing was chosen of any shape"),
    ):
        with pytest.raises(InputError, match=message):
            evaluate(tmp_path, chosen, trained, folders)
    assert not (tmp_path / "rows.csv").exists()
