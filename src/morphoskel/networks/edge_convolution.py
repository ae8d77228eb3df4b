"""Edge convolution whose work is done for each point, not for each of its edges.

Source: Wang et al., *Dynamic Graph CNN for Learning on Point Clouds*, ACM Transactions on Graphics 38, 2019,
section 3.1.

Strategy. An edge from ``x_i`` to its neighbour ``x_j`` has the features ``[x_j - x_i; x_i]``. A linear layer ``[A; B]``
of them is ``A x_j + (B - A) x_i``: two products a point instead of one an edge. Batch normalisation scales and shifts
a channel and the activation is monotone, so the largest of the activations comes from the edge of the largest value; or
of the smallest, where the scale is negative: there, the channel's weights and scale change sign beforehand, which
changes nothing else. Only mean and variance need all edges, and take them from one pass in which no edge is kept.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor, nn
from torch.autograd.function import once_differentiable
from torch.nn import functional

from morphoskel.compiled import run_blocks
from morphoskel.errors import InputError
from morphoskel.networks.pointnet2 import gather_rows

MOMENTUM = 0.1
"""Share of the last batch in the running statistics."""
POINTS = 256
"""Points that a thread passes at a time. Sums depend on it in their last bits, so it does not depend on the threads."""
CHANNELS = 64
"""Channels whose gradients a thread collects at a time: those of a cloud stay in the cache."""


class EdgeConvolution(nn.Module):
    """One layer on the edges of a neighbour graph: linear, batch normalisation, LeakyReLU, maximum a point.

    Parameters
    ----------
    inputs, outputs
        Channels.
    slope
        Of the activation below 0.

    Notes
    -----
    The function, its gradients and its running statistics are those of a 1x1 convolution of all edges followed by
    ``BatchNorm2d``, up to rounding; the parameters are the same, too: ``linear.weight``, ``(outputs, 2 * inputs)``, and
    those of ``normalise``. Computed in float32 or float64, also under autocast.
    """

    def __init__(self, inputs: int, outputs: int, slope: float = 0.2) -> None:
        super().__init__()
        self.slope = slope
        self.linear = nn.Linear(2 * inputs, outputs, bias=False)
        self.normalise = nn.BatchNorm1d(outputs, momentum=MOMENTUM)

    def forward(self, features: Tensor, neighbours: Tensor) -> Tensor:
        """Describe each point by its edges.

        Parameters
        ----------
        features
            ``(B, N, inputs)`` float.
        neighbours
            ``(B, N, k)`` int64, below N.

        Returns
        -------
        Tensor
            ``(B, N, outputs)``.

        Raises
        ------
        InputError
            On a CPU if `neighbours` are out of range; in training if there is but one edge, which has no variance.
        """
        with torch.autocast(features.device.type, enabled=False):
            weight, scale = self.linear.weight, self.normalise.weight
            sign = torch.where(scale.detach() < 0, -1.0, 1.0).to(scale.dtype)
            others, own = weight.chunk(2, dim=1)
            signed = torch.cat([others, own - others]) * sign.repeat(2).unsqueeze(1)
            values = functional.linear(features.to(weight.dtype), signed)
            reduce = EdgeReduction.apply if values.device.type == "cpu" else reduce_gathered_edges
            largest, mean, variance = reduce(values, neighbours, self.training)
            if self.training:
                self._update_statistics(sign * mean.detach(), variance.detach(), neighbours.numel())
            else:
                mean = sign * self.normalise.get_buffer("running_mean")
                variance = self.normalise.get_buffer("running_var")
            factor = sign * scale * torch.rsqrt(variance + self.normalise.eps)
            normalised = torch.addcmul(self.normalise.bias - mean * factor, largest, factor)
            return functional.leaky_relu(normalised, self.slope, inplace=True)

    @torch.no_grad()
    def _update_statistics(self, mean: Tensor, variance: Tensor, edges: int) -> None:
        if edges < 2:
            raise InputError("neighbours: expected at least 2 edges in training, since one has no variance, got 1")
        self.normalise.get_buffer("num_batches_tracked").add_(1)
        self.normalise.get_buffer("running_mean").lerp_(mean, MOMENTUM)
        self.normalise.get_buffer("running_var").lerp_(variance * (edges / (edges - 1)), MOMENTUM)


def reduce_gathered_edges(values: Tensor, neighbours: Tensor, with_moments: bool) -> tuple[Tensor, Tensor, Tensor]:
    """Compute the same as :class:`EdgeReduction` with the operations of the tensor library, as is done on a GPU.

    All edges are held at once, ``(B, N, k, C)``.
    """
    others, own = values.chunk(2, dim=-1)
    edges = gather_rows(others, neighbours) + own.unsqueeze(2)
    largest = edges.max(dim=2).values
    if not with_moments:
        return largest, values.new_empty(0), values.new_empty(0)
    variance, mean = torch.var_mean(edges, dim=(0, 1, 2), correction=0)
    return largest, mean, variance


class EdgeReduction(torch.autograd.Function):
    """Largest value of each point's edges, and mean and variance of all edges, where ``edge_ij = u_j + v_i``.

    Called as ``EdgeReduction.apply(values, neighbours, with_moments)`` with tensors on the CPU: `values`,
    ``(B, N, 2C)`` float32 or float64, holds `u` in the first half of its channels and `v` in the second; `neighbours`,
    ``(B, N, k)`` int64, holds the `j` of each `i`. Returns ``(B, N, C)`` maxima, and ``(C,)`` means and (biased)
    variances, which are ``(0,)`` without moments. Of equal edges, the first one of a point gets the gradient.
    """

    @staticmethod
    def forward(ctx: Any, values: Tensor, neighbours: Tensor, with_moments: bool) -> tuple[Tensor, Tensor, Tensor]:
        """Pass all edges once."""
        from morphoskel.networks.edge_convolution_kernels import reduce_edges

        values, neighbours = values.contiguous(), neighbours.contiguous()
        batch, points, channels = values.shape[0], values.shape[1], values.shape[2] // 2
        _check_neighbours(neighbours, points)
        largest = values.new_empty(batch, points, channels)
        winners = torch.empty(largest.shape, dtype=torch.int32)
        means = values.new_empty(batch, points if with_moments else 0, channels)
        arrays = [tensor.numpy() for tensor in (values.detach(), neighbours, largest, winners, means)]
        blocks = -(-points // POINTS)

        def reduce(block: int, _: int) -> Any:
            start = block % blocks * POINTS
            cloud = [array[block // blocks] for array in arrays]
            return reduce_edges(*cloud, start, min(start + POINTS, points))

        sums = sum(run_blocks(reduce, batch * blocks, block=1, threads=torch.get_num_threads()))
        mean = variance = values.new_empty(0)
        if with_moments:
            mean_of_means, mean_square, within = torch.from_numpy(sums) / (batch * points)
            mean = mean_of_means.to(values.dtype)
            variance = (mean_square - mean_of_means**2 + within / neighbours.shape[2]).to(values.dtype)
        ctx.save_for_backward(values, neighbours, winners, means, mean)
        return largest, mean, variance

    @staticmethod
    @once_differentiable
    def backward(ctx: Any, to_largest: Tensor, to_mean: Tensor, to_variance: Tensor) -> tuple[Tensor, None, None]:
        """Pass all edges once more, in a fixed order."""
        from morphoskel.networks.edge_convolution_kernels import spread_gradients

        values, neighbours, winners, means, mean = ctx.saved_tensors
        edges, channels = neighbours.numel(), winners.shape[2]
        result = torch.empty_like(values)
        clouds = [tensor.numpy() for tensor in (to_largest.contiguous(), winners, values, neighbours, means, result)]
        moments = [tensor.numpy() for tensor in (mean, to_mean / edges, to_variance * (2 / edges))]
        blocks = -(-channels // CHANNELS)

        def spread(block: int, _: int) -> None:
            start = block % blocks * CHANNELS
            cloud = [array[block // blocks] for array in clouds]
            spread_gradients(*cloud, *moments, start, min(start + CHANNELS, channels))

        run_blocks(spread, len(values) * blocks, block=1, threads=torch.get_num_threads())
        return result, None, None


def _check_neighbours(neighbours: Tensor, points: int) -> None:
    """Compiled code reads whatever memory an index leads to."""
    least, most = (int(bound) for bound in torch.aminmax(neighbours))
    if least < 0 or most >= points:
        raise InputError(f"neighbours: expected 0 to {points - 1}, indices of points, got {least} to {most}")
