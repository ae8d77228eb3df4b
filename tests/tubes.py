"""Noisy samples of tubes around known axes, for the tests of curve skeletons."""

import numpy as np

from morphoskel.shapes import PointCloud

RADIUS = 0.1
CYLINDER = np.array([[[0.2, -0.4, 0.1], [0.2, 0.6, 0.1]]])
"""Start and end of each axis."""
Y_SHAPE = np.array([[[0, 0, 0], [0, -1, 0]], [[0, 0, 0], [0.7, 0.7, 0]], [[0, 0, 0], [-0.7, 0.7, 0]]], dtype=float)


def noisy_tubes(axes, count, seed, noise=0.005):
    generator = np.random.default_rng(seed)
    parts = []
    for start, end in axes:
        along = (end - start) / np.linalg.norm(end - start)
        across = np.cross(along, [0, 0, 1])
        if not across.any():
            across = np.array([1.0, 0, 0])
        across /= np.linalg.norm(across)
        place, angle = generator.random(count // len(axes)), generator.uniform(0, 2 * np.pi, count // len(axes))
        ring = np.outer(np.cos(angle), across) + np.outer(np.sin(angle), np.cross(along, across))
        parts.append(start + np.outer(place, end - start) + RADIUS * ring)
    points = np.vstack(parts)
    return PointCloud(points + generator.normal(0, noise, points.shape))


def distance_to_axes(points, axes):
    distances = []
    for start, end in axes:
        along = end - start
        place = np.clip((points - start) @ along / (along @ along), 0, 1)
        distances.append(np.linalg.norm(points - start - np.outer(place, along), axis=1))
    return np.min(distances, axis=0)
