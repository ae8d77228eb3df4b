"""Train the skeleton network of the skeleton-aware sampler from files to a file, and use it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.datasets.manifest import checksum
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.plain_values import as_tuples
from morphoskel.networks.skeleton_aware_settings import SkeletonAwareSettings
from morphoskel.progress import track
from morphoskel.provenance import content_hash
from morphoskel.sampling.prior import local_feature_size
from morphoskel.sampling.prior_set import PriorSet


def train_skeleton_aware_on_files(
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
    """Train the network that predicts skeletons and write it to a file.

    Parameters
    ----------
    clouds
        File of the training split's clouds.
    result
        The file to write.
    checkpoints
        Folder of checkpoints and logs, as in :func:`~morphoskel.learning.sampler_training.train_sampler_on_files`.
    seed
        The global seed.
    settings
        Fields of :class:`~morphoskel.networks.skeleton_aware_settings.SkeletonAwareSettings`.
    validation_share
        Share of the shapes of each class held out to choose the epoch.
    accelerator, devices, threads
        Where to train, and with how many threads of a processor.
    """
    import torch

    from morphoskel.learning.train_skeleton_aware import train_skeleton_aware

    torch.set_num_threads(threads)
    chosen = SkeletonAwareSettings(**{name: as_tuples(value) for name, value in settings.items()})
    shapes = read_cloud_set(clouds)
    training, validation = (
        torch.from_numpy(shapes.points[part]) for part in hold_out(shapes.categories.tolist(), validation_share, seed)
    )
    identity = [repr(chosen), seed, validation_share, threads, devices, checksum(clouds)]
    trained = train_skeleton_aware(
        training, validation, chosen, checkpoints / content_hash(identity), seed, accelerator=accelerator,
        devices=devices,
    )  # fmt: skip
    with atomic_file(result) as partial:
        partial.write_bytes(trained.read_bytes())


def predict_local_feature_sizes(clouds: Path, network: Path, *, threads: int = 1) -> PriorSet:
    """Return the distance of every point to the skeleton that the network predicts for its cloud.

    Parameters
    ----------
    clouds
        File of a split's clouds.
    network
        The trained network's file.
    threads
        Of the processor.
    """
    import torch

    from morphoskel.networks.skeleton_aware_network import load_skeleton_aware, predict_skeleton

    torch.set_num_threads(threads)
    shapes = read_cloud_set(clouds)
    centres, _ = predict_skeleton(load_skeleton_aware(network), torch.from_numpy(shapes.points))
    distances = [
        local_feature_size(cloud.astype(np.float64), skeleton.astype(np.float64))
        for cloud, skeleton in track(
            zip(shapes.points, centres.numpy(), strict=True), "local feature size", total=len(shapes)
        )
    ]
    return PriorSet(shapes.ids, np.stack(distances).astype(np.float32), np.full(len(shapes), ""))
