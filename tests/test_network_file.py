import pytest
import torch

from morphoskel.errors import ConfigError, InputError, StorageError
from morphoskel.networks.network_file import read_network, write_network


def test_weights_and_values_come_back(tmp_path):
    layer = torch.nn.Linear(2, 3)
    write_network(layer, tmp_path / "network.pt", samples=4, names=["a", "b"])
    with read_network(tmp_path / "network.pt", "layer") as content:
        assert (content["samples"], content["names"]) == (4, ["a", "b"])
        other = torch.nn.Linear(2, 3)
        other.load_state_dict(content["weights"])
    assert torch.equal(other.weight, layer.weight)


def test_a_missing_or_broken_file_is_named(tmp_path):
    with pytest.raises(InputError, match="no trained layer there"), read_network(tmp_path / "absent.pt", "layer"):
        pass
    (tmp_path / "text.pt").write_text("no network")
    with pytest.raises(InputError, match="not a layer of this version"), read_network(tmp_path / "text.pt", "layer"):
        pass
    (tmp_path / "empty.pt").touch()
    with pytest.raises(StorageError, match=r"empty\.pt: is damaged"), read_network(tmp_path / "empty.pt", "layer"):
        pass


@pytest.mark.parametrize("error", [KeyError("samples"), RuntimeError("shapes differ"), ConfigError("k: too small")])
def test_what_fails_while_the_network_is_built_is_the_fault_of_the_file(tmp_path, error):
    write_network(torch.nn.Linear(2, 3), tmp_path / "network.pt")
    broken = pytest.raises(InputError, match=r"network\.pt: not a layer of this version")
    with broken, read_network(tmp_path / "network.pt", "layer"):
        raise error


def test_the_error_of_another_network_is_short_and_tells_its_first_difference(tmp_path):
    write_network(torch.nn.Identity(), tmp_path / "network.pt")
    layers = torch.nn.Sequential(*(torch.nn.Linear(2, 2) for _ in range(200)))
    with (
        pytest.raises(InputError, match=r"0\.weight") as raised,
        read_network(tmp_path / "network.pt", "net") as content,
    ):
        layers.load_state_dict(content["weights"])
    assert len(str(raised.value)) < 400 + len(str(tmp_path))
    assert str(raised.value).endswith("train it again")
