"""Train a classifier from a file of clouds to a file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from morphoskel.atomic import atomic_file
from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.datasets.manifest import checksum
from morphoskel.learning.hold_out import hold_out
from morphoskel.networks.classifier_settings import ClassifierSettings
from morphoskel.provenance import content_hash
from morphoskel.seeds import derive_seed


def train_classifier_on_files(
    name: str,
    clouds: Path,
    result: Path,
    checkpoints: Path,
    *,
    seed: int,
    settings: Mapping[str, Any],
    validation_share: float,
    accelerator: str = "auto",
    devices: int = 1,
    threads: int = 1,
) -> None:
    """Train one classifier and write it to a file.

    Parameters
    ----------
    name
        Of the classifier; part of its seed.
    clouds
        File of the training split's clouds.
    result
        The file to write.
    checkpoints
        Folder of checkpoints and logs, as in :func:`~morphoskel.learning.sampler_training.train_sampler_on_files`.
    seed
        The global seed.
    settings
        Fields of :class:`~morphoskel.networks.classifier_settings.ClassifierSettings`.
    validation_share
        Share of the shapes of each class held out to choose the epoch.
    accelerator, devices, threads
        Where to train, and with how many threads of a processor.
    """
    import torch

    from morphoskel.learning.train_classifier import train_classifier

    torch.set_num_threads(threads)
    chosen = ClassifierSettings(**settings)
    shapes = read_cloud_set(clouds)
    training, validation = (
        (torch.from_numpy(shapes.points[part]), torch.from_numpy(shapes.labels[part]))
        for part in hold_out(shapes.categories.tolist(), validation_share, seed)
    )
    identity = [name, repr(chosen), seed, validation_share, threads, devices, checksum(clouds)]
    trained = train_classifier(
        training,
        validation,
        shapes.class_names.tolist(),
        chosen,
        checkpoints / content_hash(identity),
        derive_seed(seed, "classifier", name),
        accelerator=accelerator,
        devices=devices,
    )
    with atomic_file(result) as partial:
        partial.write_bytes(trained.read_bytes())
