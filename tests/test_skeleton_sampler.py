import pytest
import torch
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.errors import ConfigError, InputError
from morphoskel.networks.skeleton_sampler import SkeletonSampler, load_skeleton_sampler, save_skeleton_sampler


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture
def network():
    with torch.random.fork_rng():
        torch.manual_seed(0)
        return SkeletonSampler(5, TINY_SAMPLER)


@pytest.fixture(scope="module")
def points():
    return torch.rand(3, 40, 3, generator=torch.Generator().manual_seed(0)) - 0.5


@torch.no_grad()
def test_logits_are_features_times_prior_times_the_rows_of_the_last_layer(network, points):
    network.eval()
    weights = torch.rand(3, 40)
    logits = network(points, weights)
    assert logits.shape == (3, 5, 40)
    features = network.features(points)
    assert features.shape == (3, 40, 8)
    for sample in range(5):
        for point in (0, 7, 39):
            naive = features[1, point] * weights[1, point] @ network.linear.weight[sample]
            torch.testing.assert_close(logits[1, sample, point], naive)


@torch.no_grad()
def test_a_point_without_weight_is_left_to_chance(network, points):
    """Its logit is 0; and twice the weights are twice the logits, since the prior scales features and nothing else."""
    network.eval()
    weights = torch.ones(3, 40)
    weights[:, 3] = 0
    logits = network(points, weights)
    assert torch.equal(logits[:, :, 3], torch.zeros(3, 5))
    torch.testing.assert_close(network(points, 2 * weights), 2 * logits)


def test_dropout_acts_in_training_only(network, points):
    weights = torch.ones(3, 40)
    for training in (True, False):
        network.train(training)
        assert torch.equal(network(points, weights), network(points, weights)) is not training


@torch.no_grad()
def test_a_network_survives_its_file(network, points, tmp_path):
    network(points, torch.ones(3, 40))  # moves the running statistics away from where they start
    save_skeleton_sampler(network, tmp_path / "network.pt")
    loaded = load_skeleton_sampler(tmp_path / "network.pt")
    assert (loaded.samples, loaded.settings, loaded.training) == (5, TINY_SAMPLER, False)
    assert [path.name for path in tmp_path.iterdir()] == ["network.pt"]
    weights = torch.rand(3, 40)
    assert torch.equal(loaded(points, weights), network.eval()(points, weights))


def test_a_file_that_is_no_network_is_refused(network, tmp_path):
    with pytest.raises(InputError, match="no trained skeleton-aware sampler there"):
        load_skeleton_sampler(tmp_path / "none.pt")
    (tmp_path / "noise.pt").write_bytes(b"noise")
    settings, weights = TINY_SAMPLER.as_mapping(), network.state_dict()
    torch.save({"samples": 6, "settings": settings, "weights": weights}, tmp_path / "size.pt")
    torch.save({"samples": 5, "settings": settings | {"bins": 6}, "weights": weights}, tmp_path / "newer.pt")
    torch.save({"settings": settings, "weights": weights}, tmp_path / "other.pt")
    torch.save([1, 2], tmp_path / "list.pt")
    for name in ("noise.pt", "size.pt", "newer.pt", "other.pt", "list.pt"):
        with pytest.raises(InputError, match="not a skeleton-aware sampler of this version"):
            load_skeleton_sampler(tmp_path / name)


def test_no_samples_are_refused():
    with pytest.raises(ConfigError, match="samples: expected at least 1"):
        SkeletonSampler(0, TINY_SAMPLER)
