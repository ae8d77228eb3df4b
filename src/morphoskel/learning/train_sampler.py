"""Train any of the learned samplers."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch

from morphoskel.datasets.cloud_set import CloudSet
from morphoskel.errors import ConfigError, InputError
from morphoskel.learning.claim import claim
from morphoskel.learning.damaged_checkpoints import is_finished
from morphoskel.learning.generator_phases import GeneratorPhase
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.resumable_fit import BatchedPhase, resumable_fit
from morphoskel.learning.skeleton_sampler_phase import SkeletonSamplerPhase
from morphoskel.networks.generator_settings import GeneratorSettings
from morphoskel.networks.point_generator import PointGenerator, save_generator
from morphoskel.networks.pointnet_classifier import PointNetClassifier
from morphoskel.networks.skeleton_sampler import SkeletonSampler, save_skeleton_sampler
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings
from morphoskel.sampling.samplers import GENERATORS, LEARNED
from morphoskel.seeds import derive_seed

logger = logging.getLogger(__name__)

NETWORK_FILE = "network.pt"


@dataclass(frozen=True)
class SamplerTraining:
    """What decides the result of a training, beside its data.

    Parameters
    ----------
    sampler
        One of :data:`morphoskel.sampling.samplers.LEARNED`.
    samples
        Points to choose of a cloud.
    settings
        Of the network.
    steps
        Steps to train for, in epochs of equal length that may leave shapes out; ``None``: as many whole epochs as the
        settings say.
    validation_share
        Share of the shapes of each class held out to choose the epoch.
    seed
        The global seed.
    number
        Of the training, from 0. Trainings with the same number start all priors with the same weights and show them the
        same clouds in the same order, so that they differ by the prior alone.
    origin
        Plain values that the network's file shall tell its users beside the sampler's name and the points of a cloud.
    """

    sampler: str
    samples: int
    settings: GeneratorSettings | SkeletonSamplerSettings
    steps: int | None
    validation_share: float
    seed: int
    number: int
    origin: Mapping[str, Any] = field(default_factory=dict)


def train_sampler(
    training: SamplerTraining,
    clouds: CloudSet,
    weights: npt.NDArray[np.float32] | None,
    classifiers: Sequence[PointNetClassifier],
    folder: Path,
    *,
    accelerator: str = "auto",
    devices: int = 1,
    progress: bool = True,
) -> Path:
    """Train a sampler so that frozen classifiers recognise what it chooses.

    Parameters
    ----------
    training
        What to train.
    clouds
        The training split.
    weights
        ``(S, N)`` float32, the prior; ``None`` for samplers that generate points. Shapes with NaN are left out.
    classifiers
        At least one; only generators take several.
    folder
        For the result, checkpoints and logs. A training that was killed goes on from what it finds there.
    accelerator, devices
        Where to train.
    progress
        Show a progress bar.

    Returns
    -------
    Path
        ``network.pt`` in the folder.

    Raises
    ------
    ConfigError
        If there is no such learned sampler.
    InputError
        If settings, prior, classifiers or their classes do not fit the sampler, too few shapes are left, or the folder
        holds another training.
    """
    _check(training, clouds, weights, classifiers)
    known = np.arange(len(clouds)) if weights is None else np.flatnonzero(np.isfinite(weights).all(axis=1))
    if len(known) < len(clouds):
        logger.warning("%d of %d shapes have no skeleton and are left out", len(clouds) - len(known), len(clouds))
    parts = [
        part[np.isin(part, known)]
        for part in hold_out(clouds.categories.tolist(), training.validation_share, training.seed)
    ]
    if not all(map(len, parts)):
        raise InputError(f"{training.sampler}: no shape with a skeleton is left to train on or to hold out")
    data = [_tensors(clouds, weights, part) for part in parts]
    identity = {
        "training": repr(training),
        "classifiers": [_fingerprint(network) for network in classifiers],
        "devices": devices,
    }
    claim(folder, identity, [tensor for part in data for tensor in part])
    result = folder / NETWORK_FILE
    if is_finished(result):
        return result
    with torch.random.fork_rng():
        phase, save = _phase(training, data[0], data[1], tuple(classifiers))
        epochs = _plan_epochs(phase, training, devices)
        logger.info(
            "%s, %d points: %d shapes, %d held out; %d epochs of %d steps",
            training.sampler, training.samples, *map(len, parts), epochs, len(phase.train_dataloader()) // devices,
        )  # fmt: skip
        resumable_fit(phase, epochs, folder, accelerator=accelerator, devices=devices, progress=progress)
    save(result)
    return result


def _plan_epochs(phase: BatchedPhase, training: SamplerTraining, devices: int) -> int:
    """Return the number of epochs, and shorten each so that their steps add up to those wanted."""
    steps_per_epoch = len(phase.train_dataloader()) // devices
    if steps_per_epoch == 0:
        raise InputError(
            f"{len(phase.training_tensors[0])} shapes make too few batches for {devices} devices; use fewer of them"
        )
    if training.steps is None:
        return training.settings.epochs
    epochs = -(-training.steps // steps_per_epoch)
    phase.most_batches = -(-training.steps // epochs) * devices
    return epochs


def _check(
    training: SamplerTraining,
    clouds: CloudSet,
    weights: npt.NDArray[np.float32] | None,
    classifiers: Sequence[PointNetClassifier],
) -> None:
    """Refuse what does not fit the sampler, before anything is written."""
    sampler = training.sampler
    if sampler not in LEARNED:
        raise ConfigError(f"{sampler}: no such learned sampler; legal: {', '.join(LEARNED)}")
    generates = sampler in GENERATORS
    if isinstance(training.settings, GeneratorSettings) != generates or (weights is None) != generates:
        expected = "a generator's settings and no prior" if generates else "a skeleton sampler's settings and a prior"
        raise InputError(f"{sampler}: expected {expected}")
    if not classifiers or (len(classifiers) > 1 and not generates):
        least = "at least one classifier" if generates else "one classifier"
        raise InputError(f"{sampler}: expected {least}, got {len(classifiers)}")
    for classifier in classifiers:
        clouds.check_classes(classifier.class_names)


def _tensors(
    clouds: CloudSet, weights: npt.NDArray[np.float32] | None, chosen: npt.NDArray[np.int64]
) -> tuple[torch.Tensor, ...]:
    arrays: list[npt.NDArray[Any]] = [clouds.points, clouds.labels]
    arrays += [] if weights is None else [weights]
    return tuple(torch.from_numpy(array[chosen]) for array in arrays)


def _phase(
    training: SamplerTraining,
    shapes: tuple[torch.Tensor, ...],
    held_out: tuple[torch.Tensor, ...],
    classifiers: tuple[PointNetClassifier, ...],
) -> tuple[BatchedPhase, Callable[[Path], None]]:
    """Return the phase with its initial weights, and what saves the trained network."""
    family = training.sampler if training.sampler in GENERATORS else "skeleton sampler"
    seed = derive_seed(training.seed, family, str(training.samples), str(training.number))
    torch.manual_seed(derive_seed(seed, "initial weights"))
    settings = training.settings
    origin = {"sampler": training.sampler, "points": shapes[0].shape[1], **training.origin}
    if isinstance(settings, GeneratorSettings):
        generator = PointGenerator(training.samples, settings)
        generator.origin = origin
        points, labels = shapes
        phase: BatchedPhase = GeneratorPhase(
            "sampler", generator, classifiers, (points, labels), (held_out[0], held_out[1]), settings, seed
        )
        return phase, lambda path: save_generator(generator, path)
    sampler = SkeletonSampler(training.samples, settings)
    sampler.origin = origin
    phase = SkeletonSamplerPhase(
        "sampler", sampler, classifiers[0], (shapes[0], shapes[1], shapes[2]),
        (held_out[0], held_out[1], held_out[2]), settings, seed,
    )  # fmt: skip
    return phase, lambda path: save_skeleton_sampler(sampler, path)


def _fingerprint(network: PointNetClassifier) -> str:
    """Return a hash of the weights."""
    import hashlib

    digest = hashlib.sha256()
    for tensor in network.state_dict().values():
        digest.update(tensor.detach().cpu().numpy().tobytes())
    return digest.hexdigest()
