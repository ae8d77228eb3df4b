"""Illustrations as files, so that figures can be drawn again without the stages being run again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.formats.assemble import as_numbers, as_whole_numbers
from morphoskel.formats.stored_arrays import read_arrays
from morphoskel.reporting.illustrate import illustrate
from morphoskel.reporting.illustrated_shapes import EXACT_SOLIDS, shape_from
from morphoskel.reporting.illustration import Illustration
from morphoskel.seeds import derive_generator
from morphoskel.shapes import Mesh

_TEXTS, _NUMBERS = ("name", "mode"), ("k", "candidate_count", "inner_count")
_SURFACE = ("vertices", "triangles")
_ARRAYS = tuple(field.name for field in fields(Illustration) if field.name not in (*_TEXTS, *_NUMBERS, "surface"))


def write_illustration(path: Path, illustration: Illustration) -> None:
    """Write an illustration as compressed NPZ file, whole or not at all."""
    arrays: dict[str, Any] = {name: getattr(illustration, name) for name in (*_TEXTS, *_NUMBERS, *_ARRAYS)}
    arrays |= {name: getattr(illustration.surface, name) for name in _SURFACE}
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez_compressed(stream, **arrays)


def read_illustration(path: Path) -> Illustration:
    """Read what :func:`write_illustration` wrote.

    Raises
    ------
    InputError
        If the file is missing, damaged, or holds something else.
    """
    arrays: dict[str, Any] = dict(read_arrays(path))
    missing = [name for name in (*_TEXTS, *_NUMBERS, *_ARRAYS, *_SURFACE) if name not in arrays]
    if missing:
        raise InputError(f"{path}: expected an illustration, but it has no {', '.join(missing)}; make it anew")
    try:
        return Illustration(
            surface=Mesh(
                as_numbers(arrays["vertices"], "vertices"), as_whole_numbers(arrays["triangles"], "triangles")
            ),
            **{name: _scalar(arrays, name, "U") for name in _TEXTS},
            **{name: _scalar(arrays, name, "i") for name in _NUMBERS},
            **{name: arrays[name] for name in _ARRAYS},
        )
    except (InputError, TypeError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error


def _scalar(arrays: dict[str, Any], name: str, kind: str) -> Any:
    value = arrays[name]
    if value.shape != () or value.dtype.kind != kind:
        raise InputError(f"{name}: expected one {'text' if kind == 'U' else 'whole number'}, got {value.dtype}")
    return value.item()


def illustrate_to_file(
    path: Path,
    source: str | Path,
    *,
    samples: int | None,
    candidates: Mapping[str, Any],
    k: int,
    points: int,
    seed: int,
    surface: str = "poisson",
    reconstruction: Mapping[str, Any] | None = None,
    watertight_settings: Mapping[str, Any] | None = None,
    threads: int = 0,
) -> None:
    """Take a named shape or one from a file through the chain, and write what lies between.

    Parameters
    ----------
    path
        The NPZ file to write.
    source
        See :func:`~morphoskel.reporting.illustrated_shapes.shape_from`. A file's shape is called by its stem.
    samples
        Of a mesh: draw as many points on it and rebuild the surface from them; ``None`` closes the mesh itself. The
        exact solids are taken as they are in any case.
    candidates, k, points, seed, surface, reconstruction, watertight_settings, threads
        As for :func:`~morphoskel.reporting.illustrate.illustrate`.

    Raises
    ------
    InputError
        If there is no such shape, or its file cannot be read.
    ConfigError, ShapeError
        As from :func:`~morphoskel.reporting.illustrate.illustrate`.
    """
    name, exact = Path(source).stem, source in EXACT_SOLIDS
    shape = shape_from(source, samples=None if exact else samples, generator=derive_generator(seed, name, "sample"))
    illustration = illustrate(
        shape,
        name=name,
        candidates=candidates,
        k=k,
        points=points,
        seed=seed,
        surface=surface,
        reconstruction=reconstruction,
        watertight_settings=watertight_settings,
        is_closed=exact,
        threads=threads,
    )
    write_illustration(path, illustration)
