"""What flows through the chain: point clouds, triangle meshes and skeletons.

The classes validate themselves on construction, so that a function that receives one need not check it again.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

MINIMUM_DISTINCT_POINTS = 4
"""Fewer distinct points span no volume, so no surface can be rebuilt from them."""


@dataclass(frozen=True, eq=False)
class PointCloud:
    """Points on the surface of a shape.

    Parameters
    ----------
    points
        ``(N, 3)`` float64, finite, at least four of them distinct, in the data set's own units.
    normals
        ``(N, 3)`` float64, outward, unit length; a zero row means that the normal is unknown. ``None`` if
        the source has no normals at all.
    labels
        ``(N,)`` int64, the part that each point belongs to, or ``None``.

    Raises
    ------
    InputError
        If an array has the wrong shape, a value is not finite, or too few points are distinct.
    """

    points: FloatArray
    normals: FloatArray | None = None
    labels: IntArray | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _finite_rows(self.points, "points"))
        distinct = _count_distinct(self.points)
        if distinct < MINIMUM_DISTINCT_POINTS:
            raise InputError(
                f"a point cloud needs at least {MINIMUM_DISTINCT_POINTS} distinct points to enclose a volume; "
                f"this one has {len(self.points)} points, {distinct} of them distinct"
            )
        if self.normals is not None:
            object.__setattr__(self, "normals", _finite_rows(self.normals, "normals", len(self.points)))
        if self.labels is not None:
            labels = np.ascontiguousarray(self.labels, dtype=np.int64)
            if labels.shape != (len(self.points),):
                raise InputError(f"labels: expected shape ({len(self.points)},), one a point, got {labels.shape}")
            object.__setattr__(self, "labels", labels)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        extras = [name for name in ("normals", "labels") if getattr(self, name) is not None]
        return f"PointCloud({len(self)} points{''.join(f', {name}' for name in extras)})"


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh.

    Parameters
    ----------
    vertices
        ``(V, 3)`` float64, finite.
    triangles
        ``(T, 3)`` int64 indices into `vertices`, counter-clockwise seen from outside.

    Raises
    ------
    InputError
        If an array has the wrong shape, a coordinate is not finite, an index is out of range, or the mesh
        has no triangle.
    """

    vertices: FloatArray
    triangles: IntArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", _finite_rows(self.vertices, "vertices"))
        triangles = np.ascontiguousarray(self.triangles, dtype=np.int64)
        if triangles.ndim != 2 or triangles.shape[1] != 3 or len(triangles) == 0:
            raise InputError(f"triangles: expected shape (T, 3) with T >= 1, got {triangles.shape}")
        low, high = int(triangles.min()), int(triangles.max())
        if low < 0 or high >= len(self.vertices):
            raise InputError(
                f"triangles: indices must lie in [0, {len(self.vertices)}), the range of the vertices; "
                f"found {low} to {high}"
            )
        object.__setattr__(self, "triangles", triangles)

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper corner, each ``(3,)``, of the axis-aligned box around the triangles."""
        used = self.vertices[np.unique(self.triangles)]
        return used.min(axis=0), used.max(axis=0)

    def __repr__(self) -> str:
        return f"Mesh({len(self.vertices)} vertices, {len(self.triangles)} triangles)"


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Skeletal balls, best first where the method ranks them, and how they hang together where it says so.

    Parameters
    ----------
    points
        ``(K, 3)`` float64, the centres.
    radii
        ``(K,)`` float64, in the shape's units: distance from each centre to the surface.
    residues
        ``(K,)`` float64, dilation minus UDF (paper, Eq. 5): 0 at an exact local maximum. ``None`` from a method
        that does not dilate.
    edges
        ``(E, 2)`` int64, pairs of centres that are joined by a piece of curve; none by default.
    triangles
        ``(T, 3)`` int64, triples of centres that span a piece of sheet; none by default.

    Raises
    ------
    InputError
        If the arrays do not match each other, a value is not finite, a radius or residue is negative, or an index is
        out of range.
    """

    points: FloatArray
    radii: FloatArray
    residues: FloatArray | None = None
    edges: IntArray = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    triangles: IntArray = field(default_factory=lambda: np.empty((0, 3), dtype=np.int64))

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _finite_rows(self.points, "points"))
        for name in ("radii", "residues") if self.residues is not None else ("radii",):
            values = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            if values.shape != (len(self.points),):
                raise InputError(f"{name}: expected shape ({len(self.points)},), one a centre, got {values.shape}")
            if not np.isfinite(values).all() or (values < 0).any():
                raise InputError(f"{name}: every value must be finite and at least 0")
            object.__setattr__(self, name, values)
        for name, corners in (("edges", 2), ("triangles", 3)):
            indices = np.ascontiguousarray(getattr(self, name), dtype=np.int64)
            if indices.ndim != 2 or indices.shape[1] != corners:
                raise InputError(f"{name}: expected shape (N, {corners}), got {indices.shape}")
            if len(indices) and not (indices.min() >= 0 and indices.max() < len(self.points)):
                raise InputError(f"{name}: indices must lie in [0, {len(self.points)}), the range of the centres")
            object.__setattr__(self, name, indices)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        if len(self) == 0:
            return "Skeleton(0 balls)"
        details = [f"{len(self)} balls", f"radii {self.radii.min():.4g} to {self.radii.max():.4g}"]
        if self.residues is not None:
            details.append(f"largest residue {self.residues.max():.4g}")
        details += [f"{len(part)} {name}" for name in ("edges", "triangles") if len(part := getattr(self, name))]
        return f"Skeleton({', '.join(details)})"


def _finite_rows(array: npt.ArrayLike, name: str, expected_rows: int | None = None) -> FloatArray:
    """Return `array` as a contiguous ``(N, 3)`` float64 array, or say why it is none."""
    rows = np.ascontiguousarray(array, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise InputError(f"{name}: expected shape (N, 3), got {rows.shape}")
    if expected_rows is not None and len(rows) != expected_rows:
        raise InputError(f"{name}: expected {expected_rows} rows, one a point, got {len(rows)}")
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise InputError(
            f"{name}: {len(bad)} of {len(rows)} rows hold NaN or infinite values, the first is row {bad[0]}; "
            "remove or repair them"
        )
    return rows


def _count_distinct(points: FloatArray) -> int:
    """Return the number of distinct rows, counted only as far as needed to reach the minimum."""
    distinct, others = 0, points
    while len(others) and distinct < MINIMUM_DISTINCT_POINTS:
        distinct += 1
        others = others[(others != others[0]).any(axis=1)]
    return distinct
