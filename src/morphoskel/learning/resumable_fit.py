"""Run one phase of a training so that it can be killed at any time and goes on as if it had not been."""

from __future__ import annotations

import logging
import pickle
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path

import lightning
import torch
from lightning.pytorch.callbacks import ModelCheckpoint
from lightning.pytorch.loggers import TensorBoardLogger

from morphoskel.errors import InputError
from morphoskel.learning.damaged_checkpoints import discard_damaged
from morphoskel.learning.epoch_records import LastEpoch, LossTable
from morphoskel.progress import shows_bars
from morphoskel.seeds import derive_seed

logger = logging.getLogger(__name__)

LAST = "last.ckpt"
BEST = "best.ckpt"


class Batches:
    """Rows of tensors, a tuple a batch. Lightning would take a plain list for several loaders side by side."""

    def __init__(self, tensors: tuple[torch.Tensor, ...], parts: Sequence[torch.Tensor]) -> None:
        self.tensors = tensors
        self.parts = parts

    def __len__(self) -> int:
        return len(self.parts)

    def __iter__(self) -> Iterator[tuple[torch.Tensor, ...]]:
        for part in self.parts:
            yield tuple(tensor[part] for tensor in self.tensors)


class BatchedPhase(lightning.LightningModule):
    """A phase of training on tensors that fit into memory, in an order that only the seed and the epoch decide.

    A subclass defines :meth:`loss` and ``configure_optimizers``, and :meth:`validation_loss` where the network is used
    otherwise than it is trained. No state of a random generator has to be kept with a checkpoint: whatever an epoch
    draws from the global generator, and the order of its shapes, comes from the seed, the phase's name and the number
    of the epoch.

    Parameters
    ----------
    name
        Of the phase; part of the seeds.
    training, validation
        Tensors whose first axis runs over the shapes, the same length within each tuple, at least 1.
    batch_size
        Shapes a step and device. An incomplete last batch is left out, since batch normalisation would suffer; with
        fewer shapes than that, all of them are one batch.
    seed
        Of the training.

    Attributes
    ----------
    most_batches
        Batches an epoch; those beyond are left out, other shapes in every epoch. ``None`` takes all.
    total_steps
        Steps of the whole training, for schedules; set by :func:`resumable_fit`.
    """

    most_batches: int | None = None
    total_steps: int = 0

    def __init__(
        self,
        name: str,
        training: tuple[torch.Tensor, ...],
        validation: tuple[torch.Tensor, ...],
        batch_size: int,
        seed: int,
    ) -> None:
        super().__init__()
        self.name = name
        self.training_tensors = training
        self.validation_tensors = validation
        self.batch_size = batch_size
        self.seed = seed

    def loss(self, batch: tuple[torch.Tensor, ...]) -> torch.Tensor:
        """Return the scalar loss of a batch, a mean over its shapes."""
        raise NotImplementedError

    def validation_loss(self, batch: tuple[torch.Tensor, ...]) -> torch.Tensor:
        """Return the scalar by which epochs are compared, smaller is better; by default the loss."""
        return self.loss(batch)

    def train_dataloader(self) -> Batches:
        """Return this device's batches of the current epoch; called anew for every epoch."""
        shapes = len(self.training_tensors[0])
        seed = derive_seed(self.seed, self.name, "order", str(self.current_epoch))
        order = torch.randperm(shapes, generator=torch.Generator().manual_seed(seed))
        size = min(self.batch_size, shapes)
        parts = torch.split(order[: shapes - shapes % size], size)[: self.most_batches]
        rank, devices = self._rank_and_devices()
        return Batches(self.training_tensors, parts[rank : len(parts) - len(parts) % devices : devices])

    def val_dataloader(self) -> Batches:
        """Return the batches of the validation shapes, the last one maybe smaller; the same on every device."""
        shapes = len(self.validation_tensors[0])
        return Batches(self.validation_tensors, torch.split(torch.arange(shapes), self.batch_size))

    def on_train_epoch_start(self) -> None:
        """Seed what draws from the global generator, such as dropout."""
        rank, _ = self._rank_and_devices()
        of_device = [str(rank)] if rank else []
        torch.manual_seed(derive_seed(self.seed, self.name, "dropout", str(self.current_epoch), *of_device))

    def on_validation_epoch_start(self) -> None:
        """Let every validation draw the same numbers, so that epochs are compared under the same noise."""
        torch.manual_seed(derive_seed(self.seed, self.name, "validation"))

    def training_step(self, batch: tuple[torch.Tensor, ...], index: int) -> torch.Tensor:
        """Return the loss of a batch and add it to the epoch's mean."""
        loss = self.loss(batch)
        several = self._rank_and_devices()[1] > 1
        self.log("training_loss", loss, on_step=False, on_epoch=True, batch_size=len(batch[0]), sync_dist=several)
        return loss

    def validation_step(self, batch: tuple[torch.Tensor, ...], index: int) -> None:
        """Add the loss of a batch to the mean over the validation shapes."""
        self.log("validation_loss", self.validation_loss(batch), prog_bar=True, batch_size=len(batch[0]))

    def _rank_and_devices(self) -> tuple[int, int]:
        """Return the number of this device and how many there are."""
        trainer = self._trainer  # the property raises outside of a training
        return (trainer.global_rank, trainer.world_size) if trainer is not None else (0, 1)


