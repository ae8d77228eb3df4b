import pytest
import torch
from torch import nn

from morphoskel.networks import normalised_linear
from morphoskel.networks.normalised_linear import Moments, NormalisedLinear, PooledLinear, pooled, strongest_points


def layers_in_turn(layer):
    """Return the same layer as torch has it."""
    twin = nn.Sequential(layer.linear, nn.BatchNorm1d(layer.normalise.num_features)).double()
    twin[1].load_state_dict(layer.normalise.state_dict())
    return twin


def a_layer(kind, inputs=5, outputs=40):
    torch.manual_seed(0)
    layer = kind(inputs, outputs).double()
    with torch.no_grad():
        layer.normalise.weight.normal_()  # of both signs
        layer.normalise.bias.normal_()
        layer.normalise.running_mean.normal_()
        layer.normalise.running_var.uniform_(0.5, 2)
    return layer


def assert_same_gradients(layer, twin, values, result, expected):
    direction = torch.randn_like(result)
    for output in (result, expected):
        output.backward(direction)
    ours, theirs = (each.grad for each in values)
    torch.testing.assert_close(ours, theirs)
    for ours, theirs in zip(layer.normalise.parameters(), twin[1].parameters(), strict=True):
        torch.testing.assert_close(ours.grad, theirs.grad)


@pytest.mark.parametrize("training", [True, False])
def test_a_fused_layer_is_the_two_layers_in_turn(training):
    layer = a_layer(NormalisedLinear).train(training)
    twin = layers_in_turn(layer).train(training)
    values = [(3 + torch.randn(4, 6, 5, dtype=torch.float64, generator=torch.Generator().manual_seed(1))) for _ in "ab"]
    for each in values:
        each.requires_grad_()
    result, expected = layer(values[0]), twin(values[1].flatten(0, 1)).view(4, 6, -1)
    torch.testing.assert_close(result, expected)
    assert_same_gradients(layer, twin, values, result, expected)
    for name, buffer in twin[1].named_buffers():
        torch.testing.assert_close(layer.normalise.get_buffer(name), buffer)


def test_the_gradient_of_the_weight_passes_through_the_statistics():
    layer = a_layer(NormalisedLinear)
    values = torch.randn(30, 5, dtype=torch.float64)
    direction = torch.randn(30, 40, dtype=torch.float64)
    (ours,) = torch.autograd.grad((layer(values) * direction).sum(), layer.linear.weight)
    (theirs,) = torch.autograd.grad((layers_in_turn(layer)(values) * direction).sum(), layer.linear.weight)
    torch.testing.assert_close(ours, theirs)


@pytest.mark.parametrize("training", [True, False])
@pytest.mark.parametrize("points", [1, 7, 33, 40, 100])
def test_a_pooled_layer_is_the_maximum_of_the_layer(points, training):
    layer = a_layer(PooledLinear).train(training)
    twin = layers_in_turn(layer).train(training)
    values = [torch.randn(4, points, 5, dtype=torch.float64, generator=torch.Generator().manual_seed(1)) for _ in "ab"]
    for each in values:
        each.requires_grad_()
    result = layer(values[0])
    expected = twin(values[1].flatten(0, 1)).view(4, points, -1).max(dim=1).values
    torch.testing.assert_close(result, expected)
    with torch.no_grad():
        evaluated, without_gradients = layer.eval()(values[0]), twin.eval()(values[1].flatten(0, 1))
    torch.testing.assert_close(evaluated, without_gradients.view(4, points, -1).max(dim=1).values)
    assert_same_gradients(layer, twin, values, result, expected)


def test_the_strongest_points_are_those_of_arg_max(monkeypatch):
    generator = torch.Generator().manual_seed(0)
    for points in (1, 8, 9, 100):
        values, weight = torch.randn(5, points, 3, generator=generator), torch.randn(6, 3, generator=generator)
        expected = (values @ weight.t()).argmax(dim=1)
        for chunk in (1, 2 * 6 * points, 1 << 20):
            monkeypatch.setattr(normalised_linear, "CHUNK", chunk)
            assert torch.equal(strongest_points(values, weight), expected)


@pytest.mark.parametrize("points", [1, 7, 8, 33, 100])
def test_pooled_features_are_the_maximum_and_have_its_gradient(points):
    values = torch.randn(4, points, 5, dtype=torch.float64, generator=torch.Generator().manual_seed(1))
    direction = torch.randn(4, 5, dtype=torch.float64)
    assert torch.equal(pooled(values), values.amax(dim=1))
    values.requires_grad_()
    assert torch.equal(pooled(values), values.amax(dim=1))
    (ours,) = torch.autograd.grad(pooled(values), values, direction)
    (theirs,) = torch.autograd.grad(values.amax(dim=1), values, direction)
    assert torch.equal(ours, theirs)


def test_one_of_equally_strong_points_has_the_whole_gradient():
    values = torch.tensor([[[1.0], [3.0], [3.0], [2.0]]], requires_grad=True)
    (gradient,) = torch.autograd.grad(pooled(values).sum(), values)
    assert sorted(gradient.flatten().tolist()) == [0, 0, 0, 1]
    assert gradient[0, 1:3].sum() == 1


def test_the_gradient_of_the_moments_is_that_of_finite_differences():
    values = torch.randn(6, 3, dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(Moments.apply, values)


def test_a_constant_input_is_mapped_to_the_bias():
    layer = a_layer(NormalisedLinear)
    constant = torch.ones(8, 5, dtype=torch.float64)
    torch.testing.assert_close(layer(constant), layer.normalise.bias.expand(8, -1), atol=1e-6, rtol=0)


def test_a_single_row_cannot_be_normalised_in_training():
    with pytest.raises(ValueError, match="more than 1 value"):
        a_layer(NormalisedLinear)(torch.ones(1, 5, dtype=torch.float64))
    assert a_layer(NormalisedLinear).eval()(torch.ones(1, 5, dtype=torch.float64)).shape == (1, 40)
