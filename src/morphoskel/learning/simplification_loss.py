"""How well generated points stand for a cloud.

Source: Dovrat et al., *Learning to Sample*, CVPR 2019, the "sampling regularisation loss"; SampleNet (Lang et al., CVPR
2020) uses it unchanged.
"""

from __future__ import annotations

import torch
from torch import Tensor

from morphoskel.networks.pointnet2 import gather_rows


def simplification_loss(points: Tensor, generated: Tensor, *, gamma: float, delta: float) -> Tensor:
    """Return the mean and the largest squared distance to the cloud, and the mean one from it.

    For a cloud P and its M generated points G: ``mean_g min_p |g - p|^2 + max_g min_p |g - p|^2
    + (gamma + delta M) mean_p min_g |p - g|^2``.

    Parameters
    ----------
    points, generated
        ``(B, N, 3)`` and ``(B, M, 3)`` float, in the same units.
    gamma, delta
        Weight of the distance from the cloud to the generated points, and what each of these adds to it.

    Returns
    -------
    Tensor
        Scalar, in squared units: the mean over the batch. 0 only if both sets of points are the same.
    """
    with torch.no_grad():  # which pairs are nearest has no gradient, and the table of all pairs needs none
        distances = torch.cdist(generated, points, compute_mode="donot_use_mm_for_euclid_dist")
        nearest_point, nearest_generated = distances.argmin(dim=2), distances.argmin(dim=1)
    to_cloud = (generated - gather_rows(points, nearest_point)).square().sum(dim=-1)
    from_cloud = (points - gather_rows(generated, nearest_generated)).square().sum(dim=-1)
    coverage_weight = gamma + delta * generated.shape[1]
    return to_cloud.mean() + to_cloud.amax(dim=1).mean() + coverage_weight * from_cloud.mean()
