"""Skeletons: centres of maximal balls."""

from morphoskel.skeleton.ms3d import ms3d
from morphoskel.skeleton.selection import select_smallest_residues

__all__ = ["ms3d", "select_smallest_residues"]
