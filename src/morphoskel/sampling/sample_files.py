"""Choose points of the shapes in files, one after the other, and write what a user wants to keep."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.batch import BatchResult, arguments_of, name_outputs
from morphoskel.config import Config
from morphoskel.errors import ConfigError, InputError, MorphoSkelError
from morphoskel.progress import track
from morphoskel.sampling.lfs import LfsSettings
from morphoskel.sampling.prior import PriorSettings
from morphoskel.sampling.sample_shape import SampledShape, ShapeSampler
from morphoskel.sampling.samplers import LEARNED, LEARNED_SKELETON, PRIORS, SKELETON_OF, check_sampler
from morphoskel.shapes import MINIMUM_DISTINCT_POINTS, Mesh

logger = logging.getLogger(__name__)

DEFAULT_POINTS = 128
"""Points chosen by a sampler without a network, unless told otherwise: the paper's largest number."""


@dataclass(frozen=True)
class SamplingRequest:
    """What a user asks for.

    Parameters
    ----------
    sampler
        One of :data:`~morphoskel.sampling.samplers.SAMPLERS`.
    points
        Points to choose; ``None`` for :data:`DEFAULT_POINTS`, or for as many as the network was trained to choose.
    surface
        Which of the configured reconstructions rebuilds the surface of a cloud, for a sampler that needs a skeleton;
        ``None`` for that of the configuration's section ``sampling``.
    network
        File with a trained network, for a learned sampler.
    skeleton_network
        File with the network that predicts skeletons, for ``skeleton_aware``.
    noise
        Let a network with a skeleton prior draw its points, with the configuration's seed.
    plot
        Draw a picture of each choice.
    """

    sampler: str
    points: int | None = None
    surface: str | None = None
    network: Path | None = None
    skeleton_network: Path | None = None
    noise: bool = False
    plot: bool = False


def sample_files(
    inputs: Sequence[Path], folder: Path, config: Config, request: SamplingRequest, *, progress: bool = True
) -> BatchResult:
    """Write ``{name}.ply`` and ``{name}.npz``, and if wanted ``{name}.png``, for every input.

    The PLY file holds the chosen points, with normals and labels if there are any. The NPZ file holds the arrays
    ``indices`` (into the input) and ``points``; for a mesh ``cloud``, the points drawn on it, to which the indices
    refer; for a sampler that measures the local feature size ``local_feature_size`` of all points, ``skeleton_points``
    and ``skeleton_radii``. A file that fails does not stop the others.

    Parameters
    ----------
    inputs
        Clouds or meshes; a folder stands for the supported files in it.
    folder
        Where to write.
    config
        Composed configuration: seed, sampling, samplers, surface, watertight, skeleton and methods are used.
    request
        What to do.
    progress
        Show a progress bar.

    Returns
    -------
    BatchResult
        Files written, and the reason for each input that failed.

    Raises
    ------
    InputError
        If there is no input, two inputs would be written to the same name, a result would overwrite its input, or a
        network's file is missing or of another kind.
    ConfigError
        If the request contradicts itself, or names a sampler or a reconstruction that does not exist.
    """
    sampler = prepare_sampler(config, request)
    files = name_outputs(inputs)
    _check_outputs(files, folder)
    result = BatchResult([], {})
    for name, path in track(files.items(), "choose points", show=progress):
        try:
            result.written.extend(_sample_file(path, name, folder, sampler, plot=request.plot))
        except MorphoSkelError as error:
            result.failures[path] = str(error)
        except Exception as error:
            # A native library gave up, or we have a defect: show where, and do the other files all the same.
            logger.exception("%s: unexpected error", path)
            result.failures[path] = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
    return result


