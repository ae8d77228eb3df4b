"""Choose the points of a split's clouds with any sampler, trained or not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.progress import track
from morphoskel.sampling.choice import ARGMAX, COMPLETED, DRAWN, FIXED, Choice
from morphoskel.sampling.lfs import LfsSettings, lfs_points
from morphoskel.sampling.matching import complete, match_and_complete
from morphoskel.sampling.random_points import random_points
from morphoskel.sampling.samplers import GENERATORS, check_sampler
from morphoskel.seeds import derive_generator, derive_seed
from morphoskel.skeleton.thinning import farthest_points

if TYPE_CHECKING:
    import torch

    from morphoskel.datasets.cloud_set import CloudSet
    from morphoskel.networks.point_generator import PointGenerator
    from morphoskel.networks.skeleton_sampler import SkeletonSampler

BATCH_SIZE = 16
"""Clouds that pass a network at a time; too few to matter for memory, enough for speed."""


@dataclass(frozen=True)
class Request:
    """What to choose.

    Parameters
    ----------
    sampler
        One of :data:`morphoskel.sampling.samplers.SAMPLERS`.
    samples
        Points of each cloud.
    draws
        Choices that a sampler with noise makes.
    seed
        The global seed. Every shape and draw has noise of its own, whatever the order of the shapes.
    number
        Of the training, part of the seeds.
    """

    sampler: str
    samples: int
    draws: int
    seed: int
    number: int = 0


def choose_points(
    request: Request,
    clouds: CloudSet,
    *,
    network: PointGenerator | SkeletonSampler | None = None,
    weights: npt.NDArray[np.float32] | None = None,
    sizes: npt.NDArray[np.float32] | None = None,
    lfs: LfsSettings | None = None,
    progress: bool = True,
) -> dict[str, Choice]:
    """Choose points of every cloud.

    Parameters
    ----------
    request
        What to choose.
    clouds
        Of a split.
    network
        For learned samplers.
    weights
        ``(S, N)`` float32, the prior of a skeleton-aware sampler, NaN for shapes without a skeleton.
    sizes, lfs
        ``(S, N)`` float32 local feature sizes, NaN likewise, and settings for ``lfs``.
    progress
        Show a progress bar.

    Returns
    -------
    dict
        The kinds of choices that the sampler makes: :data:`FIXED`; :data:`DRAWN`; or :data:`DRAWN`, :data:`ARGMAX` and
        :data:`COMPLETED`.

    Raises
    ------
    InputError
        If the network, the prior or the local feature sizes are missing or do not fit.
    """
    check_sampler(request.sampler)
    if request.samples > clouds.points.shape[1]:
        raise InputError(f"samples: {request.samples} of {clouds.points.shape[1]} points cannot be chosen")
    chosen = _choices(request, clouds, network, weights, (sizes, lfs))
    found: dict[str, list[Choice]] = {}
    shapes = track(chosen, f"choose, {request.sampler}", unit="cloud", total=len(clouds), show=progress)
    for of_shape in shapes:
        for kind, choice in of_shape.items():
            found.setdefault(kind, []).append(choice)
    return {
        kind: Choice(
            np.stack([choice.indices for choice in choices], axis=1),
            np.stack([choice.distinct for choice in choices], axis=1),
        )
        for kind, choices in found.items()
    }


def _choices(
    request: Request,
    clouds: CloudSet,
    network: PointGenerator | SkeletonSampler | None,
    weights: npt.NDArray[np.float32] | None,
    local: tuple[npt.NDArray[np.float32] | None, LfsSettings | None],
) -> Iterator[dict[str, Choice]]:
    """Yield what is chosen of one cloud after the other; arrays are ``(D, M)`` and ``(D,)``."""
    if request.sampler == "random":
        return (_random(request, shape, clouds.points.shape[1]) for shape in clouds.ids)
    if request.sampler == "fps":
        return ({FIXED: _fixed(farthest_points(cloud, request.samples))} for cloud in _doubles(clouds))
    if request.sampler == "lfs":
        sizes, settings = local
        if sizes is None or settings is None:
            raise InputError("lfs: expected local feature sizes and settings")
        return (_lfs(request, cloud, size, settings) for cloud, size in zip(_doubles(clouds), sizes, strict=True))
    if network is None or network.samples != request.samples:
        raise InputError(f"{request.sampler}: expected a network trained to choose {request.samples} points")
    if request.sampler in GENERATORS:
        return (_matched(cloud, points) for cloud, points in _generated(clouds, network))
    if weights is None:
        raise InputError(f"{request.sampler}: expected the weights of its prior")
    return (_noisy(request, *item) for item in _rated(clouds, weights, network))


def _doubles(clouds: CloudSet) -> Iterator[npt.NDArray[np.float64]]:
    return (cloud.astype(np.float64) for cloud in clouds.points)


def _fixed(indices: npt.NDArray[np.int64], distinct: int | None = None) -> Choice:
    return Choice(indices[None].astype(np.int32), np.array([distinct or len(np.unique(indices))], dtype=np.int32))


def _nothing(draws: int, samples: int) -> Choice:
    return Choice(np.full((draws, samples), -1, dtype=np.int32), np.zeros(draws, dtype=np.int32))


def _drawn(request: Request, choose: Callable[[int], npt.NDArray[np.int64]]) -> Choice:
    indices = np.stack([choose(draw) for draw in range(request.draws)]).astype(np.int32)
    return Choice(indices, np.array([len(np.unique(row)) for row in indices], dtype=np.int32))


def _random(request: Request, shape: str, available: int) -> dict[str, Choice]:
    generator = derive_generator(request.seed, str(shape), "random points", str(request.samples))
    return {DRAWN: _drawn(request, lambda _: random_points(available, request.samples, generator))}


def _lfs(
    request: Request, cloud: npt.NDArray[np.float64], sizes: npt.NDArray[np.float32], settings: LfsSettings
) -> dict[str, Choice]:
    if not np.isfinite(sizes).all():
        return {FIXED: _nothing(1, request.samples)}
    return {FIXED: _fixed(lfs_points(cloud, sizes.astype(np.float64), request.samples, settings))}


def _generated(
    clouds: CloudSet, network: PointGenerator | SkeletonSampler
) -> Iterator[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]]:
    """Yield each cloud with the points that the network generates from it."""
    import torch

    from morphoskel.networks.point_generator import PointGenerator, generate

    if not isinstance(network, PointGenerator):
        raise InputError("expected a network that generates points, got a skeleton-aware sampler")
    points = generate(network, torch.from_numpy(clouds.points), BATCH_SIZE).numpy().astype(np.float64)
    return zip(_doubles(clouds), points, strict=True)


def _matched(cloud: npt.NDArray[np.float64], generated: npt.NDArray[np.float64]) -> dict[str, Choice]:
    matching = match_and_complete(cloud, generated)
    return {FIXED: _fixed(matching.indices, int(matching.matched))}


def _rated(
    clouds: CloudSet, weights: npt.NDArray[np.float32], network: PointGenerator | SkeletonSampler
) -> Iterator[tuple[str, npt.NDArray[np.float64], torch.Tensor | None]]:
    """Yield each shape's id, cloud and logits ``(M, N)``, ``None`` for one without a skeleton."""
    import torch

    from morphoskel.networks.skeleton_sampler import SkeletonSampler

    if not isinstance(network, SkeletonSampler):
        raise InputError("expected a skeleton-aware sampler, got a network that generates points")
    network.eval()
    for start in range(0, len(clouds), BATCH_SIZE):
        part = slice(start, start + BATCH_SIZE)
        known = np.asarray(np.isfinite(weights[part]).all(axis=1), dtype=np.bool_)
        logits: Iterator[torch.Tensor] = iter(())
        if known.any():
            with torch.no_grad():
                logits = iter(network(torch.from_numpy(clouds.points[part][known]),
                                      torch.from_numpy(weights[part][known])))  # fmt: skip
        for shape, cloud, has in zip(clouds.ids[part], clouds.points[part], known, strict=True):
            yield str(shape), cloud.astype(np.float64), next(logits) if has else None


def _noisy(
    request: Request, shape: str, cloud: npt.NDArray[np.float64], logits: torch.Tensor | None
) -> dict[str, Choice]:
    """Return the three kinds of choices by the logits."""
    if logits is None:
        draws = {DRAWN: request.draws, ARGMAX: 1, COMPLETED: request.draws}
        return {kind: _nothing(count, request.samples) for kind, count in draws.items()}
    import torch

    from morphoskel.sampling.gumbel import best_indices, draw_indices

    noise = torch.Generator().manual_seed(
        derive_seed(request.seed, shape, "sampler noise", str(request.samples), str(request.number))
    )
    drawn = _drawn(request, lambda _: draw_indices(logits[None], noise)[0].numpy())
    completed = _drawn(request, lambda draw: complete(cloud, _distinct(drawn.indices[draw]), request.samples))
    return {DRAWN: drawn, ARGMAX: _fixed(best_indices(logits[None])[0].numpy()), COMPLETED: completed}


def _distinct(indices: npt.NDArray[np.int32]) -> npt.NDArray[np.int64]:
    """Return the different indices in the order in which they appear first."""
    _, first = np.unique(indices, return_index=True)
    return indices[np.sort(first)].astype(np.int64)
