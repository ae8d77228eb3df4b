"""What a training leaves after every epoch: a row with its losses, and the state to go on from."""

from __future__ import annotations

import csv
import logging
import time
from pathlib import Path
from typing import Any

import lightning
from lightning.pytorch.callbacks import Callback, Checkpoint

from morphoskel.atomic import atomic_file
from morphoskel.checksums import checked_file, intact

logger = logging.getLogger(__name__)

LOG_COLUMNS = ("epoch", "training_loss", "validation_loss", "seconds")
"""Of the table of losses."""


class LossTable(Callback):
    """Write a row an epoch to a CSV file; rows of epochs that are run again after a kill are replaced."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.started = time.perf_counter()

    def on_train_epoch_start(self, trainer: lightning.Trainer, pl_module: lightning.LightningModule) -> None:
        """Take the time."""
        self.started = time.perf_counter()

    def on_train_epoch_end(self, trainer: lightning.Trainer, pl_module: lightning.LightningModule) -> None:
        """Write the row."""
        if not trainer.is_global_zero:
            return
        rows: list[list[Any]] = []
        if self.path.exists():
            with intact(self.path).open(newline="") as file:
                rows = [row for row in list(csv.reader(file))[1:] if int(row[0]) < trainer.current_epoch]
        losses = [f"{float(trainer.callback_metrics[name]):.6g}" for name in LOG_COLUMNS[1:3]]
        rows.append([trainer.current_epoch, *losses, f"{time.perf_counter() - self.started:.2f}"])
        with checked_file(self.path) as partial, partial.open("w", newline="") as file:
            csv.writer(file).writerows([LOG_COLUMNS, *rows])
        logger.info("%s: epoch %s, training loss %s, validation loss %s, %s s", self.path.stem, *rows[-1])


class LastEpoch(Checkpoint):
    """Keep the state after the last epoch, which Lightning's own option does only if that epoch was the best so far.

    Lightning calls its checkpoints in the order given, after other callbacks: this one must come after the best one, so
    that it holds that one's state.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    def on_train_epoch_end(self, trainer: lightning.Trainer, pl_module: lightning.LightningModule) -> None:
        """Write the state."""
        if trainer.world_size > 1:
            trainer.save_checkpoint(self.path)  # every device takes part
            return
        with atomic_file(self.path) as partial:
            trainer.save_checkpoint(partial)
