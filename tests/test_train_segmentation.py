import csv
import json
from dataclasses import replace

import numpy as np
import pytest
import torch
from tiny_parts import NAMES, PART_CLASSES, TINY, every, labelled, tiny_parts
from torch.nn import functional

from morphoskel.errors import ConfigError, InputError
from morphoskel.learning import resumable_fit as fitting
from morphoskel.learning.train_segmentation import train_segmentation
from morphoskel.networks.part_segmentation import load_segmentation, predict_parts


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


CLOUDS, HELD_OUT = tiny_parts(shapes=10, repeated=3), tiny_parts(shapes=5, points=30, seed=1)
TRAINING = labelled(CLOUDS, every(5, CLOUDS), every(4, CLOUDS, start=1))
VALIDATION = labelled(HELD_OUT, every(3, HELD_OUT))
ORIGIN = {"strategy": "fps", "ratio": 5, "number": 0}


def train(folder, seed=1, settings=TINY, training=TRAINING, part_classes=PART_CLASSES, origin=ORIGIN):
    return train_segmentation(
        training, VALIDATION, NAMES, part_classes, settings, folder, seed, origin=origin, accelerator="cpu",
        progress=False,
    )  # fmt: skip


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    return train(tmp_path_factory.mktemp("training"))


def weights(path):
    return torch.load(path, weights_only=True)["weights"]


def losses(folder):
    with (folder / "segmentation.csv").open(newline="") as file:
        return [row[:3] for row in csv.reader(file)][1:]


def test_a_training_writes_a_network_with_its_names_and_losses(trained):
    network = load_segmentation(trained)
    assert trained.name == "network.pt"
    assert (network.class_names, network.part_classes) == (NAMES, PART_CLASSES)
    assert (network.settings, network.origin) == (TINY, ORIGIN)
    assert [int(row[0]) for row in losses(trained.parent)] == list(range(TINY.epochs))


def test_the_network_of_the_best_epoch_gives_its_number_again(trained):
    network = load_segmentation(trained)
    points, categories, parts, sets = VALIDATION
    with torch.no_grad():
        logits = network(points, categories).logits
    entropy = float(functional.cross_entropy(logits[sets[:, 0]], parts[sets[:, 0]]))  # as many of each shape
    assert entropy == pytest.approx(min(float(row[2]) for row in losses(trained.parent)), rel=1e-4)
    legal = torch.tensor(PART_CLASSES) == categories[:, None]
    expected = logits.masked_fill(~legal[:, None], -torch.inf).argmax(dim=2)
    assert np.array_equal(predict_parts(network, HELD_OUT.points, HELD_OUT.labels, batch=2), expected.numpy())


@pytest.mark.parametrize("inputs", [{}, {"training_input": "labelled"}, {"training_points": 9}])
@pytest.mark.parametrize("killed_after", [(0, 1), (1, 0), (1, 1)])
def test_a_killed_training_goes_on_to_the_same_result(tmp_path, monkeypatch, killed_after, inputs):
    class KilledError(Exception):
        pass

    settings = replace(TINY, **inputs)
    whole = train(tmp_path / "whole", settings=settings)
    original = fitting.BatchedPhase.training_step

    def step(phase, batch, index):
        if (phase.current_epoch, index) == killed_after:
            raise KilledError
        return original(phase, batch, index)

    monkeypatch.setattr(fitting.BatchedPhase, "training_step", step)
    with pytest.raises(KilledError):
        train(tmp_path / "killed", settings=settings)
    monkeypatch.undo()
    first, second = weights(whole), weights(train(tmp_path / "killed", settings=settings))
    assert all(torch.equal(first[name], second[name]) for name in first)
    assert losses(tmp_path / "killed") == losses(tmp_path / "whole")