def prepare_sampler(config: Config, request: SamplingRequest) -> ShapeSampler:
    """Check a request, and read the networks that it names.

    Raises
    ------
    InputError
        If a network's file is missing or of another kind.
    ConfigError
        If the request contradicts itself, or names a sampler or a reconstruction that does not exist.
    """
    check_sampler(request.sampler)
    _check_networks(request)
    lfs = config.samplers.lfs
    if request.sampler == "lfs" and lfs is None:
        raise ConfigError("sampler 'lfs' is not configured; add it to the group, for example sampler=[lfs]")
    networks: dict[str, Any] = {}
    count = request.points
    if request.network is not None:
        from morphoskel.sampling.trained import load_skeleton_network, load_trained

        networks["network"] = load_trained(request.sampler, request.network)
        if request.skeleton_network is not None:
            networks["skeleton_network"] = load_skeleton_network(request.skeleton_network)
        trained = networks["network"].samples
        if count not in (None, trained):
            raise ConfigError(
                f"points: {request.network} was trained to choose {trained} points and cannot choose {count}; leave "
                "the number out, or take another network"
            )
        count = trained
    count = DEFAULT_POINTS if count is None else count
    origin = networks["network"].origin if networks else {}
    if count < MINIMUM_DISTINCT_POINTS:
        raise ConfigError(f"points: expected at least {MINIMUM_DISTINCT_POINTS}, fewer are no cloud; got {count}")
    return ShapeSampler(
        request.sampler,
        count,
        config.seed,
        _skeletonization(config, request),
        None if lfs is None else LfsSettings(**lfs.model_dump()),
        PriorSettings(**origin.get("prior", config.sampling.prior.model_dump())),
        origin.get("points", config.sampling.points),
        noise=request.noise,
        **networks,
    )


def _skeletonization(config: Config, request: SamplingRequest) -> dict[str, Any]:
    """Return the arguments of the skeleton method; none if there is no skeleton, or a network predicts it."""
    method = SKELETON_OF.get(request.sampler, LEARNED_SKELETON)
    if method == LEARNED_SKELETON:
        return {}
    if method == "ms3d":
        method = config.sampling.skeleton
    return arguments_of(config, method, request.surface or config.sampling.surface)


def _check_networks(request: SamplingRequest) -> None:
    """Refuse a network that is missing, or that the sampler has no use for, and noise where nothing is drawn."""
    sampler = request.sampler
    if sampler in LEARNED and request.network is None:
        raise ConfigError(f"sampler {sampler!r} needs a trained network; name its file with --network")
    if sampler not in LEARNED and request.network is not None:
        raise ConfigError(f"sampler {sampler!r} has no network; leave --network out, or choose {', '.join(LEARNED)}")
    learned_skeleton = SKELETON_OF.get(sampler) == LEARNED_SKELETON
    if learned_skeleton and request.skeleton_network is None:
        raise ConfigError(
            f"sampler {sampler!r} needs the network that predicts its skeletons; name its file with --skeleton-network"
        )
    if not learned_skeleton and request.skeleton_network is not None:
        raise ConfigError(f"sampler {sampler!r} predicts no skeleton; leave --skeleton-network out")
    if request.noise and sampler not in PRIORS:
        raise ConfigError(f"sampler {sampler!r} draws nothing by a network; leave --noise out")


def _check_outputs(files: dict[str, Path], folder: Path) -> None:
    """Refuse to overwrite an input."""
    for name, path in files.items():
        if path.resolve().parent == folder.resolve() and path.suffix in (".ply", ".npz", ".png"):
            raise InputError(f"{path} would be overwritten by the points chosen as {name!r}; write to another folder")


def _sample_file(path: Path, name: str, folder: Path, sampler: ShapeSampler, *, plot: bool) -> list[Path]:
    from morphoskel.formats import read_shape, write_cloud_ply

    shape = read_shape(path)
    result = sampler(shape, name)
    folder.mkdir(parents=True, exist_ok=True)
    written = [folder / f"{name}.ply", folder / f"{name}.npz"]
    write_cloud_ply(written[0], result.chosen)
    _write_arrays(written[1], result, with_cloud=isinstance(shape, Mesh))
    if plot:
        from morphoskel.reporting.sample_picture import draw_sample

        written.append(folder / f"{name}.png")
        draw_sample(written[-1], result.cloud, result.indices, result.sizes, title=name)
    by_network = "" if result.chosen_by_network is None else f", {result.chosen_by_network} of them by the network"
    logger.info("%s: chose %d of %d points%s", path, len(result.indices), len(result.cloud), by_network)
    return written


def _write_arrays(path: Path, result: SampledShape, *, with_cloud: bool) -> None:
    arrays: dict[str, Any] = {"indices": result.indices, "points": result.cloud.points[result.indices]}
    if with_cloud:
        arrays["cloud"] = result.cloud.points
    if result.skeleton is not None and result.sizes is not None:
        arrays["local_feature_size"] = result.sizes
        arrays["skeleton_points"], arrays["skeleton_radii"] = result.skeleton.points, result.skeleton.radii
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez(stream, **arrays)
