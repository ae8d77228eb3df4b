"""The file of a network when it is damaged, or the disk is full."""

import os

import pytest
import torch
from faults_in_files import DAMAGE, mounted

from morphoskel.errors import StorageError
from morphoskel.networks.network_file import read_network, write_network


def read(path):
    with read_network(path, "network") as values:
        return values["weights"]


@pytest.mark.parametrize("how", DAMAGE)
def test_a_damaged_network_is_refused(tmp_path, how):
    path = tmp_path / "network.pt"
    write_network(torch.nn.Linear(50, 50), path)
    assert read(path)["weight"].shape == (50, 50)
    DAMAGE[how](path)
    with pytest.raises(StorageError, match=f"{path}: is damaged .* remove {path} and run again"):
        read(path)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can mount a small disk to fill it")
def test_a_network_that_does_not_fit_leaves_the_old_one(tmp_path):
    with mounted(tmp_path / "disk", "64k") as disk:
        path = disk / "network.pt"
        write_network(torch.nn.Linear(50, 50), path)
        with pytest.raises(StorageError, match=f"{path}: cannot be written .* space left"):
            write_network(torch.nn.Linear(500, 500), path)
        assert [entry.name for entry in disk.iterdir()] == ["network.pt"]
        assert read(path)["weight"].shape == (50, 50)
