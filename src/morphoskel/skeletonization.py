"""Skeletonize one shape in one call, without the workflow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from morphoskel.cores import available_cores
from morphoskel.errors import InputError
from morphoskel.seeds import derive_seed
from morphoskel.shapes import FloatArray, Mesh, PointCloud, Skeleton

DEFAULT_SEED = 20250325


@dataclass(frozen=True, eq=False)
class SkeletonizedShape:
    """A skeleton and the closed surface that it was found in."""

    skeleton: Skeleton
    surface: Mesh


def skeletonize(
    shape: PointCloud | Mesh | npt.ArrayLike,
    *,
    normals: FloatArray | None = None,
    surface: str = "poisson",
    candidates: int = 1_000_000,
    mode: Literal["random", "grid"] = "random",
    k: int = 20,
    points: int = 1024,
    seed: int = DEFAULT_SEED,
    threads: int = 0,
) -> Skeleton:
    """Return the morphological skeleton of a cloud or a mesh.

    Parameters
    ----------
    shape
        A :class:`PointCloud`, a :class:`Mesh` (open or closed), or an ``(N, 3)`` array of points.
    normals
        ``(N, 3)`` outward normals, where `shape` is an array and they are known.
    surface
        How a cloud's surface is rebuilt: ``poisson``, ``ball_pivoting`` or ``alpha_shape``.
    candidates
        Points scattered in the bounding box; the paper uses 10 million.
    mode
        ``random`` or ``grid``.
    k
        Size of the structuring element, the point itself included.
    points
        Maximal balls kept.
    seed
        The same seed gives the same skeleton, bit for bit.
    threads
        Native threads; 0 means all cores. Does not change the result.

    Returns
    -------
    Skeleton
        Centres, radii and residues, smallest residue first, in the shape's unit.

    Raises
    ------
    InputError
        If the input is no cloud and no mesh.
    ShapeError
        If no surface can be rebuilt or nothing lies inside it.

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
        surface=surface,
        candidates={"mode": mode, "count": candidates},
        k=k,
        points=points,
        seed=seed,
        threads=threads,
    ).skeleton


def skeletonize_shape(
    shape: PointCloud | Mesh,
    *,
    surface: str = "poisson",
    reconstruction: Mapping[str, Any] | None = None,
    watertight_settings: Mapping[str, Any] | None = None,
    candidates: Mapping[str, Any],
    k: int,
    points: int,
    seed: int,
    name: str = "shape",
    threads: int = 0,
) -> SkeletonizedShape:
    """Run the whole chain on one shape, with the configuration's sections as settings.

    Parameters
    ----------
    shape
        A mesh is closed; a cloud's surface is rebuilt first.
    surface, reconstruction
        Name and settings of the reconstruction.
    watertight_settings
        Settings of the watertight conversion.
    candidates
        ``mode`` and ``count``.
    k, points
        Size of the structuring element; maximal balls kept.
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
    ShapeError
        If no surface can be rebuilt or nothing lies inside it.
    """
    from morphoskel.skeleton import ms3d
    from morphoskel.surface import reconstruct, watertight
    from morphoskel.volume import Candidates

    mesh = shape if isinstance(shape, Mesh) else reconstruct(shape, surface, **(reconstruction or {}))
    closed = watertight(mesh, seed=derive_seed(seed, name, "watertight"), **(watertight_settings or {}))
    box = Candidates(*closed.bounds, **candidates, seed=derive_seed(seed, name, "occupancy"))
    return SkeletonizedShape(ms3d(closed, box, k=k, points=points, threads=threads or available_cores()), closed)


def _as_points(array: npt.ArrayLike) -> FloatArray:
    try:
        return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"shape: expected a PointCloud, a Mesh or an (N, 3) array of numbers, got {type(array).__name__}; "
            "read files with morphoskel.read_shape"
        ) from error
