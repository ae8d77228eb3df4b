"""Compare a skeleton with a surface, or with another skeleton."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from morphoskel.errors import InputError
from morphoskel.evaluation.protocol import EvaluationProtocol, check_protocol
from morphoskel.evaluation.sphere_metrics import (
    SphereDistances,
    cd_recon,
    hd_recon,
    mean_point_to_sphere,
    mean_sphere_to_point,
    sphere_distances,
)
from morphoskel.formats.sample import sample_surface
from morphoskel.seeds import derive_generator
from morphoskel.shapes import Mesh, PointCloud, Skeleton

SURFACE_POINTS = 100_000
"""Points drawn on a mesh: dense enough that the gaps between them do not pass for distances to the balls."""


@dataclass(frozen=True)
class Comparison:
    """How far a skeleton is from what it was compared with.

    Parameters
    ----------
    of_surface
        Whether balls were compared with points on a surface (CD-Recon, HD-Recon), rather than centres with centres.
    distances
        Their distances; the points of the other shape take the place of the surface points.
    protocol
        How the distances become a Chamfer distance.
    """

    of_surface: bool
    distances: SphereDistances
    protocol: EvaluationProtocol

    @property
    def other_to_skeleton(self) -> tuple[float, float]:
        """Mean and largest distance from a point of the other shape to the skeleton."""
        return mean_point_to_sphere(self.distances), self.distances.point_to_sphere_max

    @property
    def skeleton_to_other(self) -> tuple[float, float]:
        """Mean (by the protocol) and largest distance from a ball or centre of the skeleton to the other shape."""
        return mean_sphere_to_point(self.distances, self.protocol), self.distances.sphere_to_point_max

    @property
    def chamfer(self) -> float:
        """The sum of both means."""
        return cd_recon(self.distances, self.protocol)

    @property
    def hausdorff(self) -> float:
        """The larger of both maxima."""
        return hd_recon(self.distances)


def compare_skeleton(
    skeleton: Skeleton,
    other: Skeleton | PointCloud | Mesh,
    *,
    centres: bool = False,
    protocol: EvaluationProtocol = "correct",
    samples: int = SURFACE_POINTS,
    seed: int = 0,
) -> Comparison:
    """Measure the Chamfer and the Hausdorff distance, unsquared, in the shapes' unit.

    Parameters
    ----------
    skeleton
        The skeleton.
    other
        A skeleton: its centres are compared with those of `skeleton`, with all radii 0. A cloud or a mesh: its points
        are compared with the balls of `skeleton`; on a mesh points are drawn.
    centres
        Compare centres although `other` is a cloud: a medial axis whose file has no radii.
    protocol
        Whether the second mean is divided by the number of balls, as it should be (``correct``), or by the number of
        surface points (``released``), see :mod:`~morphoskel.evaluation.protocol`.
    samples
        Number of points drawn on a mesh, uniformly by area.
    seed
        From which they are drawn.

    Returns
    -------
    Comparison
        The distances, both ways.

    Raises
    ------
    InputError
        If one of them is empty, the mesh has no area, there are too few samples, the protocol is unknown, or the
        centres of a mesh are asked for.
    """
    check_protocol(protocol)
    if isinstance(other, Mesh):
        if centres:
            raise InputError("a mesh has no centres to compare with; leave --centres out, or name a skeleton")
        other = sample_surface(other, samples, derive_generator(seed, "compare"))
    of_surface = isinstance(other, PointCloud) and not centres
    radii = skeleton.radii if of_surface else np.zeros(len(skeleton))
    return Comparison(of_surface, sphere_distances(other.points, skeleton.points, radii), protocol)
