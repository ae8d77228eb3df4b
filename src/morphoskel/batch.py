"""Skeletonize files one after the other and write what a user wants to keep."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from morphoskel.config import Config
from morphoskel.errors import ConfigError, InputError, MorphoSkelError
from morphoskel.methods import MORPHOLOGICAL, SURFACE_METHODS, check_method
from morphoskel.progress import track

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class BatchResult:
    """What became of the input files."""

    written: list[Path]
    failures: dict[Path, str]


def skeletonize_files(
    inputs: Sequence[Path],
    folder: Path,
    config: Config,
    *,
    method: str,
    surface: str,
    network: Path | None = None,
    plot: bool = False,
    progress: bool = True,
) -> BatchResult:
    """Write ``{name}.ply`` and ``{name}.npz``, and with `plot` ``{name}.png``, for every input.

    A file that fails does not stop the others.

    Parameters
    ----------
    inputs
        Clouds or meshes; a folder stands for the supported files in it.
    folder
        Where to write.
    config
        Composed configuration: surface, watertight, skeleton, methods and seed are used.
    method
        The skeleton method.
    surface
        Which of the configured reconstructions rebuilds the surface of a cloud, for a method that needs one.
    network
        File with a trained network, for ``point2skeleton``.
    plot
        Draw a picture of each skeleton.
    progress
        Show a progress bar.

    Returns
    -------
    BatchResult
        Files written, and the reason for each input that failed.

    Raises
    ------
    InputError
        If there is no input, two inputs would be written to the same name, or there is no such network.
    ConfigError
        If the method or the reconstruction is not configured, or a network is missing or not needed.
    """
    from morphoskel.run_method import check_network

    arguments = arguments_of(config, method, surface)
    check_network(method, network)
    files = name_outputs(inputs)
    result = BatchResult([], {})
    for name, path in track(files.items(), "skeletonize", show=progress):
        try:
            result.written.extend(_skeletonize_file(path, name, folder, {**arguments, "network": network}, plot=plot))
        except MorphoSkelError as error:
            result.failures[path] = str(error)
        except Exception as error:
            # A native library gave up, or we have a defect: show where, and do the other files all the same.
            logger.exception("%s: unexpected error", path)
            result.failures[path] = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
    return result


def name_outputs(inputs: Sequence[Path]) -> dict[str, Path]:
    """Return the input files by the name of their output, folders replaced by the supported files in them.

    Raises
    ------
    InputError
        If nothing is left, a path does not exist, or two files share a name.
    """
    from morphoskel.formats import SUPPORTED_SUFFIXES

    named: dict[str, Path] = {}
    for given in inputs:
        if not given.exists():
            raise InputError(f"{given}: no such file or folder")
        found = [given] if given.is_file() else sorted(given.iterdir())
        for path in found:
            if given.is_dir() and path.suffix.lower() not in SUPPORTED_SUFFIXES:
                continue
            if path.stem in named:
                raise InputError(
                    f"{path} and {named[path.stem]} would both be written as {path.stem!r}; "
                    "rename one, or write them to different folders"
                )
            named[path.stem] = path
    if not named:
        raise InputError(
            f"no shape to skeletonize in {', '.join(map(str, inputs))}; "
            f"supported are {', '.join(sorted(SUPPORTED_SUFFIXES))}"
        )
    return named


def arguments_of(config: Config, method: str, surface: str) -> dict[str, Any]:
    """Return the arguments of :func:`~morphoskel.skeletonization.skeletonize_shape` that a configuration gives.

    Raises
    ------
    ConfigError
        If the method or the reconstruction is not configured.
    """
    check_method(method)
    arguments: dict[str, Any] = {
        "method": method,
        "candidates": config.skeleton.candidates.model_dump(),
        "k": config.skeleton.k,
        "points": config.skeleton.points,
        "seed": config.seed,
        "watertight_settings": config.watertight.model_dump(),
    }
    if method in SURFACE_METHODS:
        if surface not in config.surface.names:
            raise ConfigError(
                f"surface {surface!r} is not configured; configured are {', '.join(config.surface.names)}. Choose one "
                "of them, or add it to the group, for example surface=[poisson,repaired_poisson]"
            )
        arguments |= {"surface": surface, "reconstruction": getattr(config.surface, surface).model_dump()}
    if method in MORPHOLOGICAL:
        settings = config.skeleton.coverage.model_dump() if method == "ms3d_coverage" else {}
    else:
        settings = _other_method(config, method)
        arguments["points"] = settings.pop("points", config.skeleton.points)
    return {**arguments, "settings": settings}


def _other_method(config: Config, method: str) -> dict[str, Any]:
    section = getattr(config.methods, method)
    if section is None:
        configured = ", ".join([*MORPHOLOGICAL, *config.methods.names])
        raise ConfigError(
            f"method {method!r} is not configured; configured are {configured}. Choose one of them, or add it to the "
            f"group, for example skeleton=[ms3d,{method}]"
        )
    if method == "point2skeleton":
        return {"refine_radii": section.refine_radii}  # all else is in the network's file
    settings: dict[str, Any] = section.model_dump()
    return settings


def _skeletonize_file(path: Path, name: str, folder: Path, arguments: dict[str, Any], *, plot: bool) -> list[Path]:
    from morphoskel.formats import read_shape, write_skeleton_npz, write_skeleton_ply
    from morphoskel.skeletonization import skeletonize_shape

    result = skeletonize_shape(read_shape(path), name=name, **arguments)
    folder.mkdir(parents=True, exist_ok=True)
    written = [folder / f"{name}.ply", folder / f"{name}.npz"]
    write_skeleton_ply(written[0], result.skeleton)
    write_skeleton_npz(written[1], result.skeleton)
    if plot:
        from morphoskel.reporting.skeleton_picture import draw_skeleton

        written.append(folder / f"{name}.png")
        draw_skeleton(written[-1], result.skeleton, result.surface, title=name)
    logger.info("%s: %r", path, result.skeleton)
    return written
