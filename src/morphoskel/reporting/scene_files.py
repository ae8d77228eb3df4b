"""Scenes of the interactive viewer from files: skeletons, clouds, meshes, and points chosen from them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.formats.assemble import as_numbers, as_whole_numbers
from morphoskel.formats.skeleton_file import read_skeleton_or_shape
from morphoskel.formats.stored_arrays import read_arrays
from morphoskel.progress import track
from morphoskel.reporting.scene import Layer, Scalar, Scene
from morphoskel.reporting.scene_layers import cloud_layer, feature_size_scalar, mesh_layer, skeleton_layers
from morphoskel.shapes import FloatArray, Mesh, PointCloud, Skeleton

CHOSEN_SIZE = 1.8
"""Of chosen points, relative to those of the cloud that they were chosen from."""

Arrays = Mapping[str, npt.NDArray[Any]]


@dataclass(frozen=True, eq=False)
class _Chosen:
    """What `morphoskel sample` stores of one shape."""

    points: FloatArray
    indices: npt.NDArray[np.int64]
    cloud: PointCloud | None
    sizes: FloatArray | None
    skeleton: Skeleton | None


_Content = Skeleton | PointCloud | Mesh | _Chosen
_KINDS: Mapping[type, str] = {Skeleton: "skeleton", PointCloud: "cloud", Mesh: "surface", _Chosen: "chosen points"}


def scenes_of_files(
    paths: Sequence[Path],
    *,
    together: bool = False,
    up: Literal["y", "z"] = "y",
    azimuth: float = 35.0,
    elevation: float = 20.0,
) -> list[Scene]:
    """Read files and return a scene for each name among them: ``out/dragon.ply`` and ``dragon.obj`` share one.

    Parameters
    ----------
    paths
        Skeletons (``.ply`` with radii, ``.npz``, ``.ma``), clouds, meshes, and the ``.npz`` files of
        `morphoskel sample`. Where such a file and the cloud that it was chosen from share a scene, the cloud is
        coloured by its local feature size, if that was measured.
    together
        Put all files into one scene, whatever their names.
    up, azimuth, elevation
        Of the scenes.

    Raises
    ------
    InputError
        If there is no file, or one of them is missing, a folder, damaged, or named twice.
    """
    if not paths:
        raise InputError("expected at least one file to show, got none")
    groups: dict[str, list[Path]] = {}
    for path in paths:
        if path.is_dir():
            raise InputError(f"{path}: is a folder; name the files in it, for example {path}/*.npz")
        if any(path.resolve() == other.resolve() for group in groups.values() for other in group):
            raise InputError(f"{path}: named twice; name each file once")
        groups.setdefault(paths[0].stem if together else path.stem, []).append(path)
    return [
        Scene(name, _layers(group), up=up, azimuth=azimuth, elevation=elevation)
        for name, group in track(groups.items(), "read", unit="scene")
    ]


def _layers(paths: Sequence[Path]) -> list[Layer]:
    """Return the layers of the files of one scene.

    Surfaces alone are opaque, and around others translucent. Of several skeletons, which would hide each other, only
    the first is visible at first.
    """
    contents = {path: _read(path) for path in paths}
    chosen = [content for content in contents.values() if isinstance(content, _Chosen)]
    layers: list[Layer] = []
    first_skeleton = next((path for path, content in contents.items() if isinstance(content, Skeleton)), None)
    for path, content in contents.items():
        name = _name(path, contents)
        if isinstance(content, _Chosen):
            layers += _chosen_layers(content, name)
        elif isinstance(content, Skeleton):
            layers += skeleton_layers(content, name, visible=path == first_skeleton)
        elif isinstance(content, Mesh):
            layers.append(mesh_layer(content, name))
        else:
            sizes = next((each.sizes for each in chosen if _describes(each, content)), None)
            layers.append(cloud_layer(content, name, sizes=sizes))
    if all(layer.kind == "mesh" for layer in layers):
        layers = [replace(layer, opacity=1.0) for layer in layers]
    return layers


def _read(path: Path) -> _Content:
    if path.suffix.lower() == ".npz":
        arrays = read_arrays(path)
        if {"points", "indices"} <= arrays.keys():
            return _chosen(path, arrays)
    return read_skeleton_or_shape(path)


def _chosen(path: Path, arrays: Arrays) -> _Chosen:
    """Return what a file of `morphoskel sample` holds."""
    try:
        indices = as_whole_numbers(arrays["indices"], "indices")
        numbers = {name: as_numbers(array, name) for name, array in arrays.items() if name != "indices"}
        points, sizes = PointCloud(numbers["points"]).points, numbers.get("local_feature_size")
        cloud = PointCloud(numbers["cloud"]) if "cloud" in numbers else None
        skeleton = None
        if {"skeleton_points", "skeleton_radii"} <= numbers.keys():
            skeleton = Skeleton(numbers["skeleton_points"], numbers["skeleton_radii"])
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    count = len(cloud) if cloud is not None else None if sizes is None else len(sizes)
    fits = indices.shape == (len(points),) and (indices >= 0).all() and (count is None or (indices < count).all())
    if not fits or (sizes is not None and sizes.shape != (count,)):
        raise InputError(f"{path}: its arrays do not match each other; choose the points anew with `morphoskel sample`")
    if sizes is not None and not (np.isfinite(sizes) & (sizes >= 0)).all():
        raise InputError(
            f"{path}: local_feature_size: expected finite distances, none below 0; choose the points anew with "
            "`morphoskel sample`"
        )
    return _Chosen(points, indices, cloud, sizes, skeleton)


def _describes(chosen: _Chosen, cloud: PointCloud) -> bool:
    """Whether the points were chosen from this cloud, and the size of each of its points is known."""
    if chosen.sizes is None or chosen.cloud is not None or len(chosen.sizes) != len(cloud):
        return False
    return bool(np.allclose(cloud.points[chosen.indices], chosen.points))


def _chosen_layers(chosen: _Chosen, name: str) -> list[Layer]:
    scalars: tuple[Scalar, ...] = ()
    if chosen.sizes is not None:
        scalars = (feature_size_scalar(chosen.sizes, chosen.sizes[chosen.indices]),)
    layers = [
        Layer(name, "points", chosen.points, scalars=scalars, tone="strong", size=CHOSEN_SIZE,
              detail=f"{len(chosen.points):,} points")
    ]  # fmt: skip
    if chosen.cloud is not None:
        layers.append(cloud_layer(chosen.cloud, f"{name}, cloud", sizes=chosen.sizes))
    if chosen.skeleton is not None and len(chosen.skeleton):
        layers += skeleton_layers(chosen.skeleton, f"{name}, skeleton", visible=False)
    return layers


def _name(path: Path, contents: Mapping[Path, _Content]) -> str:
    """Return what a file's layer is called: by its kind where that is enough, so that all scenes have equal names."""
    if len({other.stem for other in contents}) > 1:
        return _distinct_end(path, list(contents))
    kind = _KINDS[type(contents[path])]
    rivals = [other for other, content in contents.items() if type(content) is type(contents[path])]
    if len(rivals) == 1:
        return kind
    folders = [other.parent for other in rivals]
    if len(set(folders)) == len(rivals):
        return f"{kind} {_distinct_end(path.parent, folders)}"
    return f"{kind} {_distinct_end(path, rivals)}"


def _distinct_end(path: Path, paths: Sequence[Path]) -> str:
    """Return as many of the path's last parts as set it apart from the others."""
    for count in range(1, len(path.parts) + 1):
        if sum(other.parts[-count:] == path.parts[-count:] for other in paths) == 1:
            return "/".join(path.parts[-count:])
    return str(path)
