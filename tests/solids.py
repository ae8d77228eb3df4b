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


def random_parts(seed: int) -> list[Mesh]:
    """Closed solids of random size and place: some thin, overlapping, nested or inside out, with slivers and triangle
    soups whose vertices are all duplicated."""
    generator = np.random.default_rng(seed)
    parts = []
    for _ in range(generator.integers(1, 5)):
        sides = generator.choice([0.01, 0.3, 1.0], size=3) * generator.uniform(0.5, 1.5, 3)
        if generator.random() < 0.5:
            solid = trimesh.creation.box(sides)
        else:
            solid = trimesh.creation.icosphere(subdivisions=2)
            solid.apply_scale(sides)
        vertices = solid.vertices @ random_rotation(int(generator.integers(1 << 30))).T
        vertices, triangles = vertices + generator.uniform(-0.5, 0.5, 3), solid.faces
        for _ in range(generator.integers(0, 4)):
            vertices, triangles = with_sliver(vertices, triangles, generator)
        if generator.random() < 0.3:
            triangles = triangles[:, ::-1]
        if generator.random() < 0.3:
            vertices, triangles = vertices[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3)
        parts.append(Mesh(vertices, triangles))
    return parts


def with_sliver(vertices, triangles, generator):
    """Cut a triangle in three at a point next to one of its edges: two are normal, the third is a sliver."""
    t = generator.integers(len(triangles))
    a, b, c = triangles[t]
    new = vertices[[a, b, c]].T @ np.array([0.3, 0.7 - 1e-7, 1e-7])
    cut = [[a, b, len(vertices)], [b, c, len(vertices)], [c, a, len(vertices)]]
    return np.vstack([vertices, new]), np.vstack([np.delete(triangles, t, axis=0), cut])


def joined(parts: list[Mesh]) -> Mesh:
    offsets = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    return Mesh(
        np.vstack([part.vertices for part in parts]),
        np.vstack([part.triangles + offset for part, offset in zip(parts, offsets, strict=True)]),
    )
