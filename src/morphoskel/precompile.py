"""Compile all kernels ahead of the first job: ``python -m morphoskel.precompile``.

Set-up does this once. A kernel whose code has changed since, or that runs on another kind of processor, is compiled
by the first job that needs it, which takes some seconds.
"""

from __future__ import annotations

import logging
from importlib import import_module

import numpy as np

logger = logging.getLogger(__name__)


def precompile() -> None:
    """Run every kernel once on a small shape; the compiler keeps the machine code on disk."""
    from morphoskel.morphology import opening
    from morphoskel.shapes import Mesh
    from morphoskel.skeleton import ms3d
    from morphoskel.volume import Candidates

    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    tetrahedron = Mesh(corners, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
    import_module("morphoskel.chain.compiler")
    for mode in ("random", "grid"):
        skeleton = ms3d(tetrahedron, Candidates(np.zeros(3), np.ones(3), 1000, mode))
    opening(skeleton.points.astype(np.float32), skeleton.radii.astype(np.float32))


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    logger.info("compiling kernels, once; this takes about half a minute")
    precompile()
