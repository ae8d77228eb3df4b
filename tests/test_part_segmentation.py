from dataclasses import replace

import numpy as np
import pytest
import torch
from tiny_parts import NAMES, PART_CLASSES, TINY, tiny_parts, tiny_segmentation
from torch.nn import functional

from morphoskel.errors import ConfigError, InputError
from morphoskel.networks.part_segmentation import (
    PartSegmentationNetwork,
    SegmentationHead,
    load_segmentation,
    predict_parts,
    save_segmentation,
)

CLOUDS = tiny_parts(shapes=3, seed=1)
POINTS, CATEGORIES = torch.from_numpy(CLOUDS.points), torch.from_numpy(CLOUDS.labels)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def network():
    return tiny_segmentation()


def naive_logits(network, points, categories):
    """Return the logits as the paper has them: torch's own layers, and all features of each point side by side."""

    def apply(layer, values):
        values = layer.linear(values)
        return functional.relu(layer.normalise(values.flatten(0, 1)).view_as(values))

    def transform(layers, values):
        for layer in (*layers.local, layers.pooled):
            values = apply(layer, values)
        values = values.max(dim=1).values
        for layer in layers.head:
            values = layer(values)
        return layers.matrix(values).view(-1, layers.inputs, layers.inputs) + torch.eye(layers.inputs)

    values, seen = points @ transform(network.point_transform, points), []
    for layer in network.before:
        values = apply(layer, values)
        seen.append(values)
    values = values @ transform(network.feature_transform, values)
    for layer in network.after:
        values = apply(layer, values)
        seen.append(values)
    cloud = [values.max(dim=1).values]
    if network.settings.know_category:
        cloud.append(torch.eye(len(NAMES), dtype=points.dtype)[categories])
    repeated = [features[:, None].expand(-1, points.shape[1], -1) for features in cloud]
    head = network.head
    values = head.first(torch.cat([*repeated, *seen], dim=2))
    values = head.dropout(functional.relu(head.normalise(values.flatten(0, 1)).view_as(values)))
    for number, layer in enumerate(head.layers, start=2):
        values = apply(layer, values)
        values = head.dropout(values) if number <= 2 else values
    return head.classify(values)


@pytest.mark.parametrize("know_category", [True, False])
@pytest.mark.parametrize("training", [True, False])
def test_the_network_is_its_naive_twin_in_values_and_gradients(training, know_category):
    found = {}
    for name, logits_of in (("fast", lambda *batch: batch[0](*batch[1:]).logits), ("naive", naive_logits)):
        network = tiny_segmentation(replace(TINY, know_category=know_category)).double().train(training)
        points = POINTS.double().requires_grad_()
        torch.manual_seed(3)  # of the dropout
        logits = logits_of(network, points, CATEGORIES)
        (logits * torch.linspace(-1, 2, logits.numel(), dtype=torch.float64).view_as(logits)).sum().backward()
        gradients = {key: value.grad for key, value in network.named_parameters()}
        buffers = {key: value for key, value in network.named_buffers() if not key.endswith("tracked")}
        found[name] = [logits.detach(), points.grad, *gradients.values(), *buffers.values()]
    assert len(found["fast"]) == len(found["naive"]) > 40
    for fast, naive in zip(found["fast"], found["naive"], strict=True):
        torch.testing.assert_close(fast, naive, atol=1e-8, rtol=1e-6)


def test_an_untrained_network_transforms_nothing():
    network = PartSegmentationNetwork((0, 0, 1, 1, 1), NAMES, TINY)
    for transform, inputs in ((network.point_transform, 3), (network.feature_transform, 8)):
        matrices = transform(torch.rand(4, 20, inputs))
        assert torch.equal(matrices, torch.eye(inputs).expand(4, -1, -1))


def test_the_features_of_the_points_are_never_side_by_side():
    """Autograd keeps no tensor with all channels of all points."""
    head = SegmentationHead(50, (3, 4), (8, 8), 0.2, 5)
    kept = []
    with torch.autograd.graph.saved_tensors_hooks(lambda tensor: kept.append(tensor.numel()) or tensor, lambda it: it):
        logits = head(torch.rand(2, 50), [torch.rand(2, 100, 3), torch.rand(2, 100, 4)])
    assert logits.shape == (2, 100, 5)
    assert 0 < max(kept) <= 2 * 100 * 8


@torch.no_grad()
def test_the_category_enters_only_if_it_is_to_be_known(network):
    assert not torch.allclose(network(POINTS, CATEGORIES).logits, network(POINTS, 1 - CATEGORIES).logits, atol=1e-3)
    blind = tiny_segmentation(replace(TINY, know_category=False))
    assert torch.equal(blind(POINTS, CATEGORIES).logits, blind(POINTS, 1 - CATEGORIES).logits)
    assert network.head.first.in_features - blind.head.first.in_features == len(NAMES)


