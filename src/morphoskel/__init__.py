"""Morphological skeletons of 3D shapes, after *MorphoSkel3D* (3DV 2025)."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from morphoskel.formats import read_shape
    from morphoskel.shapes import Mesh, PointCloud, Skeleton
    from morphoskel.skeletonization import skeletonize

__version__ = "0.1.0"

__all__ = ["Mesh", "PointCloud", "Skeleton", "read_shape", "skeletonize"]

_HOMES = {
    "Mesh": "shapes",
    "PointCloud": "shapes",
    "Skeleton": "shapes",
    "read_shape": "formats",
    "skeletonize": "skeletonization",
}


def __getattr__(name: str) -> object:
    """Import a public name when it is first asked for, so that ``import morphoskel`` stays quick."""
    if name not in _HOMES:
        raise AttributeError(f"module 'morphoskel' has no attribute {name!r}")
    return getattr(import_module(f"morphoskel.{_HOMES[name]}"), name)