def test_the_same_seed_gives_the_same_network_and_another_seed_another(trained, tmp_path):
    state = torch.get_rng_state()
    again, other = weights(train(tmp_path / "again")), weights(train(tmp_path / "other", seed=2))
    assert torch.equal(torch.get_rng_state(), state)
    first = weights(trained)
    assert all(torch.equal(first[name], again[name]) for name in first)
    assert not torch.equal(first["head.classify.weight"], other["head.classify.weight"])


def test_labels_that_are_not_told_do_not_matter_and_every_set_does(trained, tmp_path):
    told = TRAINING.labelled.any(dim=1)
    legal = torch.tensor([0, 2])[TRAINING.categories][:, None]
    others = TRAINING._replace(parts=torch.where(told | (TRAINING.parts < 0), TRAINING.parts, legal))
    assert not torch.equal(others.parts, TRAINING.parts)
    first, same = weights(trained), weights(train(tmp_path / "same", training=others))
    assert all(torch.equal(first[name], same[name]) for name in first)
    one = TRAINING._replace(labelled=TRAINING.labelled[:, :1])
    rows, of_one = losses(trained.parent), losses(train(tmp_path / "one", training=one).parent)
    assert rows[0] == of_one[0]  # the first epoch is that of the first set
    assert rows[1] != of_one[1]


def test_a_folder_of_another_training_is_refused(trained):
    changes = [
        {"seed": 2},
        {"part_classes": (0, 0, 1, 1, 1, 1)},
        {"settings": replace(TINY, penalty=0.0)},
        {"origin": {}},
        {"training": TRAINING._replace(labelled=TRAINING.labelled.flip(1))},
    ]
    for change in changes:
        with pytest.raises(InputError, match="other settings, clouds or seed"):
            train(trained.parent, **change)
    assert json.loads((trained.parent / "training.json").read_text())["class_names"] == list(NAMES)
    written = trained.stat().st_mtime_ns
    assert train(trained.parent) == trained
    assert trained.stat().st_mtime_ns == written  # a finished training is not repeated


def without_labels(tensor, cloud):
    tensor = tensor.clone()
    tensor[cloud, 1] = False
    return tensor


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"points": TRAINING.points.double()}, "training clouds: expected float32"),
        ({"points": TRAINING.points[..., :2]}, "training clouds: expected float32"),
        ({"points": TRAINING.points[:1]}, "training clouds: expected at least 2, got 1"),
        ({"categories": TRAINING.categories[:9]}, r"training categories: expected int64 \(10,\)"),
        ({"categories": TRAINING.categories + 1}, "training categories: expected 0 to 1, got 1 to 2"),
        ({"parts": TRAINING.parts.int()}, r"training parts: expected int64 \(10, 40\)"),
        ({"parts": TRAINING.parts - 1}, "training parts: expected -1 to 4, got -2 to 3"),
        ({"parts": TRAINING.parts.flip(0)}, "point 0 of cloud 0 is of part 2, which is none of category ball"),
        ({"labelled": TRAINING.labelled.int()}, r"training labelled points: expected bool \(10, D, 40\)"),
        ({"labelled": TRAINING.labelled[:, 0]}, r"training labelled points: expected bool \(10, D, 40\)"),
        ({"labelled": TRAINING.labelled[:, :0]}, r"training labelled points: expected bool \(10, D, 40\)"),
        ({"labelled": without_labels(TRAINING.labelled, 7)}, "training labelled points: cloud 7 has none"),
        ({"labelled": (TRAINING.parts < 0)[:, None]}, "training labelled points: cloud 0 has none"),
    ],
)
def test_clouds_parts_and_labels_must_fit(tmp_path, change, message):
    with pytest.raises(InputError, match=message):
        train(tmp_path, training=TRAINING._replace(**change))
    assert not (tmp_path / "training.json").exists()


def test_every_category_needs_parts(tmp_path):
    with pytest.raises(ConfigError, match="part_classes"):
        train(tmp_path, part_classes=(0, 0, 0))
    assert not (tmp_path / "training.json").exists()
