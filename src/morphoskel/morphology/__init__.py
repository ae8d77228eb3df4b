"""Morphology of functions on a point cloud."""

from morphoskel.morphology.dilation import dilation
from morphoskel.morphology.residue import residue

__all__ = ["dilation", "residue"]
