"""Morphological skeletons of 3D shapes, after *MorphoSkel3D* (3DV 2025)."""
