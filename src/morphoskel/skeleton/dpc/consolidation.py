"""Deep points consolidation: a skeleton from inner points that sink from the surface (Wu et al. 2015)."""

from __future__ import annotations

import numpy as np

from morphoskel.shapes import FloatArray, PointCloud, Skeleton
from morphoskel.skeleton.dpc.depths import complete_depths
from morphoskel.skeleton.dpc.meso_skeleton import form_meso_skeleton
from morphoskel.skeleton.dpc.neighbourhood import mean_spacing
from morphoskel.skeleton.dpc.normals import smooth_normals
from morphoskel.skeleton.dpc.settings import DeepPointsSettings
from morphoskel.skeleton.dpc.sinking import sink
from morphoskel.skeleton.thinning import farthest_points
from morphoskel.surface.normals import complete_normals

DEFAULTS = DeepPointsSettings()


def deep_points(cloud: PointCloud, settings: DeepPointsSettings = DEFAULTS) -> Skeleton:
    """Return the meso-skeleton of a point cloud: one inner point for each surface sample.

    Each sample sends an inner point against its normal until opposite fronts meet. The inner points are then gathered
    on the sheets and curves that they outline, and spread there.

    Parameters
    ----------
    cloud
        Points on a surface; unknown normals are completed.
    settings
        Parameters of all stages.

    Returns
    -------
    Skeleton
        One ball a sample, in the samples' order, without edges and triangles.

    Raises
    ------
    InputError
        If more samples are wanted than there are points.
    ShapeError
        If no fronts meet, as on an open sheet whose normals all point to one side.

    Notes
    -----
    Implements the inner points of [1]_; completing the surface itself is left out. Details follow the program that
    the first author released; its interactive steps are run in a fixed order. The samples are taken as they are,
    without the program's regularisation. Its optional guard that gives a point the depth of a neighbour that stopped
    much earlier is left out: on a box it spreads the small depths beside the edges over whole faces.

    References
    ----------
    .. [1] S. Wu, H. Huang, M. Gong, M. Zwicker, D. Cohen-Or, "Deep Points Consolidation", ACM Transactions on
       Graphics 34(6), SIGGRAPH Asia 2015.
    """
    normals = complete_normals(cloud)
    if settings.samples is None:
        samples = cloud.points
    else:
        chosen = np.sort(farthest_points(cloud.points, settings.samples))
        samples, normals = cloud.points[chosen], normals[chosen]
    spacing = mean_spacing(samples)
    directions = smooth_normals(
        samples, normals, radius=settings.surface_radius * spacing, angle=settings.smoothing_angle
    )
    depths = complete_depths(samples, sink(samples, directions, spacing, settings))
    inner = form_meso_skeleton(samples, samples - depths[:, None] * directions, spacing, settings)
    if settings.radii == "deep_link":
        radii: FloatArray = np.linalg.norm(samples - inner, axis=1)
    else:
        from morphoskel.skeleton.ball_radii import radii_of

        radii = radii_of(inner, cloud.points, settings.radii)
    return Skeleton(inner, radii)
