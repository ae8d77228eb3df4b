"""Bring clouds of any size and number of points to what the networks expect."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor

from morphoskel.errors import InputError
from morphoskel.networks.pointnet2 import farthest_points
from morphoskel.shapes import FloatArray, PointCloud


class PreparedCloud(NamedTuple):
    """A cloud as a network sees it, and the way back: ``original = points * scale + centre``.

    Parameters
    ----------
    points
        ``(count, 3)`` float32 tensor in [-1, 1].
    centre
        ``(3,)`` float64, the centre of the bounding box.
    scale
        Half the largest extent of the bounding box, in the cloud's units.
    """

    points: Tensor
    centre: FloatArray
    scale: float


def prepare_cloud(cloud: PointCloud | FloatArray, count: int) -> PreparedCloud:
    """Scale a cloud to [-1, 1] and take exactly `count` of its points.

    The box around all points is centred at the origin and scaled so that its largest half extent is 1. Of a larger
    cloud the farthest points are taken, beginning with its first point, so that they cover it evenly; a smaller one is
    repeated from its beginning. Nothing is random.

    Parameters
    ----------
    cloud
        A cloud, or its points, ``(N, 3)`` float64.
    count
        Number of points wanted.

    Returns
    -------
    PreparedCloud
        The points in the order in which they were taken.

    Raises
    ------
    InputError
        If an array is no cloud (see :class:`~morphoskel.shapes.PointCloud`), or all points coincide after rounding.
    """
    points = (cloud if isinstance(cloud, PointCloud) else PointCloud(cloud)).points
    low, high = points.min(axis=0), points.max(axis=0)
    centre, scale = (low + high) / 2, float((high - low).max() / 2)
    if not scale > 0:
        raise InputError("the points of the cloud coincide after rounding: its bounding box has no extent")
    scaled = torch.from_numpy(((points - centre) / scale).astype(np.float32))
    if len(scaled) > count:
        scaled = scaled[farthest_points(scaled[None], count)[0]]
    return PreparedCloud(scaled[torch.arange(count) % len(scaled)], centre, scale)
