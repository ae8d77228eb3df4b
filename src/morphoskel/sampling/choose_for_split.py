"""Choose points of a split at every ratio with every trained network of a sampler, from files to files."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.atomic import atomic_folder
from morphoskel.errors import InputError
from morphoskel.sampling.choice import Choice, read_choice, write_choice
from morphoskel.sampling.choose_points import Request, choose_points
from morphoskel.sampling.lfs import LfsSettings
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.samplers import GENERATORS, LEARNED
from morphoskel.sampling.trained import load_trained

if TYPE_CHECKING:
    from morphoskel.networks.point_generator import PointGenerator
    from morphoskel.networks.skeleton_sampler import SkeletonSampler

logger = logging.getLogger(__name__)

Key = tuple[int, int, str]
"""Ratio, number of the training, and kind of choice."""


def choose_for_split(
    sampler: str,
    clouds: Path,
    folder: Path,
    *,
    networks: Sequence[Path],
    priors: Path | None,
    ratios: Sequence[int],
    draws: int,
    seed: int,
    prior: Mapping[str, Any],
    lfs: Mapping[str, Any] | None,
) -> None:
    """Write the choices of a sampler to a folder, one file for each ratio, training and kind of choice.

    Parameters
    ----------
    sampler
        One of :data:`morphoskel.sampling.samplers.SAMPLERS`.
    clouds
        File of the split's clouds.
    folder
        To make; appears only when complete. See :func:`read_choices`.
    networks
        Files ``.../{number}/network.pt``; none for a sampler without training. They may be trained on clouds of
        another size: each chooses as many points as it was trained to.
    priors
        File of local feature sizes, for the samplers that need them.
    ratios
        Points of a cloud for each point chosen.
    draws
        Choices that a sampler with noise makes.
    seed
        The global seed.
    prior, lfs
        Settings of :class:`~morphoskel.sampling.prior.PriorSettings` and
        :class:`~morphoskel.sampling.lfs.LfsSettings`.

    Raises
    ------
    InputError
        If a file is missing or does not fit.
    """
    from morphoskel.datasets.cloud_set import read_cloud_set
    from morphoskel.sampling.prior_set import read_prior_set
    from morphoskel.sampling.sampler_weights import sampler_weights

    shapes = read_cloud_set(clouds)
    sizes = read_prior_set(priors, shapes) if priors else None
    guided = sampler in LEARNED and sampler not in GENERATORS
    weights = sampler_weights(sampler, shapes, sizes, PriorSettings(**prior), seed) if guided else None
    samples = {ratio: shapes.points.shape[1] // ratio for ratio in ratios}
    with atomic_folder(folder) as partial:
        for ratio, number, network in _trainings(sampler, networks, samples):
            request = Request(sampler, samples[ratio], draws, seed, number)
            chosen = choose_points(
                request,
                shapes,
                network=network,
                weights=weights,
                sizes=sizes.distances if sizes else None,
                lfs=LfsSettings(**lfs) if lfs else None,
            )
            for kind, choice in chosen.items():
                write_choice(choice, partial / f"{ratio}_{number}_{kind}.npz")
                logger.info("%s, ratio %d, training %d, %s: %.1f of %d points distinct",
                            sampler, ratio, number, kind, choice.distinct.mean(), request.samples)  # fmt: skip


def read_choices(folder: Path) -> dict[Key, Choice]:
    """Return the choices in a folder of :func:`choose_for_split`, sorted by ratio, training and kind.

    Raises
    ------
    InputError
        If there are none, or a file holds none.
    """
    found = {}
    for path in folder.glob("*.npz"):
        try:
            ratio, number, kind = path.stem.split("_")
            key = int(ratio), int(number), kind
        except ValueError as error:
            raise InputError(f"{path}: expected a name such as 8_0_drawn.npz; remove this file") from error
        found[key] = read_choice(path)
    if not found:
        raise InputError(f"{folder}: holds no chosen points; choose them first")
    return dict(sorted(found.items()))


def _trainings(
    sampler: str, networks: Sequence[Path], samples: Mapping[int, int]
) -> Iterator[tuple[int, int, PointGenerator | SkeletonSampler | None]]:
    """Yield ratio, number and network of each training; for a sampler without, every ratio once."""
    if not networks:
        yield from ((ratio, 0, None) for ratio in samples)
    for path in networks:
        network = load_trained(sampler, path)
        fitting = [ratio for ratio, wanted in samples.items() if wanted == network.samples]
        if not fitting:
            wanted = " or ".join(map(str, samples.values()))
            raise InputError(f"{path}: chooses {network.samples} points; expected a network trained to choose {wanted}")
        yield fitting[0], _number(path), network


def _number(network: Path) -> int:
    try:
        return int(network.parent.name)
    except ValueError as error:
        raise InputError(f"{network}: expected its folder to be named by the number of the training") from error