@torch.no_grad()
def test_the_outputs_have_their_shapes_for_any_number_of_points(network):
    for points in (1, 2, 33, 100):
        segmented = network(torch.from_numpy(tiny_parts(3, 100).points[:, :points]), CATEGORIES)
        assert segmented.logits.shape == (3, points, len(PART_CLASSES))
        assert segmented.feature_transform.shape == (3, 8, 8)
        assert torch.isfinite(segmented.logits).all()


@torch.no_grad()
def test_the_logits_follow_the_points_in_their_order(network):
    order = torch.randperm(40, generator=torch.Generator().manual_seed(0))
    expected = network(POINTS, CATEGORIES).logits
    assert expected.std(dim=1).max() > 1e-2
    torch.testing.assert_close(network(POINTS[:, order], CATEGORIES).logits, expected[:, order], atol=1e-5, rtol=1e-4)


@torch.no_grad()
def test_repeated_points_leave_what_is_said_of_the_others(network):
    expected = network(POINTS, CATEGORIES).logits
    repeated = network(torch.cat([POINTS, POINTS[:, 3:20], POINTS[:, :1].expand(-1, 9, -1)], dim=1), CATEGORIES).logits
    torch.testing.assert_close(repeated[:, :40], expected, atol=1e-5, rtol=1e-4)
    torch.testing.assert_close(repeated[:, 40:57], expected[:, 3:20], atol=1e-5, rtol=1e-4)


@torch.no_grad()
def test_channels_are_dropped_after_the_first_two_layers_of_the_head():
    head = SegmentationHead(2, (3,), (64, 64, 64, 64), 0.5, 5)
    seen = []
    for layer in (*head.layers, head.classify):
        layer.register_forward_pre_hook(lambda layer, inputs: seen.append(float((inputs[0] == 0).double().mean())))
    head(torch.rand(4, 2), [torch.rand(4, 100, 3)])
    assert len(seen) == 4
    assert min(seen[:2]) > 0.65  # half of the channels are 0 after a ReLU, and half of the others are dropped
    assert max(seen[2:]) < 0.6
    head = SegmentationHead(2, (3,), (8,), 0.5, 5)
    assert head(torch.rand(4, 2), [torch.rand(4, 100, 3)]).shape == (4, 100, 5)


@pytest.mark.parametrize("restrict", [True, False])
def test_predictions_are_the_strongest_parts_of_the_category(restrict):
    network = tiny_segmentation(replace(TINY, restrict_to_category=restrict))
    with torch.no_grad():
        logits = network(POINTS, CATEGORIES).logits.numpy()
    for batch in (1, 2, 3):
        predicted = predict_parts(network, CLOUDS.points, CLOUDS.labels, batch)
        assert predicted.dtype == np.int64
        for cloud, category in enumerate(CLOUDS.labels):
            legal = [part for part, of in enumerate(PART_CLASSES) if of == category or not restrict]
            expected = [max(legal, key=lambda part, row=row: row[part]) for row in logits[cloud]]
            assert predicted[cloud].tolist() == expected
    of_category = np.array(PART_CLASSES)[predicted] == CLOUDS.labels[:, None]
    assert of_category.all() == restrict  # an untrained network confuses them
    assert predict_parts(network, CLOUDS.points[:0], CLOUDS.labels[:0]).shape == (0, 40)


def test_parts_are_not_told_in_training_mode():
    with pytest.raises(ValueError, match="evaluation mode"):
        predict_parts(tiny_segmentation().train(), CLOUDS.points, CLOUDS.labels)


def test_parts_and_categories_must_fit():
    assert PartSegmentationNetwork((-1, 0, 1, -1), NAMES, TINY).head.classify.out_features == 4
    for part_classes in ((), (0, 0), (0, 1, 2), (-1, 1)):
        with pytest.raises(ConfigError, match="part_classes: expected parts of each of the 2 categories ball, stick"):
            PartSegmentationNetwork(part_classes, NAMES, TINY)


def test_a_saved_network_is_read_as_it_was(network, tmp_path):
    network.origin = {"strategy": "fps", "ratio": 16, "number": 0}
    save_segmentation(network, tmp_path / "network.pt")
    read = load_segmentation(tmp_path / "network.pt")
    assert not read.training
    assert (read.class_names, read.part_classes, read.settings, read.origin) == (
        NAMES, PART_CLASSES, TINY, network.origin
    )  # fmt: skip
    with torch.no_grad():
        assert torch.equal(read(POINTS, CATEGORIES).logits, network(POINTS, CATEGORIES).logits)


def test_wrong_files_are_refused(network, tmp_path):
    with pytest.raises(InputError, match="no trained part segmentation there"):
        load_segmentation(tmp_path / "network.pt")
    save_segmentation(network, tmp_path / "network.pt")
    content = torch.load(tmp_path / "network.pt", weights_only=True)
    for change in ({"part_classes": [0, 1]}, {"class_names": ["ball"]}, {"settings": {"epochs": 1}}, {"weights": {}}):
        torch.save({**content, **change}, tmp_path / "other.pt")
        with pytest.raises(InputError, match="not a part segmentation of this version"):
            load_segmentation(tmp_path / "other.pt")
