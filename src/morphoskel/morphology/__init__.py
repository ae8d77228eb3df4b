"""Morphology of functions on a point cloud."""

from morphoskel.morphology.dilation import dilation
from morphoskel.morphology.erosion import erosion
from morphoskel.morphology.opening import opening
from morphoskel.morphology.residue import residue

__all__ = ["dilation", "erosion", "opening", "residue"]
