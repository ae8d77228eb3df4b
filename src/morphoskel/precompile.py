"""Compile all kernels ahead of the first job: ``python -m morphoskel.precompile``.

Set-up does this once. A kernel whose code has changed since, or that runs on another kind of processor, is compiled
by the first job that needs it, which takes some seconds.
"""

from __future__ import annotations

import logging
from importlib import import_module
from typing import Any

import numpy as np

logger = logging.getLogger(__name__)


def precompile() -> None:
    """Run every kernel once on a small shape; the compiler keeps the machine code on disk."""
    from morphoskel.formats.sample import sample_surface
    from morphoskel.morphology import opening
    from morphoskel.run_method import skeleton_inside
    from morphoskel.shapes import Mesh
    from morphoskel.skeleton.medial_axis import medial_axis_of_mesh
    from morphoskel.volume import Candidates

    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    tetrahedron = Mesh(corners, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
    generator = np.random.default_rng(0)
    samples = sample_surface(tetrahedron, 200, generator).points
    import_module("morphoskel.chain.compiler")
    scattered, grid = Candidates(np.zeros(3), np.ones(3), 1000), Candidates(np.zeros(3), np.ones(3), 1000, "grid")
    runs: tuple[tuple[str, Candidates, dict[str, Any]], ...] = (
        ("ms3d", scattered, {}),
        ("ms3d", grid, {}),
        ("ms3d_coverage", scattered, {"touch": 5.0}),  # the samples are few
        ("coverage_axis", scattered, {"penalty": "standardised"}),  # which has a kernel of its own
    )
    for method, candidates, settings in runs:
        skeleton = skeleton_inside(method, tetrahedron, candidates, samples, k=20, points=16, settings=settings)
    opening(skeleton.points.astype(np.float32), skeleton.radii.astype(np.float32))
    medial_axis_of_mesh(tetrahedron, generator, samples=500, separation_angle=0.0, scale=0.0)
    _skeletonize_ball(generator)
    _train_edge_convolution()


def _skeletonize_ball(generator: np.random.Generator) -> None:
    """Run the methods that read the cloud alone; Point2Skeleton has no kernels."""
    from morphoskel.run_method import skeleton_of_cloud
    from morphoskel.shapes import PointCloud

    directions = generator.normal(size=(100, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for method in ("l1_medial", "dpc"):
        skeleton_of_cloud(method, PointCloud(directions, normals=directions), generator, settings={})


def _train_edge_convolution() -> None:
    """Run the layers of the skeleton-aware networks forwards and backwards."""
    import torch

    from morphoskel.networks.edge_features import EdgeFeatures

    features = EdgeFeatures(k=4, channels=(8,), global_features=8, head=(8,))
    features(torch.linspace(0, 1, 192).reshape(2, 32, 3)).sum().backward()


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    logger.info("compiling kernels, once; this takes about half a minute")
    precompile()
