import csv
from types import SimpleNamespace
from typing import ClassVar

import pytest
import torch

from morphoskel.learning.epoch_records import LOG_COLUMNS
from morphoskel.learning.resumable_fit import BatchedPhase, resumable_fit


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


class KilledError(Exception):
    pass


class Regression(BatchedPhase):
    """Fit a line through points, with dropout; a kill can be arranged."""

    def __init__(self, seed=0, shapes=7, killed_at=None, rate=0.05):
        torch.manual_seed(0)
        inputs = torch.linspace(-1, 1, shapes)[:, None]
        super().__init__("line", (inputs, 3 * inputs + 1), (inputs[:3], 3 * inputs[:3] + 1), 2, seed)
        self.line = torch.nn.Linear(1, 1)
        self.dropout = torch.nn.Dropout(0.2)
        self.rate = rate
        self.killed_at = killed_at
        self.seen = []

    def loss(self, batch):
        inputs, targets = batch
        if self.training:
            self.seen.append((self.current_epoch, inputs.ravel().tolist()))
            if len(self.seen) == self.killed_at:
                raise KilledError
        return (self.line(self.dropout(inputs)) - targets).square().mean()

    def configure_optimizers(self):
        return torch.optim.Adam(self.parameters(), lr=self.rate)


def fit(phase, folder, epochs=4):
    resumable_fit(phase, epochs, folder, accelerator="cpu", progress=False)
    return phase


def rows(folder):
    with (folder / "line.csv").open(newline="") as file:
        return list(csv.reader(file))


def test_every_epoch_is_a_new_order_of_the_shapes_without_the_rest(tmp_path):
    seen = fit(Regression(), tmp_path).seen
    epochs = [[value for epoch, values in seen if epoch == number for value in values] for number in range(4)]
    for values in epochs:
        assert len(values) == len(set(values)) == 6
    assert len({tuple(values) for values in epochs}) == 4
    assert fit(Regression(seed=1), tmp_path / "other").seen != seen


def test_fewer_shapes_than_a_batch_are_one_batch(tmp_path):
    assert len(Regression(shapes=1).train_dataloader()) == 1
    assert [len(inputs) for inputs, _ in Regression().val_dataloader()] == [2, 1]


def test_the_losses_of_each_epoch_are_written(tmp_path):
    fit(Regression(), tmp_path)
    header, *lines = rows(tmp_path)
    assert header == list(LOG_COLUMNS)
    assert [line[0] for line in lines] == ["0", "1", "2", "3"]
    assert float(lines[-1][2]) < float(lines[0][2])


@pytest.mark.parametrize("killed_at", [1, 2, 4, 5, 12])
def test_a_killed_fit_goes_on_to_the_same_result(tmp_path, killed_at):
    """The kill may fall on the first step of an epoch (1, 4) or on any other; the optimiser's state counts, too."""
    whole = fit(Regression(), tmp_path / "whole")
    with pytest.raises(KilledError):
        fit(Regression(killed_at=killed_at), tmp_path / "killed")
    resumed = fit(Regression(), tmp_path / "killed")
    assert len(resumed.seen) == 12 - (killed_at - 1) // 3 * 3  # finished epochs are not repeated
    assert resumed.seen == whole.seen[-len(resumed.seen) :]
    for one, other in zip(whole.parameters(), resumed.parameters(), strict=True):
        assert torch.equal(one, other)
    assert [line[:3] for line in rows(tmp_path / "killed")] == [line[:3] for line in rows(tmp_path / "whole")]


@pytest.mark.parametrize("killed_at", [7, 10])
def test_no_epoch_is_repeated_that_was_worse_than_an_earlier_one(tmp_path, killed_at):
    """With a rate so large that the loss goes up and down."""
    whole = fit(Regression(rate=2.0), tmp_path / "whole", epochs=5)
    with pytest.raises(KilledError):
        fit(Regression(rate=2.0, killed_at=killed_at), tmp_path / "killed", epochs=5)
    resumed = fit(Regression(rate=2.0), tmp_path / "killed", epochs=5)
    assert resumed.seen == whole.seen[killed_at - 1 :]
    assert torch.equal(resumed.line.weight, whole.line.weight)


def test_a_finished_fit_is_not_repeated(tmp_path):
    first = fit(Regression(), tmp_path)
    again = fit(Regression(), tmp_path)
    assert again.seen == []
    assert torch.equal(again.line.weight, first.line.weight)


def test_the_epoch_with_the_smallest_validation_loss_is_kept(tmp_path):
    """With a rate so large that the loss goes up and down, the last epoch is not the best one."""
    phase = fit(Regression(rate=2.0), tmp_path, epochs=5).eval()
    validation = [float(line[2]) for line in rows(tmp_path)[1:]]
    assert min(validation) < validation[-1]
    inputs, targets = phase.validation_tensors
    means = [
        float((phase.line(part) - target).detach().square().sum())
        for part, target in zip(inputs.split(2), targets.split(2), strict=True)
    ]
    assert sum(means) / len(inputs) == pytest.approx(min(validation), rel=1e-4)


def test_the_curves_are_written_for_tensorboard(tmp_path):
    from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

    fit(Regression(), tmp_path)
    events = EventAccumulator(str(tmp_path / "curves" / "line")).Reload()
    written = [event.value for event in events.Scalars("validation_loss")]
    assert written == pytest.approx([float(line[2]) for line in rows(tmp_path)[1:]], rel=1e-4)


def test_every_validation_sees_the_same_noise(tmp_path):
    class Noisy(Regression):
        drawn: ClassVar[list[float]] = []

        def validation_loss(self, batch):
            self.drawn.append(float(torch.rand(())))
            return super().validation_loss(batch)

    fit(Noisy(), tmp_path)
    first, *others = (Noisy.drawn[at : at + 2] for at in range(0, 8, 2))
    assert others == [first] * 3


def test_schedules_know_the_number_of_steps(tmp_path):
    assert fit(Regression(), tmp_path).total_steps == 4 * 3


def test_devices_are_dealt_equally_many_different_batches():
    phase = Regression(shapes=11)
    whole = [part.tolist() for part in phase.train_dataloader().parts]
    dealt = []
    for rank in range(2):
        phase._trainer = SimpleNamespace(global_rank=rank, world_size=2, current_epoch=0)
        dealt.append([part.tolist() for part in phase.train_dataloader().parts])
    assert dealt == [whole[0:4:2], whole[1:4:2]]


@pytest.mark.slow
def test_several_devices_train_together(tmp_path):
    phase = Regression(shapes=9)
    resumable_fit(phase, 2, tmp_path, accelerator="cpu", devices=2, progress=False)
    assert phase.total_steps == 2 * 2
    assert [row[0] for row in rows(tmp_path)[1:]] == ["0", "1"]
    moved = Regression(shapes=9).line.weight
    assert not torch.equal(phase.line.weight, moved)
