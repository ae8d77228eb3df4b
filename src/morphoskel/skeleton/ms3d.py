"""MorphoSkel3D: the skeleton of a closed surface by mathematical morphology (paper, section on the method)."""

from __future__ import annotations

from morphoskel.morphology import dilation
from morphoskel.shapes import Mesh, Skeleton
from morphoskel.skeleton.selection import skeleton_of
from morphoskel.volume import Candidates, SurfaceDistance, occupancy


def ms3d(mesh: Mesh, candidates: Candidates, *, k: int = 20, points: int = 1024, threads: int = 1) -> Skeleton:
    """Return the centres of the maximal balls of a closed surface.

    Parameters
    ----------
    mesh
        Closed surface.
    candidates
        Points in its bounding box.
    k
        Size of the structuring element, the point itself included.
    points
        Maximal balls kept; fewer if fewer candidates lie inside.
    threads
        Threads of each stage. Does not change the result.

    Returns
    -------
    Skeleton
        Smallest residue first.

    Raises
    ------
    ShapeError
        If the surface is not closed, or no candidate lies inside.
    """
    inner = occupancy(mesh, candidates, threads=threads).inner_points(threads=threads)
    udf = SurfaceDistance(mesh)(inner, threads=threads)
    return skeleton_of(inner, udf, dilation(inner, udf, k, threads=threads), points)
