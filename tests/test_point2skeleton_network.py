import pytest
import torch
from tiny_point2skeleton import TINY

from morphoskel.errors import InputError
from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork, load_point2skeleton, save_network


def test_a_network_survives_its_file(tmp_path):
    network = Point2SkeletonNetwork(TINY).train()
    save_network(network, tmp_path / "network.pt")
    loaded = load_point2skeleton(tmp_path / "network.pt")
    assert loaded.settings == TINY
    assert not loaded.training
    assert [path.name for path in tmp_path.iterdir()] == ["network.pt"]
    for name, value in network.state_dict().items():
        assert torch.equal(loaded.state_dict()[name], value)


def test_a_file_that_is_no_network_is_refused(tmp_path):
    with pytest.raises(InputError, match="no trained Point2Skeleton network there"):
        load_point2skeleton(tmp_path / "none.pt")
    (tmp_path / "noise.pt").write_bytes(b"noise")
    torch.save({"settings": TINY.as_mapping() | {"points": 100}, "weights": {}}, tmp_path / "other.pt")
    torch.save({"settings": TINY.as_mapping() | {"point": 100}, "weights": {}}, tmp_path / "newer.pt")
    torch.save([1, 2], tmp_path / "list.pt")
    for name in ("noise.pt", "other.pt", "newer.pt", "list.pt"):
        with pytest.raises(InputError, match="not a Point2Skeleton network"):
            load_point2skeleton(tmp_path / name)
