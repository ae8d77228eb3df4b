"""Deep points consolidation: inner points and meso-skeleton."""

from morphoskel.skeleton.dpc.consolidation import deep_points
from morphoskel.skeleton.dpc.settings import DeepPointsSettings

__all__ = ["DeepPointsSettings", "deep_points"]
