"""Closed surfaces whose skeletons are known."""

import numpy as np
import trimesh

from morphoskel.shapes import Mesh, PointCloud


def as_mesh(solid: trimesh.Trimesh) -> Mesh:
    return Mesh(solid.vertices, solid.faces)


def ball(radius: float = 1.0, subdivisions: int = 5) -> Mesh:
    return as_mesh(trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius))


def box(*sides: float) -> Mesh:
    return as_mesh(trimesh.creation.box(sides))


def torus(ring: float = 1.0, tube: float = 0.3) -> Mesh:
    return as_mesh(trimesh.creation.torus(ring, tube, major_sections=192, minor_sections=96))


def capsule(length: float = 2.0, radius: float = 0.5) -> Mesh:
    solid = trimesh.creation.capsule(height=length, radius=radius, count=[96, 96])
    solid.apply_translation(-solid.bounds.mean(axis=0))
    return as_mesh(solid)


def two_components() -> Mesh:
    """Two balls apart from each other, the second turned inside out with a duplicated vertex row and a sliver."""
    first, second = trimesh.creation.icosphere(subdivisions=3), trimesh.creation.icosphere(subdivisions=2, radius=0.5)
    second.apply_translation([2.5, 0, 0])
    vertices = np.vstack([first.vertices, second.vertices, first.vertices[:1]])
    return Mesh(vertices, np.vstack([first.faces, second.faces + len(first.vertices)]))


def sphere_cloud(count: int, seed: int = 0, normals: bool = True) -> PointCloud:
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return PointCloud(directions, directions if normals else None)


def random_rotation(seed: int) -> np.ndarray:
    from scipy.spatial.transform import Rotation

    return Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
