"""Distance to a triangle mesh (paper, Eq. 4)."""

from __future__ import annotations

from functools import partial

import numpy as np
import numpy.typing as npt

from morphoskel.compiled import run_blocks
from morphoskel.shapes import Mesh

TRIANGLES_A_LEAF = 4
BLOCK_POINTS = 1 << 13


class SurfaceDistance:
    """The unsigned distance function (UDF) of a mesh, prepared once for many points.

    Parameters
    ----------
    mesh
        Any triangles, open or closed; slivers and triangles with repeated corners count as the segments or points
        that they are.
    """

    def __init__(self, mesh: Mesh) -> None:
        from morphoskel.volume import triangle_tree_kernels as kernels

        corners = mesh.vertices[mesh.triangles]
        self._depth = max(int(np.ceil(np.log2(len(corners) / TRIANGLES_A_LEAF))), 0)
        self._nodes = np.zeros((2 ** (self._depth + 1), kernels.NODE_NUMBERS), dtype=np.float32)
        order = np.arange(len(corners))
        kernels.build_tree(corners, self._depth, 2**self._depth, self._nodes, order)
        self._corners = corners[order]
        self._frames = np.zeros((len(corners), kernels.TRIANGLE_NUMBERS), dtype=np.float32)
        kernels.flatten_triangles(self._corners, self._frames)

    def __call__(self, points: npt.NDArray[np.float32], *, threads: int = 1) -> npt.NDArray[np.float32]:
        """Return the distance from each point to the nearest triangle (Eq. 4).

        Parameters
        ----------
        points
            ``(N, 3)`` float32; spatial order makes this several times faster.
        threads
            Threads of the search. Does not change the result.

        Returns
        -------
        ndarray
            ``(N,)`` float32, in the mesh's unit. Exact but for the choice between triangles whose distances differ
            by less than about 1e-7 of the distance.
        """
        from morphoskel.volume.distance_kernels import measure

        points = np.ascontiguousarray(points, dtype=np.float32)
        distances = np.empty(len(points), dtype=np.float32)
        run_blocks(
            partial(measure, points, self._corners, self._nodes, self._frames, self._depth, distances),
            len(points),
            block=BLOCK_POINTS,
            threads=threads,
        )
        return distances
