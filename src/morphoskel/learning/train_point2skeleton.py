"""Train Point2Skeleton from clouds to the file with the trained network."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import torch
from torch import Tensor

from morphoskel.errors import InputError
from morphoskel.learning.claim import claim
from morphoskel.learning.damaged_checkpoints import is_finished
from morphoskel.learning.point2skeleton_phases import PRETRAIN, SKELETON, LinkPhase, SkeletalPointPhase
from morphoskel.learning.resumable_fit import resumable_fit
from morphoskel.networks.cloud_preparation import prepare_cloud
from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork, save_network
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.seeds import derive_seed
from morphoskel.shapes import FloatArray, PointCloud

NETWORK_FILE = "network.pt"


def train_point2skeleton(
    clouds: Sequence[PointCloud | FloatArray],
    validation: Sequence[PointCloud | FloatArray],
    settings: Point2SkeletonSettings,
    checkpoint_folder: Path,
    seed: int,
    *,
    accelerator: str = "auto",
    progress: bool = True,
) -> Path:
    """Train the networks in three phases: spread the skeletal points, fit the balls, predict the links.

    Parameters
    ----------
    clouds
        Training shapes, as clouds or ``(N, 3)`` float64 arrays of any number of points and in any units, see
        :func:`~morphoskel.networks.cloud_preparation.prepare_cloud`.
    validation
        Shapes held out from training, at least one. After each phase the epoch with the smallest loss on them is kept.
    settings
        Sizes and schedule.
    checkpoint_folder
        For the result, checkpoints, and a CSV file a phase with the losses and seconds of each epoch. A training that
        was killed goes on from what it finds there.
    seed
        Decides the initial weights, the order of the shapes and the dropout.
    accelerator
        As in Lightning: ``"auto"`` takes a GPU if there is one.
    progress
        Whether to show a progress bar.

    Returns
    -------
    Path
        ``network.pt`` in the folder, to be read by
        :func:`~morphoskel.networks.point2skeleton_network.load_point2skeleton`.

    Raises
    ------
    InputError
        If there is no training or no validation cloud, a cloud is none, or the folder holds a training with other
        settings.

    Notes
    -----
    On a CPU the result is the same to the last bit for the same arguments, version of torch and number of its threads,
    whether or not the training was interrupted. Unlike the released program, which keeps the last epoch, each phase
    ends with its best epoch, and Adam starts each phase afresh.

    References
    ----------
    .. [1] C. Lin et al., "Point2Skeleton: Learning Skeletal Representations from Point Clouds", CVPR 2021.
    """
    training_points = _prepare(clouds, settings.points, "training")
    validation_points = _prepare(validation, settings.points, "validation")
    identity = {"settings": settings.as_mapping(), "seed": seed}
    claim(checkpoint_folder, identity, [training_points, validation_points])
    result = checkpoint_folder / NETWORK_FILE
    if is_finished(result):
        return result
    with torch.random.fork_rng():
        torch.manual_seed(derive_seed(seed, "point2skeleton", "initial weights"))
        network = Point2SkeletonNetwork(settings)
        for name, epochs in ((PRETRAIN, settings.pretrain_epochs), (SKELETON, settings.skeleton_epochs)):
            phase = SkeletalPointPhase(name, network, training_points, validation_points, seed)
            resumable_fit(phase, epochs, checkpoint_folder, accelerator=accelerator, progress=progress)
        links = LinkPhase(network, training_points, validation_points, seed)
        resumable_fit(links, settings.link_epochs, checkpoint_folder, accelerator=accelerator, progress=progress)
    save_network(network, result)
    return result


def _prepare(clouds: Sequence[PointCloud | FloatArray], points: int, role: str) -> Tensor:
    """Return ``(S, points, 3)`` float32, or say that there is nothing to train on."""
    if not clouds:
        raise InputError(f"training Point2Skeleton needs at least one {role} cloud")
    return torch.stack([prepare_cloud(cloud, points).points for cloud in clouds])
