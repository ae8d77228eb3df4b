"""Train Point2Skeleton on the training split of a data set."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from morphoskel.atomic import atomic_file
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import read_manifest
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.plain_values import as_tuples
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.provenance import content_hash

logger = logging.getLogger(__name__)

TRAINING_SPLIT = "train"


def train_on_split(
    manifest: Path,
    result: Path,
    checkpoints: Path,
    *,
    dataset: Mapping[str, Any],
    seed: int,
    network: Mapping[str, Any],
    validation_share: float,
    accelerator: str = "auto",
    threads: int = 1,
) -> None:
    """Train one network for all categories and write it to a file.

    Parameters
    ----------
    manifest
        The data set's manifest.
    result
        The file to write.
    checkpoints
        Folder of checkpoints and logs. Trainings with other settings, clouds or seeds get folders of their own in it,
        so that a training which was killed goes on and one which was changed starts anew.
    dataset, seed
        The configuration's data set section and the global seed.
    network
        Fields of :class:`~morphoskel.networks.point2skeleton_settings.Point2SkeletonSettings`.
    validation_share
        Share of the shapes of each category held out to choose the epoch.
    accelerator, threads
        Where to train, and with how many threads of a processor.

    Raises
    ------
    InputError
        If the split is empty or too small to hold a shape out.
    """
    import torch

    from morphoskel.learning.train_point2skeleton import train_point2skeleton

    torch.set_num_threads(threads)
    settings = Point2SkeletonSettings(**{name: as_tuples(value) for name, value in network.items()})
    records = read_manifest(manifest, split=TRAINING_SPLIT)
    parts = hold_out([record.category for record in records], validation_share, seed)
    training, validation = ([records[position] for position in part] for part in parts)
    logger.info("Point2Skeleton: %d shapes to train on, %d held out", len(training), len(validation))
    source = open_configured(dataset, seed=seed)
    clouds, held_out = ([source.load(record.path) for record in part] for part in (training, validation))
    identity = [settings.as_mapping(), seed, threads, [(record.id, record.sha256) for record in training + validation]]
    trained = train_point2skeleton(
        clouds, held_out, settings, checkpoints / content_hash(identity), seed, accelerator=accelerator
    )
    with atomic_file(result) as partial:
        partial.write_bytes(trained.read_bytes())
