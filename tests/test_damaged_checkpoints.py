import logging

import pytest
import torch

from morphoskel.learning.damaged_checkpoints import discard_damaged, is_finished


@pytest.fixture
def folder(tmp_path):
    checkpoints = tmp_path / "phase"
    checkpoints.mkdir()
    for name in ("last.ckpt", "best.ckpt"):
        torch.save({"weights": torch.arange(100.0)}, checkpoints / name)
    return checkpoints


def discard(folder):
    discard_damaged(folder, "last.ckpt", "best.ckpt")


def test_whole_checkpoints_stay(folder):
    discard(folder)
    assert sorted(path.name for path in folder.iterdir()) == ["best.ckpt", "last.ckpt"]


@pytest.mark.parametrize("name", ["last.ckpt", "best.ckpt"])
def test_a_turned_bit_that_pytorch_would_load_starts_the_phase_anew(folder, name, caplog):
    path = folder / name
    content = path.read_bytes().replace(torch.tensor(50.0).numpy().tobytes(), torch.tensor(51.0).numpy().tobytes())
    path.write_bytes(content)
    assert not torch.equal(torch.load(path, weights_only=True)["weights"], torch.arange(100.0))
    with caplog.at_level(logging.WARNING):
        discard(folder)
    assert not folder.exists()
    assert f"{path}: is damaged" in caplog.text
    assert "starts anew" in caplog.text


def test_the_last_is_nothing_without_the_best(folder):
    (folder / "best.ckpt").unlink()
    discard(folder)
    assert not folder.exists()


def test_a_best_one_before_the_first_last_is_left_to_the_training(folder):
    (folder / "last.ckpt").unlink()
    (folder / "best.ckpt").write_bytes(b"half")
    discard(folder)
    assert (folder / "best.ckpt").exists()


def test_nothing_there_is_no_error(tmp_path):
    discard(tmp_path / "absent")


def test_a_damaged_network_is_not_the_end_of_a_training(folder, caplog):
    path = folder / "last.ckpt"
    assert is_finished(path)
    path.write_bytes(path.read_bytes()[:-1])
    assert not is_finished(path)
    assert not path.exists()
    assert "is written again" in caplog.text
    assert not is_finished(path)
