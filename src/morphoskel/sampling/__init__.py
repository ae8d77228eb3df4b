"""Choosing a few of the points of a cloud."""
