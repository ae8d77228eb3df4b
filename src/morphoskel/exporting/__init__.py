"""Skeletons as coloured meshes that other programs open."""
