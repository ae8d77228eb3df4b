"""Project generated points onto the cloud, softly, so that gradients pass.

Source: Lang et al., *SampleNet: Differentiable Point Cloud Sampling*, CVPR 2020, "soft projection".
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from morphoskel.errors import InputError
from morphoskel.networks.pointnet2 import gather_rows


class SoftProjection(nn.Module):
    """Replace each generated point by a convex combination of the cloud's points nearest to it.

    The weights are ``w_i = exp(-|q - p_i|^2 / sigma)``, divided by their sum, with ``sigma = t^2`` and a temperature t
    that is learned, starting from 1. As sigma tends to 0, the combination tends to the nearest point.

    Parameters
    ----------
    neighbours
        Points combined, at least 1.
    least_sigma
        Floor of sigma, in squared units of the points. Below it the temperature has no gradient.
    """

    def __init__(self, neighbours: int, least_sigma: float) -> None:
        super().__init__()
        self.neighbours = neighbours
        self.least_sigma = least_sigma
        self.temperature = nn.Parameter(torch.tensor(1.0))

    def sigma(self) -> Tensor:
        """Return the squared temperature, a scalar, at least its floor."""
        return self.temperature.square().clamp(min=self.least_sigma)

    def forward(self, points: Tensor, generated: Tensor) -> Tensor:
        """Project the generated points of clouds.

        Parameters
        ----------
        points, generated
            ``(B, N, 3)`` and ``(B, M, 3)`` float.

        Returns
        -------
        Tensor
            ``(B, M, 3)``, each in the convex hull of some of the cloud's points. The gradient reaches `generated` and
            the temperature; which points are nearest has none.

        Raises
        ------
        InputError
            If a cloud has fewer points than are to be combined.
        """
        if self.neighbours > points.shape[1]:
            raise InputError(f"points: expected at least {self.neighbours}, the neighbours, got {points.shape[1]}")
        with torch.no_grad():
            distances = torch.cdist(generated, points, compute_mode="donot_use_mm_for_euclid_dist")
            nearest = distances.topk(self.neighbours, dim=-1, largest=False, sorted=False).indices
        candidates = gather_rows(points, nearest)
        squared = (generated[:, :, None] - candidates).square().sum(dim=-1)
        weights = (-squared / self.sigma()).softmax(dim=-1)
        return (weights[..., None] * candidates).sum(dim=2)
