"""What the interactive viewer shows: scenes of layers of points, balls, triangles and segments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import FloatArray, IntArray

Kind = Literal["points", "balls", "mesh", "segments"]
CORNERS = {"mesh": 3, "segments": 2}
"""Vertices of an element of those kinds that have elements."""


@dataclass(frozen=True, eq=False)
class Scalar:
    """A number at each vertex, point or ball, to colour it by.

    Parameters
    ----------
    label
        What it is, with its unit, as the colour bar says it.
    values
        ``(N,)`` float64, finite.
    limits
        The values at both ends of the colour bar; those beyond get the colour of the end. By default from 0 (or the
        least value, if that is negative) to the largest value.

    Raises
    ------
    InputError
        If a value is not finite, or the limits are not two finite numbers in ascending order.
    """

    label: str
    values: FloatArray
    limits: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        values = np.ascontiguousarray(self.values, dtype=np.float64)
        if values.ndim != 1 or not np.isfinite(values).all():
            raise InputError(f"{self.label}: expected finite values of shape (N,), got shape {values.shape}")
        object.__setattr__(self, "values", values)
        limits = self.limits
        if limits is None:
            limits = (min(0.0, float(values.min(initial=0))), float(values.max(initial=0)))
        if not (np.isfinite(limits).all() and limits[0] <= limits[1]):
            raise InputError(f"{self.label}: expected finite limits in ascending order, got {limits}")
        object.__setattr__(self, "limits", (float(limits[0]), float(limits[1])))


@dataclass(frozen=True, eq=False)
class Layer:
    """Something that can be shown and hidden.

    Parameters
    ----------
    name
        For readers; layers of one name in several scenes are shown and hidden together.
    kind
        ``points`` (round dots), ``balls``, ``mesh`` (triangles) or ``segments``.
    positions
        ``(N, 3)`` float64: points, centres or vertices.
    radii
        ``(N,)`` float64, for balls only.
    elements
        ``(T, 3)`` or ``(E, 2)`` int64, the triangles or segments as indices into `positions`.
    scalars
        To colour by; the first is shown, and readers choose among several. Without any, `tone` decides.
    tone
        ``muted`` or ``strong``: the colour of a layer without scalars, which suits a light and a dark page.
    opacity
        Of a mesh where it faces the viewer, in (0, 1]; its outline is denser.
    size
        Of points, relative to a size that suits their number.
    visible
        Whether the layer is shown at first.
    detail
        Said behind the name: how many points there are, what was left out.

    Raises
    ------
    InputError
        If the arrays do not match each other or the kind, or a number is out of range.
    """

    name: str
    kind: Kind
    positions: FloatArray
    radii: FloatArray | None = None
    elements: IntArray | None = None
    scalars: Sequence[Scalar] = ()
    tone: Literal["muted", "strong"] = "muted"
    opacity: float = 0.2
    size: float = 1.0
    visible: bool = True
    detail: str = ""

    def __post_init__(self) -> None:
        if self.kind not in get_args(Kind):
            raise InputError(f"{self.name}: expected a kind among {', '.join(get_args(Kind))}, got {self.kind!r}")
        positions = np.ascontiguousarray(self.positions, dtype=np.float64)
        if positions.ndim != 2 or positions.shape[1] != 3 or not len(positions) or not np.isfinite(positions).all():
            raise InputError(f"{self.name}: expected finite positions (N, 3) with N >= 1, got shape {positions.shape}")
        object.__setattr__(self, "positions", positions)
        self._check_radii()
        self._check_elements()
        for scalar in self.scalars:
            if len(scalar.values) != len(positions):
                raise InputError(f"{self.name}: {len(scalar.values)} values of {scalar.label} for {len(positions)}")
        if not (0 < self.opacity <= 1 and self.size > 0):
            raise InputError(f"{self.name}: expected an opacity in (0, 1] and a positive size")

    def _check_radii(self) -> None:
        if (self.kind == "balls") != (self.radii is not None):
            raise InputError(f"{self.name}: balls need radii, and other kinds have none")
        if self.radii is not None:
            radii = np.ascontiguousarray(self.radii, dtype=np.float64)
            if radii.shape != (len(self.positions),) or not (np.isfinite(radii) & (radii >= 0)).all():
                raise InputError(f"{self.name}: expected {len(self.positions)} finite radii of at least 0")
            object.__setattr__(self, "radii", radii)

    def _check_elements(self) -> None:
        corners = CORNERS.get(self.kind)
        if (corners is None) != (self.elements is None):
            raise InputError(f"{self.name}: a mesh and segments need elements, and other kinds have none")
        if self.elements is not None:
            elements = np.ascontiguousarray(self.elements, dtype=np.int64)
            if elements.ndim != 2 or elements.shape[1] != corners or not len(elements):
                raise InputError(f"{self.name}: expected elements (T, {corners}), got shape {elements.shape}")
            if elements.min() < 0 or elements.max() >= len(self.positions):
                raise InputError(f"{self.name}: elements must be indices in [0, {len(self.positions)})")
            object.__setattr__(self, "elements", elements)


@dataclass(frozen=True, eq=False)
class Scene:
    """Layers that are shown together.

    Parameters
    ----------
    name
        For the list that readers choose from.
    layers
        At least one.
    up
        The axis that points up on the screen.
    azimuth, elevation
        Degrees; from where it is seen at first. At 0 and 0, with y up, the camera looks along -z.

    Raises
    ------
    InputError
        If there is no layer, or two have the same name.
    """

    name: str
    layers: Sequence[Layer]
    up: Literal["y", "z"] = "y"
    azimuth: float = 35.0
    elevation: float = 20.0

    def __post_init__(self) -> None:
        names = [layer.name for layer in self.layers]
        if not names:
            raise InputError(f"{self.name}: a scene needs at least one layer")
        if len(set(names)) < len(names):
            raise InputError(f"{self.name}: layers need names of their own, got {', '.join(names)}")
        if self.up not in ("y", "z"):
            raise InputError(f"{self.name}: expected y or z to be up, got {self.up!r}")
