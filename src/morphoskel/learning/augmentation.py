"""Random changes of training clouds. All of them draw from torch's global generator and keep what they are given."""

from __future__ import annotations

import math
from typing import Literal

import torch
from torch import Tensor


def drop_points(points: Tensor, most: float, style: Literal["overwrite", "remove"]) -> Tensor:
    """Drop a random share of the points, so that a network learns to deal with sparse clouds.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float.
    most
        The share is uniform between 0 and this, which is at least 0 and below 1. 0 returns the points as they are.
    style
        overwrite: each cloud has a share of its own, each point is dropped with that probability, and the cloud's first
        point takes its place. remove: the whole batch has one share, and that many random points are taken away. Behind
        a maximum over the points both are alike, but a smaller tensor is faster.

    Returns
    -------
    Tensor
        ``(B, N, 3)``, or ``(B, M, 3)`` with M between 1 and N if points are removed.

    Notes
    -----
    The overwriting style is that of widely used PointNet code, with `most` 0.875.
    """
    if most == 0:
        return points
    batch, available, _ = points.shape
    if style == "remove":
        kept = max(round(available * (1 - most * float(torch.rand(())))), 1)
        return points[:, torch.randperm(available)[:kept].to(points.device)]
    share = most * torch.rand(batch, 1, device=points.device)
    dropped = torch.rand(batch, available, device=points.device) < share
    return torch.where(dropped[..., None], points[:, :1], points)


def scale_and_shift(points: Tensor, lowest: float = 0.8, highest: float = 1.25, shift: float = 0.1) -> Tensor:
    """Scale each cloud by a factor between `lowest` and `highest`, then move it along each axis by at most `shift`.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float.
    lowest, highest
        Of the factor, which is uniform and the same for all axes.
    shift
        Largest shift, uniform to both sides, in units of the points.
    """
    factor = torch.empty(len(points), 1, 1, device=points.device).uniform_(lowest, highest)
    offset = torch.empty(len(points), 1, 3, device=points.device).uniform_(-shift, shift)
    return points * factor + offset


def rotate_about_y(points: Tensor) -> Tensor:
    """Turn each cloud ``(B, N, 3)`` by an angle of its own about the second axis, uniform over the full circle."""
    angle = 2 * math.pi * torch.rand(len(points), 1, device=points.device)
    cosine, sine = torch.cos(angle), torch.sin(angle)
    x, y, z = points.unbind(dim=-1)
    return torch.stack([cosine * x + sine * z, y, cosine * z - sine * x], dim=-1)


def jitter(points: Tensor, sigma: float = 0.01, clip: float = 0.05) -> Tensor:
    """Move each coordinate of ``(B, N, 3)`` points by normal noise.

    Parameters
    ----------
    points
        ``(B, N, 3)`` float.
    sigma, clip
        Standard deviation and largest size of the noise, in units of the points.
    """
    return points + (sigma * torch.randn_like(points)).clamp(-clip, clip)
