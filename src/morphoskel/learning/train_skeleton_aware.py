"""Train the skeleton network of the skeleton-aware sampler from clouds to the file with the trained network."""

from __future__ import annotations

from pathlib import Path

import torch
from torch import Tensor

from morphoskel.errors import InputError
from morphoskel.learning.claim import claim
from morphoskel.learning.damaged_checkpoints import is_finished
from morphoskel.learning.resumable_fit import resumable_fit
from morphoskel.learning.skeleton_aware_phases import PRETRAIN, SKELETON, SkeletonAwarePhase
from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork, cloud_neighbourhoods, save_skeleton_aware
from morphoskel.networks.skeleton_aware_settings import SkeletonAwareSettings
from morphoskel.seeds import derive_seed

NETWORK_FILE = "network.pt"


def train_skeleton_aware(
    points: Tensor,
    validation: Tensor,
    settings: SkeletonAwareSettings,
    folder: Path,
    seed: int,
    *,
    accelerator: str = "auto",
    devices: int = 1,
    progress: bool = True,
) -> Path:
    """Train the network in two phases: spread the skeletal points, then fit the balls.

    Parameters
    ----------
    points
        ``(S, N, 3)`` float32 on the CPU, normalised training clouds.
    validation
        Clouds held out from training, at least one. After each phase the epoch with the smallest loss on them is kept.
    settings
        Sizes and schedule.
    folder
        For the result, checkpoints, and a CSV file a phase with the losses and seconds of each epoch. A training that
        was killed goes on from what it finds there.
    seed
        Decides the initial weights and the order of the shapes.
    accelerator, devices
        Where to train, see :func:`~morphoskel.learning.resumable_fit.resumable_fit`.
    progress
        Whether to show a progress bar.

    Returns
    -------
    Path
        ``network.pt`` in the folder, to be read by
        :func:`~morphoskel.networks.skeleton_aware_network.load_skeleton_aware`.

    Raises
    ------
    InputError
        If there is no training or no validation cloud, a cloud has too few points, or the folder holds another
        training.

    Notes
    -----
    The released program keeps the epoch with the smallest loss on the test shapes; here they are not looked at.

    References
    ----------
    .. [1] C. Wen et al., "Learnable Skeleton-Aware 3D Point Cloud Sampling", CVPR 2023.
    """
    for role, clouds in (("training", points), ("validation", validation)):
        if clouds.dim() != 3 or clouds.shape[-1] != 3 or len(clouds) == 0:
            raise InputError(f"{role} clouds: expected shape (S, N, 3) with S >= 1, got {tuple(clouds.shape)}")
    identity = {"network": "skeleton_aware", "settings": settings.as_mapping(), "seed": seed}
    claim(folder, identity, [points, validation])
    result = folder / NETWORK_FILE
    if is_finished(result):
        return result
    training_pair = (points, cloud_neighbourhoods(points, settings))
    validation_pair = (validation, cloud_neighbourhoods(validation, settings))
    with torch.random.fork_rng():
        torch.manual_seed(derive_seed(seed, "skeleton_aware", "initial weights"))
        network = SkeletonAwareNetwork(settings)
        for name, epochs in ((PRETRAIN, settings.pretrain_epochs), (SKELETON, settings.skeleton_epochs)):
            phase = SkeletonAwarePhase(name, network, training_pair, validation_pair, seed)
            resumable_fit(phase, epochs, folder, accelerator=accelerator, devices=devices, progress=progress)
    save_skeleton_aware(network, result)
    return result
