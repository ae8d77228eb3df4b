import numpy as np
import pytest
import torch

from morphoskel.networks.pointnet2 import BallFeatures, PointNet2Encoder, ball_query, farthest_points, gather_rows


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def clouds(batch, points, seed=0):
    return torch.rand(batch, points, 3, generator=torch.Generator().manual_seed(seed)) * 2 - 1


def farthest_points_naive(points, count):
    chosen = [0]
    while len(chosen) < count:
        distances = [min(float(((point - points[i]) ** 2).sum()) for i in chosen) for point in points]
        chosen.append(int(np.argmax(distances)))
    return chosen


def ball_query_naive(points, centres, radius, neighbours):
    rows = []
    for centre in centres:
        distances = np.linalg.norm(points - centre, axis=1)
        inside = [i for i, distance in enumerate(distances) if distance <= radius] or [int(distances.argmin())]
        rows.append((inside + inside[:1] * neighbours)[:neighbours])
    return rows


def test_farthest_points_equal_the_definition():
    points = clouds(2, 30)
    chosen = farthest_points(points, 12)
    for cloud, row in zip(points.numpy(), chosen, strict=True):
        assert row.tolist() == farthest_points_naive(cloud, 12)


def test_the_farthest_points_of_a_prefix_are_its_first_points():
    """The encoder samples all its levels at once because of this."""
    points = clouds(3, 200)
    prefix = gather_rows(points, farthest_points(points, 60))
    torch.testing.assert_close(farthest_points(prefix, 25), torch.arange(25).expand(3, -1))


def test_farthest_points_refuse_more_points_than_there_are():
    assert sorted(farthest_points(clouds(1, 5), 5)[0].tolist()) == [0, 1, 2, 3, 4]
    for count in (0, 6):
        with pytest.raises(ValueError, match="count: expected 1 to 5"):
            farthest_points(clouds(1, 5), count)


@pytest.mark.parametrize(("radius", "neighbours"), [(0.3, 4), (0.7, 16), (3.0, 8), (0.7, 50)])
def test_ball_query_equals_the_definition(radius, neighbours):
    points, centres = clouds(2, 40), clouds(2, 7, seed=1)
    found = ball_query(torch.cdist(centres, points), radius, neighbours)
    for cloud, own, rows in zip(points.numpy(), centres.numpy(), found, strict=True):
        assert rows.tolist() == ball_query_naive(cloud, own, radius, neighbours)


def test_an_empty_ball_holds_the_nearest_point():
    distances = torch.tensor([[[1.6, 0.6, 0.4]]])
    assert ball_query(distances, 0.1, 3).tolist() == [[[2, 2, 2]]]
    assert ball_query(distances, 0.6, 3).tolist() == [[[1, 2, 1]]]


def test_gathered_rows_pass_their_gradients_back():
    values = clouds(2, 4).requires_grad_()
    indices = torch.tensor([[[0, 0], [3, 1]], [[2, 2], [2, 0]]])
    gathered = gather_rows(values, indices)
    torch.testing.assert_close(gathered, torch.stack([values[b][indices[b]] for b in range(2)]))
    gathered.sum().backward()
    assert values.grad[..., 0].tolist() == [[2, 1, 0, 1], [1, 0, 3, 0]]


def test_layers_on_points_and_centres_equal_layers_on_pairs():
    """The first layer is applied before the pairs are formed; values and gradients are those of the plain way."""
    torch.manual_seed(0)
    layers = BallFeatures(5, (8, 6)).double()
    points, features, centres = clouds(2, 20).double(), torch.rand(2, 20, 5).double(), clouds(2, 4, seed=2).double()
    neighbours = ball_query(torch.cdist(centres, points), 0.9, 6)

    def naive():
        offsets = gather_rows(points, neighbours) - centres[:, :, None]
        values = torch.cat([offsets, gather_rows(features, neighbours)], dim=-1).flatten(0, 2)
        for linear, normalise in zip(layers.linear, layers.normalise, strict=True):
            values = normalise(linear(values)).relu()
        return values.view(2, 4, 6, -1).amax(dim=2)

    results = []
    for compute in (naive, lambda: layers(points, features, centres, neighbours)):
        layers.zero_grad()
        output = compute()
        (output**2).sum().backward()
        results.append([output, *(parameter.grad.clone() for parameter in layers.parameters())])
    for plain, fast in zip(*results, strict=True):
        torch.testing.assert_close(fast, plain)
    assert results[0][0].abs().sum() > 0


@pytest.fixture
def encoder():
    torch.manual_seed(0)
    return PointNet2Encoder(
        (16, 8, 8), ((0.4, 0.8), (0.8,), (1.2,)), ((4, 8), (8,), (8,)), ((4, 8), (8, 16), (16,))
    ).eval()


def test_the_encoder_describes_input_points(encoder):
    points = clouds(2, 50)
    positions, features = encoder(points)
    assert positions.shape == (2, 8, 3)
    assert features.shape == (2, 8, encoder.features) == (2, 8, 16)
    torch.testing.assert_close(positions, gather_rows(points, farthest_points(points, 8)), rtol=0, atol=0)


def test_the_encoder_does_not_mix_clouds_and_ignores_translation(encoder):
    points = clouds(3, 50)
    _, together = encoder(points)
    _, alone = encoder(points[1:2])
    torch.testing.assert_close(together[1:2], alone, rtol=1e-4, atol=1e-6)
    _, moved = encoder(points + torch.tensor([0.5, -0.25, 1.0]))
    torch.testing.assert_close(moved, together, rtol=1e-3, atol=1e-4)
