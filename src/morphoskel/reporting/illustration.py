"""What lies between a shape and its skeleton: the product of every stage of MorphoSkel3D, for figures of the method."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray, Mesh, Skeleton

MODES = ("random", "grid")


@dataclass(frozen=True, eq=False)
class Illustration:
    """What the stages of the chain made of one shape; of what is too much to draw, a random part.

    Parameters
    ----------
    name
        Of the shape.
    cloud
        ``(P, 3)`` float64, a part of the input cloud, or points drawn on the input mesh.
    surface
        The closed surface.
    mode
        How the candidates are placed, ``random`` or ``grid``.
    k
        Size of the structuring element, the point itself included.
    candidate_count, inner_count
        Number of candidates, and of those that lie inside.
    candidates, inside
        ``(C, 3)`` float64, a random part of the candidates, and ``(C,)`` bool, which of them lie inside.
    inner
        ``(M, 3)`` float64, a random part of the inner points, and all that were selected.
    udf, dilated
        ``(M,)`` float32, their distance to the surface, and its dilation over all inner points, those left out, too.
    selected
        ``(K,)`` int64, rows of `inner` that form the skeleton, smallest residue first.
    residue_edges, residue_counts
        ``(B + 1,)`` float64 and ``(B,)`` int64, distribution of the residues of all inner points; the first bin begins
        at 0 and holds the local maxima of the UDF.

    Raises
    ------
    InputError
        If the arrays contradict each other.
    """

    name: str
    cloud: FloatArray
    surface: Mesh
    mode: str
    k: int
    candidate_count: int
    inner_count: int
    candidates: FloatArray
    inside: npt.NDArray[np.bool_]
    inner: FloatArray
    udf: npt.NDArray[np.float32]
    dilated: npt.NDArray[np.float32]
    selected: IntArray
    residue_edges: FloatArray
    residue_counts: IntArray

    def __post_init__(self) -> None:
        for name in ("cloud", "candidates", "inner"):
            _check_array(name, getattr(self, name), "f", (None, 3))
        for name in ("selected", "residue_counts"):
            _check_array(name, getattr(self, name), "i", (None,))
        for name in ("udf", "dilated"):
            _check_array(name, getattr(self, name), "f", (len(self.inner),))
        _check_array("inside", self.inside, "b", (len(self.candidates),))
        _check_array("residue_edges", self.residue_edges, "f", (len(self.residue_counts) + 1,))
        self._check_values()

    def _check_values(self) -> None:
        rows, counted = self.selected, int(self.residue_counts.sum())
        _require(self.mode in MODES, f"mode: expected {' or '.join(MODES)}, got {self.mode!r}")
        _require((self.udf >= 0).all() and (self.dilated >= self.udf).all(), "expected 0 <= udf <= dilated everywhere")
        _require(
            len(rows) > 0 and len(np.unique(rows)) == len(rows) and rows.min() >= 0 and rows.max() < len(self.inner),
            f"selected: expected at least one, and distinct, of the rows 0 to {len(self.inner) - 1}",
        )
        _require((np.diff(self.residue_edges) > 0).all(), "residue_edges: expected increasing numbers")
        _require(counted == self.inner_count, f"residue_counts: expected the sum {self.inner_count}, got {counted}")
        _require(
            len(self.inner) <= self.inner_count <= self.candidate_count,
            f"{len(self.inner)} inner points kept of {self.inner_count}, of {self.candidate_count} candidates: "
            "expected no part to be larger than the whole",
        )

    @property
    def residues(self) -> npt.NDArray[np.float32]:
        """``(M,)`` float32, dilation minus UDF."""
        from morphoskel.morphology.residue import residue

        return residue(self.udf, self.dilated)

    @property
    def skeleton(self) -> Skeleton:
        """The points selected, smallest residue first, as balls."""
        rows = self.selected
        radii, residues = (values[rows].astype(np.float64) for values in (self.udf, self.residues))
        return Skeleton(self.inner[rows], radii, residues)

    @property
    def spacing(self) -> float:
        """Mean distance of neighbouring points among the inner points kept, in the shape's unit."""
        lower, upper = self.surface.bounds
        volume = float(np.prod(upper - lower)) * self.inner_count / self.candidate_count
        return float((volume / len(self.inner)) ** (1 / 3))


def _check_array(name: str, array: npt.NDArray[Any], kind: str, shape: tuple[int | None, ...]) -> None:
    """Refuse an array of another kind of numbers or another shape, where ``None`` is any length, or not finite."""
    _require(array.dtype.kind == kind, f"{name}: unexpected kind of numbers, {array.dtype}")
    fits = array.ndim == len(shape) and all(want in (None, have) for want, have in zip(shape, array.shape, strict=True))
    _require(fits, f"{name}: expected shape {shape}, got {array.shape}")
    _require(np.isfinite(array).all(), f"{name}: expected finite numbers")


def _require(condition: bool | np.bool_, message: str) -> None:
    if not condition:
        raise InputError(f"the illustration contradicts itself: {message}; make it anew")
