"""A linear layer with batch normalisation, and its maximum over the points, for which both become one linear map.

The batch statistics of ``W x`` follow from the mean ``m`` and the covariance ``S`` of the inputs: mean ``W m`` and
variance ``diag(W S W')``. So the outputs need not exist at all where only their maximum over the points is wanted: the
gradient then passes through the strongest points and the statistics alone. The result is that of ``nn.Linear`` and
``nn.BatchNorm1d``, which are used as they are where the outputs at all points are needed.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor, nn

from morphoskel.networks.pointnet2 import gather_rows

BLOCK = 8
"""Points whose maximum is taken before looking for its index; torch finds maxima much faster than indices."""

FEW = 32
"""Up to so many points it is faster to keep all responses than to look for the strongest points."""

CHUNK = 1 << 22
"""Responses held at a time (16 MB), so that they stay in the cache and their memory is used again."""


class Moments(torch.autograd.Function):
    """The mean and the covariance of rows, with half the matrix products of what autograd would record."""

    @staticmethod
    def forward(ctx: Any, values: Tensor) -> tuple[Tensor, Tensor]:
        """Return ``(C,)`` mean and ``(C, C)`` biased covariance of ``(R, C)`` float `values`."""
        mean = values.mean(dim=0)
        centred = values - mean
        ctx.save_for_backward(centred)
        return mean, centred.t() @ centred / len(values)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> Tensor:
        """Return the gradient of the rows."""
        (centred,) = ctx.saved_tensors
        of_mean, of_covariance = gradients
        return torch.addmm(of_mean, centred, of_covariance + of_covariance.t()) / len(centred)


class NormalisedLinear(nn.Module):
    """A linear layer without bias, then batch normalisation.

    Parameters
    ----------
    inputs, outputs
        Channels.
    """

    def __init__(self, inputs: int, outputs: int) -> None:
        super().__init__()
        self.linear = nn.Linear(inputs, outputs, bias=False)
        self.normalise = nn.BatchNorm1d(outputs)

    def fused(self, values: Tensor) -> tuple[Tensor, Tensor]:
        """Return the linear map that the layer is for these inputs.

        Parameters
        ----------
        values
            ``(..., inputs)`` float; all but the last axis are rows. In training mode their statistics normalise, and
            the running ones move towards them; in evaluation mode they do not matter.

        Returns
        -------
        tuple of Tensor
            Weight ``(outputs, inputs)`` and bias ``(outputs,)``.

        Raises
        ------
        ValueError
            For a single row in training mode, which has no variance.
        """
        weight, normalise = self.linear.weight, self.normalise
        if self.training:
            mean, variance = self._batch_statistics(values.flatten(0, -2))
        else:
            mean, variance = normalise.get_buffer("running_mean"), normalise.get_buffer("running_var")
        scale = normalise.weight * torch.rsqrt(variance + normalise.eps)
        return scale[:, None] * weight, normalise.bias - scale * mean

    def _batch_statistics(self, rows: Tensor) -> tuple[Tensor, Tensor]:
        """Return mean and biased variance of the outputs, and move the running ones towards them."""
        if len(rows) < 2:
            raise ValueError("batch normalisation needs more than one row in training mode")
        mean_input, covariance = Moments.apply(rows)  # type: ignore[no-untyped-call]
        weight, normalise = self.linear.weight, self.normalise
        mean = weight @ mean_input
        variance = ((weight @ covariance) * weight).sum(dim=1).clamp(min=0)
        with torch.no_grad():
            share = normalise.momentum
            if share is None:
                raise ValueError("the running statistics need a momentum")
            normalise.get_buffer("running_mean").lerp_(mean, share)
            normalise.get_buffer("running_var").lerp_(variance * (len(rows) / (len(rows) - 1)), share)
            normalise.get_buffer("num_batches_tracked").add_(1)
        return mean, variance

    def forward(self, values: Tensor) -> Tensor:
        """Return ``(..., outputs)`` for ``(..., inputs)``.

        Raises
        ------
        ValueError
            For a single row in training mode.
        """
        if not self.training:
            return nn.functional.linear(values, *self.fused(values))
        outputs = self.linear(values)
        normalised: Tensor = self.normalise(outputs.flatten(0, -2))
        return normalised.view_as(outputs)


class PooledLinear(NormalisedLinear):
    """A linear layer and batch normalisation at every point, then the maximum over the points of a cloud."""

    def forward(self, values: Tensor) -> Tensor:
        """Return ``(B, outputs)`` for ``(B, N, inputs)``."""
        return pooled_linear(values, *self.fused(values))


def pooled_linear(values: Tensor, weight: Tensor, bias: Tensor) -> Tensor:
    """Return the maximum over the points of a linear map of their features.

    Parameters
    ----------
    values
        ``(B, N, C)`` float.
    weight, bias
        ``(O, C)`` and ``(O,)``.

    Returns
    -------
    Tensor
        ``(B, O)``. Its gradient reaches the strongest point of each output, as that of a maximum does; equally strong
        points may share it.
    """
    if values.shape[1] <= FEW or not torch.is_grad_enabled():
        return (values @ weight.t()).amax(dim=1) + bias
    strongest = gather_rows(values, strongest_points(values, weight))
    return (strongest * weight).sum(dim=-1) + bias


def pooled(values: Tensor) -> Tensor:
    """Return the maximum over the points of their features.

    Parameters
    ----------
    values
        ``(B, N, C)`` float.

    Returns
    -------
    Tensor
        ``(B, C)``. Its gradient reaches the first of the strongest points of each feature; that of ``amax`` would pass
        over all points several times to find those that are equally strong.
    """
    if not values.requires_grad:
        return values.amax(dim=1)
    return values.gather(1, _largest_rows(values.detach())[:, None]).squeeze(1)


@torch.no_grad()
def strongest_points(values: Tensor, weight: Tensor) -> Tensor:
    """Return ``(B, O)`` int64: for each row of the weight the point of largest response.

    Parameters
    ----------
    values, weight
        ``(B, N, C)`` and ``(O, C)`` float.
    """
    clouds = max(CHUNK // (values.shape[1] * len(weight)), 1)
    return torch.cat([_largest_rows(part @ weight.t()) for part in torch.split(values, clouds)])


def _largest_rows(responses: Tensor) -> Tensor:
    """Return ``(B, O)`` int64, the arg max of ``(B, N, O)`` over N, by blocks of points."""
    batch, points, outputs = responses.shape
    whole = points - points % BLOCK
    tops = responses[:, :whole].reshape(batch, -1, BLOCK, outputs).amax(dim=2)
    if whole < points:
        tops = torch.cat([tops, responses[:, whole:].amax(dim=1, keepdim=True)], dim=1)
    within = torch.arange(BLOCK, device=responses.device)[:, None]
    rows = (tops.argmax(dim=1, keepdim=True) * BLOCK + within).clamp(max=points - 1)
    return rows.gather(1, responses.gather(1, rows).argmax(dim=1, keepdim=True)).squeeze(1)
