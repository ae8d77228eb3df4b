from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import torch
from tiny_parts import TINY, every, labelled, tiny_parts, tiny_segmentation
from torch.nn import functional

from morphoskel.learning.segmentation_phase import SegmentationPhase, only_labelled, thinned
from morphoskel.networks.part_segmentation import predict_parts
from morphoskel.networks.pointnet_classifier import transform_penalty

CLOUDS = tiny_parts(shapes=4, repeated=6)
SPARSE = labelled(CLOUDS, every(5, CLOUDS))


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def a_phase(training=SPARSE, **changes):
    """Return a phase whose network has no dropout unless told otherwise, so that losses can be compared."""
    network = tiny_segmentation(replace(TINY, **{"dropout": 0.0, **changes})).train()
    return SegmentationPhase(network, training, SPARSE, 0)


def with_other_parts(clouds, where):
    """Return clouds whose points have other parts at those places."""
    return clouds._replace(parts=torch.where(where, (clouds.parts + 1) % 5, clouds.parts))


@pytest.mark.parametrize("training_input", ["all", "labelled"])
@torch.no_grad()
def test_no_loss_depends_on_labels_that_are_not_told(training_input):
    phase = a_phase(training_input=training_input)
    labels = SPARSE.labelled[:, 0]
    for loss in (phase.loss, phase.validation_loss):
        expected = float(loss(SPARSE))
        assert float(loss(with_other_parts(SPARSE, ~labels))) == expected
        assert float(loss(with_other_parts(SPARSE, labels))) != pytest.approx(expected, rel=1e-3)
        one = torch.zeros_like(labels)
        one[2, 10] = True  # one labelled point is enough to notice
        assert float(loss(with_other_parts(SPARSE, one))) != pytest.approx(expected, rel=1e-4)


@torch.no_grad()
def test_the_loss_is_the_mean_over_labelled_points_and_the_penalty():
    phase = a_phase(penalty=0.3)
    segmented = phase.network(SPARSE.points, SPARSE.categories)
    found = []
    for cloud, point in SPARSE.labelled[:, 0].nonzero().tolist():
        logits = segmented.logits[cloud, point]
        found.append(float(logits.logsumexp(0) - logits[SPARSE.parts[cloud, point]]))
    assert len(found) == 4 * 7
    expected = np.mean(found) + 0.3 * float(transform_penalty(segmented.feature_transform))
    assert float(phase.loss(SPARSE)) == pytest.approx(expected, rel=1e-5)


@torch.no_grad()
def test_repeated_points_count_in_no_loss_even_if_they_are_marked():
    phase = a_phase()
    marked = labelled(CLOUDS, every(5, CLOUDS) | (CLOUDS.parts < 0))
    assert marked.labelled.sum() > SPARSE.labelled.sum()
    assert float(phase.loss(marked)) == float(phase.loss(SPARSE))
    assert float(phase.validation_loss(marked)) == float(phase.validation_loss(SPARSE))


@torch.no_grad()
def test_the_validation_loss_does_not_depend_on_the_batches():
    """Clouds with many labelled points count no more than those with few."""
    phase = a_phase().eval()
    mask = every(5, CLOUDS).copy()
    mask[1] = CLOUDS.parts[1] >= 0
    batch = labelled(CLOUDS, mask)
    losses = [float(phase.validation_loss([tensor[cloud : cloud + 1] for tensor in batch])) for cloud in range(4)]
    assert float(phase.validation_loss(batch)) == pytest.approx(np.mean(losses), rel=1e-5)
    logits = phase.network(batch.points, batch.categories).logits[1, :34]
    assert losses[1] == pytest.approx(float(functional.cross_entropy(logits, batch.parts[1, :34])), rel=1e-5)


@torch.no_grad()
def test_the_sets_of_labels_take_turns():
    masks = [every(4, CLOUDS, start) for start in range(3)]
    phase = a_phase()
    expected = [float(phase.loss(labelled(CLOUDS, mask))) for mask in masks]
    assert len({round(value, 4) for value in expected}) == 3
    batch, found = labelled(CLOUDS, *masks), []
    for epoch in range(5):
        phase._trainer = SimpleNamespace(current_epoch=epoch)
        found.append(float(phase.loss(batch)))
    assert found == [expected[epoch % 3] for epoch in range(5)]
    of_first = float(phase.validation_loss(labelled(CLOUDS, masks[0])))
    assert float(phase.validation_loss(batch)) == of_first  # epochs must be compared by the same labels


def seen_by(phase, method, batch):
    seen = []
    handle = phase.network.register_forward_pre_hook(lambda network, inputs: seen.append(inputs[0]))
    method(batch)
    handle.remove()
    return seen[0]


@torch.no_grad()
def test_all_points_enter_the_network_or_the_labelled_ones_alone():
    phase = a_phase(training_input="labelled")
    assert torch.equal(seen_by(phase, phase.validation_loss, SPARSE), SPARSE.points)
    assert torch.equal(seen_by(phase, phase.loss, SPARSE), SPARSE.points[:, :34:5])
    phase = a_phase()
    assert torch.equal(seen_by(phase, phase.loss, SPARSE), SPARSE.points)  # neither turned, scaled nor moved


