"""From a point cloud to a closed triangle mesh."""

from morphoskel.surface.reconstruct import reconstruct
from morphoskel.surface.watertight import watertight

__all__ = ["reconstruct", "watertight"]