def resumable_fit(
    phase: BatchedPhase, epochs: int, folder: Path, *, accelerator: str, devices: int = 1, progress: bool = True
) -> None:
    """Train a phase and load the weights of the epoch with the smallest validation loss into it.

    Parameters
    ----------
    phase
        Holds the weights to start from; holds the best ones at the end.
    epochs
        Passes over the training shapes.
    folder
        For ``<name>.csv`` with the losses, ``<name>/`` with the checkpoints of the last and the best epoch, and
        ``curves/<name>/`` with the losses for TensorBoard. If it holds a last checkpoint, the training goes on there;
        if a checkpoint is damaged, the phase starts anew, and ends with the same weights.
    accelerator
        As in Lightning, for example ``"auto"`` or ``"cpu"``.
    devices
        Graphics cards, or processes on a processor, that share the batches of each epoch.
    progress
        Whether to show a progress bar, if there is a terminal.

    Raises
    ------
    InputError
        If a checkpoint there holds more than weights and plain values; nothing in it is run.
    """
    logging.getLogger("lightning.pytorch").setLevel(logging.WARNING)  # it advertises at level INFO
    checkpoints = folder / phase.name
    discard_damaged(checkpoints, LAST, BEST)
    checkpoints.mkdir(parents=True, exist_ok=True)
    batches = len(phase.train_dataloader()) // devices
    phase.total_steps = epochs * batches
    with warnings.catch_warnings():
        _silence()
        trainer = _trainer(phase.name, epochs, folder, accelerator, devices, progress)
        last = checkpoints / LAST
        try:
            trainer.fit(phase, ckpt_path=last if last.exists() else None, weights_only=True)
            best = torch.load(checkpoints / BEST, map_location="cpu", weights_only=True)
        except pickle.UnpicklingError as error:
            raise InputError(
                f"{checkpoints}: a checkpoint there holds more than weights and plain values, and is not read "
                f"({str(error).partition(chr(10))[0]}). Delete the folder to train anew"
            ) from error
    phase.load_state_dict(best["state_dict"])


def _trainer(name: str, epochs: int, folder: Path, accelerator: str, devices: int, progress: bool) -> lightning.Trainer:
    best = ModelCheckpoint(
        folder / name,
        Path(BEST).stem,
        monitor="validation_loss",
        save_on_train_epoch_end=True,
        enable_version_counter=False,
    )
    return lightning.Trainer(
        accelerator=accelerator,
        devices=devices,
        strategy="ddp_spawn" if devices > 1 else "auto",
        use_distributed_sampler=False,  # the phase deals its batches out itself
        max_epochs=epochs,
        callbacks=[LossTable(folder / f"{name}.csv"), best, LastEpoch(folder / name / LAST)],
        logger=TensorBoardLogger(folder / "curves", name=name, version=""),
        log_every_n_steps=1,
        default_root_dir=folder,
        num_sanity_val_steps=0,
        reload_dataloaders_every_n_epochs=1,
        enable_progress_bar=progress and shows_bars(),
        enable_model_summary=False,
    )


def _silence() -> None:
    """Keep warnings from the user that do not concern them."""
    # Lightning 2.6 calls a function of torch that torch 2.13 deprecates, warns of a folder of checkpoints that is not
    # empty, which it never is when a training goes on, would rather log an epoch's mean on every device, and advises
    # to start jobs by srun wherever that is installed.
    warnings.filterwarnings("ignore", r".*LeafSpec", FutureWarning)
    warnings.filterwarnings("ignore", r"Checkpoint directory .* exists and is not empty")
    warnings.filterwarnings("ignore", r"It is recommended to use `self.log\('validation_loss'")
    warnings.filterwarnings("ignore", r"The `srun` command is available")
