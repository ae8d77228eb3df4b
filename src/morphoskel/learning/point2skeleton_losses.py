"""The losses of Point2Skeleton's three training phases.

Source: Lin et al., *Point2Skeleton: Learning Skeletal Representations from Point Clouds*, CVPR 2021, Sec. 3.1 and 3.2,
and the program released with it. That program sums over the batch, so that there the batch size changes the loss; here
every loss is computed for each cloud and then averaged.
"""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn import functional

from morphoskel.networks.pointnet2 import gather_rows
from morphoskel.networks.skeletal_links import InitialGraph
from morphoskel.networks.skeletal_points import nearest_distances, nearest_indices


def summed_chamfer_loss(points: Tensor, centres: Tensor) -> Tensor:
    """Return the Chamfer distance between clouds and their skeletal points, unsquared, summed both ways.

    It spreads the skeletal points over the shape before anything is asked of the radii; without it they stay near the
    centroid, since the weights of a fresh network are nearly equal.

    Parameters
    ----------
    points, centres
        ``(B, N, 3)`` and ``(B, K, 3)`` float.

    Returns
    -------
    Tensor
        Scalar, the mean over the batch; grows with N and K.
    """
    return (nearest_distances(points, centres).sum(dim=1) + nearest_distances(centres, points).sum(dim=1)).mean()


def sampling_loss(points: Tensor, centres: Tensor, radii: Tensor) -> Tensor:
    """Return the Chamfer distance between clouds and points on the spheres, means of both ways added.

    Each sphere is sampled where the eight diagonals of a cube around it pass through it.

    Parameters
    ----------
    points, centres, radii
        ``(B, N, 3)``, ``(B, K, 3)`` and ``(B, K)`` float.

    Returns
    -------
    Tensor
        Scalar, the mean over the batch.
    """
    signs = torch.tensor([-1.0, 1.0], dtype=centres.dtype, device=centres.device)
    directions = torch.cartesian_prod(signs, signs, signs) / 3**0.5
    on_spheres = (centres[:, :, None] + radii[:, :, None, None] * directions).flatten(1, 2)
    return nearest_distances(points, on_spheres).mean() + nearest_distances(on_spheres, points).mean()


def point_to_sphere_loss(points: Tensor, centres: Tensor, radii: Tensor) -> Tensor:
    """Return how far points lie off the spheres with the nearest centres and spheres off the points nearest to them.

    Parameters
    ----------
    points, centres, radii
        ``(B, N, 3)``, ``(B, K, 3)`` and ``(B, K)`` float.

    Returns
    -------
    Tensor
        Scalar: ``mean_p | |p - c| - r | + mean_c | |c - q| - r |``, averaged over the batch.
    """
    nearest = nearest_indices(points, centres)
    offsets = points - gather_rows(centres, nearest)
    of_points: Tensor = (torch.linalg.vector_norm(offsets, dim=-1) - radii.gather(1, nearest)).abs()
    of_spheres = (nearest_distances(centres, points) - radii).abs()
    return of_points.mean() + of_spheres.mean()


def skeleton_loss(
    points: Tensor, centres: Tensor, radii: Tensor, *, point_to_sphere_weight: float, radius_weight: float
) -> Tensor:
    """Return the loss of the second phase: spheres shall cover the points, touch them, and be large.

    Parameters
    ----------
    points, centres, radii
        ``(B, N, 3)``, ``(B, K, 3)`` and ``(B, K)`` float.
    point_to_sphere_weight
        Weight of :func:`point_to_sphere_loss`; :func:`sampling_loss` has weight 1.
    radius_weight
        Weight of the mean radius, which is subtracted.

    Returns
    -------
    Tensor
        Scalar, the mean over the batch; may be negative.
    """
    return (
        sampling_loss(points, centres, radii)
        + point_to_sphere_weight * point_to_sphere_loss(points, centres, radii)
        - radius_weight * radii.mean()
    )


def link_loss(scores: Tensor, graph: InitialGraph) -> Tensor:
    """Return the masked cross-entropy between predicted and initial links.

    Only pairs whose state is known count. Links are rarer than absences; in each graph their terms are weighted by the
    ratio of known absences to links.

    Parameters
    ----------
    scores
        ``(B, K, K)`` float, logits.
    graph
        The initial links and which pairs are known.

    Returns
    -------
    Tensor
        Scalar: the sum over the known pairs divided by ``K * K``, averaged over the batch.
    """
    links, known = graph.links.to(scores.dtype), graph.known.to(scores.dtype)
    linked = links.sum(dim=(1, 2), keepdim=True)
    absent = known.sum(dim=(1, 2), keepdim=True) - linked
    return functional.binary_cross_entropy_with_logits(scores, links, weight=known, pos_weight=absent / linked)
