import torch
from torch import nn
from torch.nn import functional

from morphoskel.networks.pointnet import PointNetEncoder, TransformNetwork


def naive_layer(layer, values):
    """Apply a layer at the points as the convolution of width 1 that it stands for."""
    convolved = functional.conv1d(values.transpose(1, 2), layer.linear.weight[:, :, None])
    normalise = layer.normalise
    return functional.batch_norm(
        convolved, None, None, normalise.weight, normalise.bias, training=True, eps=normalise.eps
    ).transpose(1, 2)


def naive_transform(network, values):
    for layer in network.local:
        values = naive_layer(layer, values).relu()
    values = naive_layer(network.pooled, values).relu().max(dim=1).values
    for layer in network.head:
        values = layer(values)
    size = network.inputs
    return network.matrix(values).reshape(-1, size, size) + torch.eye(size)


def naive_encoder(encoder, points):
    values = torch.bmm(points, naive_transform(encoder.input_transform, points))
    (before,), (after,) = encoder.before, encoder.after
    values = naive_layer(before, values).relu()
    values = torch.bmm(values, naive_transform(encoder.feature_transform, values))
    return values, naive_layer(encoder.last, naive_layer(after, values).relu()).max(dim=1).values


def test_the_encoder_is_that_of_the_paper():
    torch.manual_seed(0)
    encoder, points = PointNetEncoder(), torch.randn(6, 40, 3)
    features = encoder(points)
    expected_points, expected_cloud = naive_encoder(encoder, points)
    torch.testing.assert_close(features.points, expected_points, atol=5e-4, rtol=1e-4)
    torch.testing.assert_close(features.cloud, expected_cloud, atol=5e-4, rtol=1e-4)
    assert (features.cloud < 0).any()  # no ReLU after the last layer
    assert [tuple(values.shape) for values in features.local] == [(6, 40, 64), (6, 40, 128)]
    assert features.points.shape == (6, 40, 64)
    assert features.feature_transform.shape == (6, 64, 64)
    assert features.input_transform.shape == (6, 3, 3)


def test_its_gradient_is_that_of_the_paper():
    torch.manual_seed(0)
    encoder, points = PointNetEncoder().double(), torch.randn(4, 40, 3, dtype=torch.float64)
    default = torch.get_default_dtype()
    torch.set_default_dtype(torch.float64)
    try:
        results = (encoder(points).cloud, naive_encoder(encoder, points)[1])
    finally:
        torch.set_default_dtype(default)
    direction = torch.randn_like(results[0])
    ours, theirs = (torch.autograd.grad(result, list(encoder.parameters()), direction) for result in results)
    for one, other in zip(ours, theirs, strict=True):
        torch.testing.assert_close(one, other, atol=1e-9, rtol=1e-6)


def test_the_encoder_of_the_part_segmentation_can_be_made():
    encoder = PointNetEncoder((8, 16, 16), (32,), 64)
    features = encoder(torch.randn(3, 10, 3))
    assert [values.shape[-1] for values in features.local] == [8, 16, 16, 32]
    assert features.feature_transform.shape == (3, 16, 16)
    assert features.cloud.shape == (3, 64)


def test_a_transform_starts_at_the_identity_plus_its_prediction():
    torch.manual_seed(0)
    network = TransformNetwork(3)
    nn.init.zeros_(network.matrix.weight)
    nn.init.zeros_(network.matrix.bias)
    assert torch.equal(network(torch.randn(2, 9, 3)), torch.eye(3).expand(2, 3, 3))