def a_batch(labels, points=40):
    """Return points that are their own numbers, and targets of which so many in each cloud are known."""
    targets = torch.full((len(labels), points), -1)
    for cloud, count in enumerate(labels):
        targets[cloud, torch.randperm(points)[:count]] = torch.randint(9, (count,))
    return torch.arange(1.0 * targets.numel()).view(*targets.shape, 1).expand(-1, -1, 3), targets


@pytest.mark.parametrize("count", [1, 4, 10, 13, 39])
def test_thinned_clouds_have_one_half_of_labelled_points_where_there_are_so_many(count):
    labels = [1, 2, 3, 10, 40]
    points, targets = a_batch(labels)
    taken, of_taken = thinned(points, targets, count)
    places = taken[..., 0].long()
    assert taken.shape == (5, count, 3)
    assert torch.equal(of_taken, targets.flatten()[places])  # each point keeps its label
    assert torch.equal(places // 40, torch.arange(5)[:, None].expand(-1, count))  # of its own cloud
    assert all(len(set(row)) == count for row in places.tolist())
    found = (of_taken >= 0).sum(dim=1)
    assert all(found >= torch.tensor(labels).clamp(max=-(-count // 2)))
    assert found[-1] == count


def test_thinning_takes_labelled_points_equally_often_and_others_too():
    points, targets = a_batch([8], points=20)
    repeated = 20000
    taken, _ = thinned(points.expand(repeated, -1, -1), targets.expand(repeated, -1), 8)
    shares = torch.bincount(taken[..., 0].flatten().long(), minlength=20).double() / repeated
    # Six of eight labelled points for sure, then two of the fourteen points that are left.
    expected = torch.where(targets[0] >= 0, 6 / 8 + 2 / 8 * 2 / 14, 2 / 14)
    assert (shares - expected).abs().max() < 5 * (0.25 / repeated) ** 0.5


@torch.no_grad()
def test_thinned_clouds_enter_the_network_in_training_and_validation():
    phase = a_phase(training_points=9)
    for method in (phase.loss, phase.validation_loss):
        assert seen_by(phase, method, SPARSE).shape == (4, 9, 3)
    phase = a_phase(training_points=1000)
    assert torch.equal(seen_by(phase, phase.loss, SPARSE), SPARSE.points)


def test_clouds_with_fewer_labelled_points_repeat_theirs():
    targets = torch.tensor([[-1, 3, -1, 4, -1, 1], [-1, -1, 2, -1, -1, -1], [0, -1, -1, -1, -1, 2]])
    points = torch.arange(18.0).view(3, 6, 1).expand(-1, -1, 3)
    taken, of_taken = only_labelled(points, targets)
    assert taken[..., 0].tolist() == [[1, 3, 5], [8, 8, 8], [12, 17, 12]]
    assert of_taken.tolist() == [[3, 4, 1], [2, -1, -1], [0, 2, -1]]


@torch.no_grad()
def test_the_repetitions_count_neither_in_the_loss_nor_in_the_maximum():
    """In evaluation mode, where the statistics of the batch play no part, each cloud may stand alone."""
    phase = a_phase(training_input="labelled", penalty=0.0)
    phase.network.eval()
    mask = np.zeros_like(SPARSE.labelled[:, 0].numpy())
    for cloud, count in enumerate((1, 7, 4, 20)):
        mask[cloud, :count] = True
    batch = labelled(CLOUDS, mask)
    sums = [
        count * float(phase.loss([tensor[cloud : cloud + 1] for tensor in batch]))
        for cloud, count in enumerate((1, 7, 4, 20))
    ]
    assert float(phase.loss(batch)) == pytest.approx(sum(sums) / 32, rel=1e-5)


def test_the_rates_fall_to_the_lowest():
    phase = a_phase(learning_rate=0.02, decay=0.5, decay_epochs=2, lowest_learning_rate=0.004)
    configured = phase.configure_optimizers()
    optimiser, schedule = configured["optimizer"], configured["lr_scheduler"]
    rates = []
    for _ in range(9):
        rates.append(optimiser.param_groups[0]["lr"])
        optimiser.step()
        schedule.step()
    assert rates == pytest.approx([0.02, 0.02, 0.01, 0.01, 0.005, 0.005, 0.004, 0.004, 0.004])
    assert isinstance(optimiser, torch.optim.Adam)
    assert sum(len(group["params"]) for group in optimiser.param_groups) == len(list(phase.network.parameters()))


@pytest.mark.parametrize("training_input", ["all", "labelled"])
def test_it_learns_parts_from_few_labels(training_input):
    clouds = tiny_parts(shapes=64)
    batch = labelled(clouds, every(5, clouds))
    phase = a_phase(batch, training_input=training_input)
    for module in phase.network.modules():
        if isinstance(module, torch.nn.BatchNorm1d):
            module.momentum = 0.5  # so few steps do not carry the running statistics to where the weights are
    optimiser = phase.configure_optimizers()["optimizer"]
    for _ in range(80):
        optimiser.zero_grad()
        phase.loss(batch).backward()
        optimiser.step()
    test = tiny_parts(shapes=10, seed=2)
    predicted = predict_parts(phase.network.eval(), test.points, test.labels)
    assert np.mean(predicted == test.parts) >= 0.9
