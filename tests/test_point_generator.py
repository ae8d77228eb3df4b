from dataclasses import replace

import pytest
import torch
from tiny_generator import TINY

from morphoskel.errors import InputError
from morphoskel.networks.point_generator import PointGenerator, generate, load_generator, save_generator


@pytest.fixture
def points():
    return torch.randn(5, 40, 3, generator=torch.Generator().manual_seed(0))


def network_of(settings=TINY, samples=6):
    torch.manual_seed(0)
    return PointGenerator(samples, settings)


@pytest.mark.parametrize("normalise", [True, False])
def test_every_cloud_gets_its_points(points, normalise):
    network = network_of(replace(TINY, normalise_output=normalise))
    generated = network(points)
    assert generated.shape == (5, 6, 3)
    assert generated.dtype == torch.float32
    spread = generated.std(dim=0, unbiased=False)
    assert torch.allclose(spread, torch.ones(6, 3), atol=0.01) == normalise  # over the batch, coordinate by coordinate


def test_the_published_network_has_the_published_size():
    """Counted by hand: weights, and two numbers for every normalised channel."""
    published = replace(TINY, point_channels=(64, 64, 64, 128, 128), head_channels=(256, 256, 256), neighbours=0)
    point_layers = 3 * 64 + 64 * 64 * 2 + 64 * 128 + 128 * 128 + 2 * (64 * 3 + 128 * 2)
    head = 128 * 256 + 256 * 256 * 2 + 2 * 256 * 3
    counts = {
        normalise: sum(
            parameter.numel()
            for parameter in PointGenerator(32, replace(published, normalise_output=normalise)).parameters()
        )
        for normalise in (True, False)
    }
    assert counts == {True: point_layers + head + 256 * 96 + 2 * 96, False: point_layers + head + 256 * 96 + 96}


def test_the_order_of_the_points_and_repetitions_do_not_matter(points):
    network = network_of().eval()
    shuffled = points[:, torch.randperm(40, generator=torch.Generator().manual_seed(1))]
    repeated = torch.cat([points, points[:, :7]], dim=1)
    torch.testing.assert_close(network(shuffled), network(points))
    torch.testing.assert_close(network(repeated), network(points))


def test_generating_does_not_depend_on_the_batches_and_keeps_the_mode(points):
    network = network_of().train()
    network(points)
    at_once = generate(network, points, 5)
    assert network.training
    assert not at_once.requires_grad
    torch.testing.assert_close(generate(network, points, 2), at_once)
    torch.testing.assert_close(network.eval()(points), at_once)


def test_a_generator_survives_its_file(points, tmp_path):
    network = network_of().train()
    network(points)
    torch.nn.init.constant_(network.projection.temperature, 0.25)
    save_generator(network, tmp_path / "network.pt")
    loaded = load_generator(tmp_path / "network.pt")
    assert [path.name for path in tmp_path.iterdir()] == ["network.pt"]
    assert (loaded.samples, loaded.settings, loaded.training) == (6, TINY, False)
    assert float(loaded.projection.temperature.detach()) == 0.25
    assert torch.equal(loaded(points), generate(network, points, 5))


def test_a_generator_without_projection_survives_its_file(tmp_path):
    network = network_of(replace(TINY, neighbours=0))
    assert network.projection is None
    save_generator(network, tmp_path / "network.pt")
    assert load_generator(tmp_path / "network.pt").projection is None


def test_a_file_that_is_no_generator_is_refused(tmp_path):
    with pytest.raises(InputError, match="no trained generator of points there"):
        load_generator(tmp_path / "none.pt")
    settings, weights = TINY.as_mapping(), network_of().state_dict()
    (tmp_path / "noise.pt").write_bytes(b"noise")
    torch.save({"samples": 7, "settings": settings, "weights": weights}, tmp_path / "other.pt")
    torch.save({"samples": 6, "settings": settings | {"alpha": -1.0}, "weights": weights}, tmp_path / "broken.pt")
    torch.save({"samples": 6, "settings": settings | {"beta": 1.0}, "weights": weights}, tmp_path / "newer.pt")
    torch.save([1, 2], tmp_path / "list.pt")
    for name in ("noise.pt", "other.pt", "broken.pt", "newer.pt", "list.pt"):
        with pytest.raises(InputError, match="not a generator of points of this version"):
            load_generator(tmp_path / name)
