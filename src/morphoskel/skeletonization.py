"""Skeletonize one shape in one call, without the workflow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from morphoskel.cores import available_cores
from morphoskel.errors import ConfigError, InputError
from morphoskel.methods import CLOUD_METHODS, check_method
from morphoskel.placement import bring_back, bring_near
from morphoskel.seeds import derive_generator, derive_seed
from morphoskel.shapes import FloatArray, Mesh, PointCloud, Skeleton

DEFAULT_SEED = 20250325

MESH_SAMPLES = 2000
"""Points drawn on a mesh for a method that needs a cloud: the size of the clouds on which the paper compares methods,
which their settings suit. More points make the coverage selection worse unless the candidates grow with them, because
a point must have several candidates to choose from."""


@dataclass(frozen=True, eq=False)
class SkeletonizedShape:
    """A skeleton and the closed surface that it was found in; ``None`` from a method that reads the cloud alone."""

    skeleton: Skeleton
    surface: Mesh | None


def skeletonize(
    shape: PointCloud | Mesh | npt.ArrayLike,
    *,
    method: str = "ms3d_coverage",
    surface: str = "repaired_poisson",
    normals: FloatArray | None = None,
    candidates: int = 1_000_000,
    mode: Literal["random", "grid"] = "random",
    k: int = 20,
    points: int = 1024,
    settings: Mapping[str, Any] | None = None,
    network: Path | str | None = None,
    seed: int = DEFAULT_SEED,
    threads: int = 0,
) -> Skeleton:
    """Return the skeleton of a cloud or a mesh.

    The defaults give the best balls; the paper's method is ``method="ms3d", surface="poisson"``.

    Parameters
    ----------
    shape
        A :class:`PointCloud`, a :class:`Mesh` (open or closed), or an ``(N, 3)`` array of points.
    method
        Inside a closed surface: ``ms3d``, maximal balls of smallest residue; ``ms3d_coverage``, maximal balls that
        together explain the surface; ``coverage_axis``, Coverage Axis++. On the cloud alone: ``l1_medial``, the
        L1-medial skeleton; ``dpc``, deep points consolidation; ``point2skeleton``, a trained network.
    surface
        How a cloud's surface is rebuilt, for a method that needs one: ``poisson``, ``ball_pivoting``,
        ``alpha_shape``, ``ponq``, or ``repaired_poisson``, which mends what contradicts the cloud.
    normals
        ``(N, 3)`` outward normals, where `shape` is an array and they are known.
    candidates
        Points scattered in the bounding box of the surface; the paper uses 10 million.
    mode
        ``random`` or ``grid``.
    k
        Size of the structuring element of ``ms3d`` and ``ms3d_coverage``, the point itself included.
    points
        Balls kept inside a surface. The methods on the cloud alone find their own number.
    settings
        Other settings of the method, see its function in :mod:`morphoskel.skeleton`.
    network
        File with a trained network, for ``point2skeleton``.
    seed
        The same seed gives the same skeleton, bit for bit.
    threads
        Native threads; 0 means all cores. Does not change the result.

    Returns
    -------
    Skeleton
        Centres and radii in the shape's unit, best first where the method ranks them; residues of maximal balls;
        edges and triangles where the method joins its centres.

    Raises
    ------
    InputError
        If the input is no cloud and no mesh.
    ConfigError
        If a name or a setting is not legal, or the network is missing.
    ShapeError
        If no surface can be rebuilt, nothing lies inside it, or the method finds no skeleton.

    Examples
    --------
    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(subdivisions=4)
    >>> skeleton = skeletonize(Mesh(ball.vertices, ball.faces), candidates=20_000, points=1)
    >>> bool(abs(skeleton.radii[0] - 1) < 0.1)
    True
    """
    if not isinstance(shape, PointCloud | Mesh):
        shape = PointCloud(_as_points(shape), normals)
    elif normals is not None:
        raise InputError("normals: give them inside the point cloud; they are read only beside an array of points")
    return skeletonize_shape(
        shape,
        method=method,
        surface=surface,
        candidates={"mode": mode, "count": candidates},
        k=k,
        points=points,
        settings=settings,
        network=network,
        seed=seed,
        threads=threads,
    ).skeleton


def skeletonize_shape(
    shape: PointCloud | Mesh,
    *,
    method: str = "ms3d",
    surface: str = "poisson",
    reconstruction: Mapping[str, Any] | None = None,
    watertight_settings: Mapping[str, Any] | None = None,
    candidates: Mapping[str, Any],
    k: int,
    points: int,
    settings: Mapping[str, Any] | None = None,
    network: Path | str | None = None,
    seed: int,
    name: str = "shape",
    threads: int = 0,
) -> SkeletonizedShape:
    """Run the whole chain on one shape, with the configuration's sections as settings; by default the paper's.

    Parameters
    ----------
    shape
        A mesh is closed; a cloud's surface is rebuilt first, where the method needs one. Where a method needs a
        cloud, :data:`MESH_SAMPLES` points are drawn on a mesh, uniformly by area.
    method, settings
        Name and settings of the skeleton method.
    surface, reconstruction
        Name and settings of the reconstruction.
    watertight_settings
        Settings of the watertight conversion.
    candidates
        ``mode`` and ``count``.
    k, points
        Size of the structuring element; balls kept.
    network
        File with a trained network.
    seed, name
        Global seed and the shape's id, from which the stages' seeds are derived as in the workflow.
    threads
        Native threads; 0 means all cores.

    Returns
    -------
    SkeletonizedShape
        The skeleton and the closed surface.

    Raises
    ------
    ConfigError
        If a name or a setting is not legal, or the network is missing.
    ShapeError
        If no surface can be rebuilt, nothing lies inside it, or the method finds no skeleton.
    """
    from morphoskel.run_method import check_network, check_settings, skeleton_inside, skeleton_of_cloud
    from morphoskel.surface import reconstruct, watertight
    from morphoskel.volume import Candidates

    check_method(method)
    settings = _complete(method, settings or {})
    check_settings(method, settings)
    check_network(method, network)
    shape, offset = bring_near(shape)
    if method in CLOUD_METHODS:
        cloud = _as_cloud(shape, seed, name)
        generator = derive_generator(seed, name, method)
        skeleton = skeleton_of_cloud(method, cloud, generator, settings=settings, network=network)
        return SkeletonizedShape(bring_back(skeleton, offset), None)
    _check_volume_settings(candidates, k, points)
    mesh = shape
    if isinstance(mesh, PointCloud):
        mesh = reconstruct(mesh, surface, seed=derive_seed(seed, name, "reconstruct"), **(reconstruction or {}))
    closed = watertight(mesh, seed=derive_seed(seed, name, "watertight"), **(watertight_settings or {}))
    skeleton = skeleton_inside(
        method,
        closed,
        Candidates(*closed.bounds, **candidates, seed=derive_seed(seed, name, "occupancy")),
        None if method == "ms3d" else _as_cloud(shape, seed, name).points,
        k=k,
        points=points,
        settings=settings,
        threads=threads or available_cores(),
    )
    if offset.any():
        closed = Mesh(closed.vertices + offset, closed.triangles)
    return SkeletonizedShape(bring_back(skeleton, offset), closed)


def _complete(method: str, settings: Mapping[str, Any]) -> Mapping[str, Any]:
    """Let Coverage Axis++ choose as many balls as are asked for, as the configuration does, unless told otherwise."""
    return {"stop_when_covered": False, **settings} if method == "coverage_axis" else settings


def _check_volume_settings(candidates: Mapping[str, Any], k: int, points: int) -> None:
    """Refuse what the configuration would refuse."""
    if candidates["mode"] not in ("random", "grid"):
        raise ConfigError(f"mode: expected random or grid, got {candidates['mode']!r}")
    for name, value, least in (("candidates", candidates["count"], 8), ("k", k, 2), ("points", points, 1)):
        if value < least:
            raise ConfigError(f"{name}: expected a whole number from {least}, got {value}")


def _as_cloud(shape: PointCloud | Mesh, seed: int, name: str) -> PointCloud:
    """Return a cloud as it is, and points on a mesh."""
    from morphoskel.formats.sample import sample_surface

    if isinstance(shape, PointCloud):
        return shape
    return sample_surface(shape, MESH_SAMPLES, derive_generator(seed, name, "sample"))


def _as_points(array: npt.ArrayLike) -> FloatArray:
    try:
        return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"shape: expected a PointCloud, a Mesh or an (N, 3) array of numbers, got {type(array).__name__}; "
            "read files with morphoskel.read_shape"
        ) from error
