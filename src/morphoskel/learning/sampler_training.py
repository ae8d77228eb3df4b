"""Train a sampler from files to a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from morphoskel.atomic import atomic_file
from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.datasets.manifest import checksum
from morphoskel.learning.plain_values import as_tuples
from morphoskel.networks.generator_settings import GeneratorSettings
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings
from morphoskel.provenance import content_hash
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.prior_set import read_prior_set
from morphoskel.sampling.sampler_weights import sampler_weights
from morphoskel.sampling.samplers import GENERATORS


def train_sampler_on_files(
    sampler: str,
    clouds: Path,
    classifiers: Sequence[Path],
    priors: Path | None,
    result: Path,
    checkpoints: Path,
    *,
    ratio: int,
    number: int,
    seed: int,
    settings: Mapping[str, Any],
    prior: Mapping[str, Any],
    steps: int | None,
    validation_share: float,
    accelerator: str = "auto",
    devices: int = 1,
    threads: int = 1,
) -> None:
    """Train one sampler for one ratio and write it to a file.

    Parameters
    ----------
    sampler
        One of :data:`morphoskel.sampling.samplers.LEARNED`.
    clouds
        File of the training split's clouds.
    classifiers
        Files of the classifiers that judge.
    priors
        File of the training split's local feature sizes, for the samplers that need them.
    result
        The file to write.
    checkpoints
        Folder of checkpoints and logs. Trainings with other settings get folders of their own in it, so that a
        training which was killed goes on and one which was changed starts anew.
    ratio
        Points of a cloud for each point chosen.
    number
        Of the training, from 0.
    seed
        The global seed.
    settings, prior
        Fields of the sampler's settings and of :class:`~morphoskel.sampling.prior.PriorSettings`.
    steps, validation_share
        See :class:`~morphoskel.learning.train_sampler.SamplerTraining`.
    accelerator, devices, threads
        Where to train, and with how many threads of a processor.
    """
    import torch

    from morphoskel.learning.train_sampler import SamplerTraining, train_sampler
    from morphoskel.networks.pointnet_classifier import load_classifier

    torch.set_num_threads(threads)
    kind = GeneratorSettings if sampler in GENERATORS else SkeletonSamplerSettings
    shapes = read_cloud_set(clouds)
    training = SamplerTraining(
        sampler=sampler,
        samples=shapes.points.shape[1] // ratio,
        settings=kind(**{name: as_tuples(value) for name, value in settings.items()}),
        steps=steps,
        validation_share=validation_share,
        seed=seed,
        number=number,
        origin={} if sampler in GENERATORS else {"prior": dict(prior)},
    )
    weights = None
    if sampler not in GENERATORS:
        sizes = read_prior_set(priors, shapes) if priors else None
        weights = sampler_weights(sampler, shapes, sizes, PriorSettings(**prior), seed)
    # The data are part of the identity by their files' hashes: other clouds must not go on with these checkpoints.
    identity = [repr(training), threads, devices, *map(checksum, [clouds, *classifiers, *filter(None, [priors])])]

    trained = train_sampler(
        training,
        shapes,
        weights,
        [load_classifier(path) for path in classifiers],
        checkpoints / content_hash(identity),
        accelerator=accelerator,
        devices=devices,
    )
    with atomic_file(result) as partial:
        partial.write_bytes(trained.read_bytes())
