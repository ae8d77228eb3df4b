"""The benchmark must compare networks that compute the same, and notice those that do not."""

import pandas as pd
import pytest
import torch

from benchmarks.training_step import Sizes, make_trainings, measure, write_table

SIZES = Sizes(batch=2, points=24, k=4, samples=5, channels=(8, 8), head=(12, 6), repeats=2, threads=1)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def test_both_trainings_learn_the_same():
    trainings = make_trainings(SIZES)
    points = torch.rand(2, 24, 3, generator=torch.Generator().manual_seed(0), dtype=torch.float64)
    for training in trainings.values():
        training.network.double()
    losses = [[training.step(points) for _ in range(4)] for training in trainings.values()]
    assert losses[0] == pytest.approx(losses[1], rel=1e-6)
    assert len(set(losses[0])) == 4


def test_both_trainings_are_measured():
    measured = measure(SIZES)
    assert set(measured) == {"naive", "factorised"}
    assert min(found["seconds"] for found in measured.values()) > 0
    assert measured["naive"]["loss"] == pytest.approx(measured["factorised"]["loss"], rel=1e-4)


@pytest.mark.parametrize(("seconds", "loss", "passed"), [(0.5, 0.25, True), (1.0, 0.25, False), (0.5, 0.26, False)])
def test_a_slow_step_and_another_loss_fail_the_check(tmp_path, seconds, loss, passed):
    measured = {"naive": {"loss": 0.25, "seconds": 2.0}, "factorised": {"loss": loss, "seconds": seconds}}
    assert write_table(measured, tmp_path) == passed
    table = pd.read_csv(tmp_path / "training_step.csv")
    assert table.to_dict("list") == {
        "layer": ["naive", "factorised"],
        "seconds": [2.0, seconds],
        "ratio": [1.0, 2.0 / seconds],
    }
