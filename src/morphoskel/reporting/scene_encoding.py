"""Scenes as JSON with compressed arrays, for the script of the interactive viewer."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.reporting.scene import Layer, Scalar, Scene
from morphoskel.shapes import FloatArray, IntArray

STEPS = 65535
"""Into which the box of a layer, or the range of its values, is divided: finer than a screen shows."""

COLOUR_MAP = "viridis"
COLOURS = 256


def encode_scenes(scenes: Sequence[Scene]) -> str:
    """Return scenes as JSON that may stand in an HTML element ``script``.

    Positions and values are rounded to 16 bits within their range, radii to float32, and elements stored as
    differences, which compress well. Equal scenes give equal text.
    """
    values = {"colours": _colours(), "scenes": [_scene(scene) for scene in scenes]}
    # "</script" and "<!--" would end or change the element; JSON may write the character as an escape.
    return json.dumps(values, separators=(",", ":"), ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")


def colour_table() -> npt.NDArray[np.uint8]:
    """Return the colour map from its lower to its upper end, ``(256, 3)`` uint8 sRGB."""
    from matplotlib import colormaps

    table = colormaps[COLOUR_MAP](np.linspace(0, 1, COLOURS))[:, :3]
    return np.asarray(np.round(255 * table), dtype=np.uint8)


def _colours() -> list[str]:
    return [bytes(colour).hex() for colour in colour_table()]


def _scene(scene: Scene) -> dict[str, Any]:
    return {
        "name": scene.name,
        "up": scene.up,
        "azimuth": scene.azimuth,
        "elevation": scene.elevation,
        "layers": [_layer(layer) for layer in scene.layers],
    }


def _layer(layer: Layer) -> dict[str, Any]:
    lower, upper = layer.positions.min(axis=0), layer.positions.max(axis=0)
    encoded: dict[str, Any] = {
        "name": layer.name,
        "detail": layer.detail,
        "kind": layer.kind,
        "tone": layer.tone,
        "opacity": layer.opacity,
        "size": layer.size,
        "visible": layer.visible,
        "count": len(layer.positions),
        "lower": lower.tolist(),
        "upper": upper.tolist(),
        "positions": _pack(_steps(layer.positions, lower, upper)),
        "scalars": [_scalar(scalar) for scalar in layer.scalars],
    }
    if layer.radii is not None:
        encoded["radii"] = _pack(layer.radii.astype("<f4"))
    if layer.elements is not None:
        encoded["elements"] = _pack(_differences(layer.elements))
    return encoded


def _scalar(scalar: Scalar) -> dict[str, Any]:
    assert scalar.limits is not None  # set on construction
    low, high = scalar.limits
    return {
        "label": scalar.label,
        "low": low,
        "high": high,
        "below": bool((scalar.values < low).any()),
        "above": bool((scalar.values > high).any()),
        "values": _pack(_steps(np.clip(scalar.values, low, high), np.array(low), np.array(high))),
    }


def _steps(values: FloatArray, lower: FloatArray, upper: FloatArray) -> npt.NDArray[np.uint16]:
    """Return each value's place between `lower` and `upper` in 65535ths, 0 where these coincide."""
    # Scaled first, so that a range beyond the largest float64 does not overflow.
    extent = upper / 2 - lower / 2
    fraction = np.divide(values / 2 - lower / 2, extent, out=np.zeros_like(values), where=extent > 0)
    return np.round(STEPS * fraction).astype("<u2")


def _differences(elements: IntArray) -> npt.NDArray[np.int32]:
    """Return the difference of each index to the one before it, the first to 0."""
    return np.diff(elements.reshape(-1), prepend=0).astype("<i4")


def _pack(array: npt.NDArray[Any]) -> str:
    """Return the bytes of an array, all first bytes of its numbers before all second ones, compressed, as base64."""
    rows = np.frombuffer(array.tobytes(), dtype=np.uint8).reshape(-1, array.dtype.itemsize)
    return base64.b64encode(zlib.compress(rows.T.tobytes(), 9)).decode("ascii")
