from dataclasses import replace

import pytest
import torch
from tiny_classifier import NAMES, TINY, balls_and_lines

from morphoskel.errors import InputError
from morphoskel.networks.pointnet_classifier import (
    PointNetClassifier,
    load_classifier,
    save_classifier,
    transform_penalty,
)


@pytest.fixture(scope="module")
def network():
    """Return a network with running statistics, in evaluation mode."""
    torch.manual_seed(0)
    network = PointNetClassifier(2, TINY)
    network(balls_and_lines(8)[0])
    return network.eval()


def same(first, second):
    for name in ("log_probabilities", "descriptor", "feature_transform"):
        torch.testing.assert_close(getattr(first, name), getattr(second, name), atol=1e-4, rtol=1e-4)


@torch.no_grad()
def test_the_outputs_have_their_shapes_and_ranges(network):
    for points in (1, 5, 40):
        classified = network(balls_and_lines(3, points)[0])
        assert classified.log_probabilities.shape == (3, 2)
        torch.testing.assert_close(classified.log_probabilities.exp().sum(dim=1), torch.ones(3))
        assert classified.descriptor.shape == (3, 256)
        assert classified.descriptor.min() == 0 < classified.descriptor.max()
        assert classified.feature_transform.shape == (3, 64, 64)


@torch.no_grad()
def test_the_descriptor_is_what_the_last_layer_sees(network):
    classified = network(balls_and_lines(3)[0])
    scores = network.classify(classified.descriptor)
    torch.testing.assert_close(classified.log_probabilities, scores.log_softmax(dim=1))


@torch.no_grad()
def test_neither_order_nor_repetition_of_points_matters(network):
    points = balls_and_lines(3, 40)[0]
    expected = network(points)
    same(network(points[:, torch.randperm(40, generator=torch.Generator().manual_seed(0))]), expected)
    same(network(torch.cat([points, points[:, 5:20], points[:, :1].expand(-1, 30, -1)], dim=1)), expected)
    fewer = network(points[:, :10])
    assert not torch.allclose(fewer.descriptor, expected.descriptor, atol=1e-2)


def test_a_frozen_network_passes_the_gradient_to_the_points_alone(network):
    """The gradient agrees with a finite difference, for few points and for many."""
    frozen = PointNetClassifier(2, TINY).eval().requires_grad_(False).double()
    frozen.load_state_dict(network.state_dict())
    for count in (10, 100):
        points = balls_and_lines(2, count)[0].double().requires_grad_()
        default = torch.get_default_dtype()
        (gradient,) = torch.autograd.grad(frozen(points).log_probabilities[:, 0].sum(), points)
        assert torch.get_default_dtype() == default
        direction = torch.randn(points.shape, dtype=points.dtype, generator=torch.Generator().manual_seed(1))
        with torch.no_grad():
            ahead, behind = (frozen(points + step * direction).log_probabilities[:, 0].sum() for step in (1e-6, -1e-6))
        assert float((gradient * direction).sum()) == pytest.approx(float(ahead - behind) / 2e-6, rel=1e-3)
    assert all(parameter.grad is None for parameter in frozen.parameters())


def test_the_penalty_is_the_distance_from_orthogonality():
    rotation, _ = torch.linalg.qr(torch.randn(4, 6, 6, generator=torch.Generator().manual_seed(0)))
    assert transform_penalty(rotation) == pytest.approx(0, abs=1e-5)
    assert transform_penalty(2 * torch.eye(4).expand(3, 4, 4)) == pytest.approx(3 * 4**0.5)
    both = torch.stack([torch.eye(4), torch.zeros(4, 4)])
    assert transform_penalty(both) == pytest.approx((0 + 4**0.5) / 2)
    identity = torch.eye(4).expand(1, 4, 4).clone().requires_grad_()
    transform_penalty(identity).backward()
    assert torch.isfinite(identity.grad).all()


@torch.no_grad()
def test_a_saved_network_is_read_as_it_was(network, tmp_path):
    save_classifier(network, NAMES, tmp_path / "network.pt")
    read = load_classifier(tmp_path / "network.pt")
    assert not read.training
    assert read.class_names == NAMES
    assert read.settings == TINY
    points = balls_and_lines(3)[0]
    assert torch.equal(read(points).log_probabilities, network(points).log_probabilities)


def test_wrong_files_and_names_are_refused(network, tmp_path):
    with pytest.raises(InputError, match="a name for each of the 2 classes, got 1"):
        save_classifier(network, ["ball"], tmp_path / "network.pt")
    with pytest.raises(InputError, match="train one first"):
        load_classifier(tmp_path / "network.pt")
    (tmp_path / "text.pt").write_text("no network")
    with pytest.raises(InputError, match="not a classifier of this version"):
        load_classifier(tmp_path / "text.pt")
    torch.save({"settings": {"epochs": 1}, "class_names": [], "weights": {}}, tmp_path / "other.pt")
    with pytest.raises(InputError, match="not a classifier of this version"):
        load_classifier(tmp_path / "other.pt")
    content = {"settings": replace(TINY).as_mapping(), "class_names": ["one"], "weights": network.state_dict()}
    torch.save(content, tmp_path / "sizes.pt")
    with pytest.raises(InputError, match="not a classifier of this version"):
        load_classifier(tmp_path / "sizes.pt")
