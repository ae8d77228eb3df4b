"""Neighbours of points in the space of their features, where the graph of a dynamic graph network is drawn.

Source: Wang et al., *Dynamic Graph CNN for Learning on Point Clouds*, ACM Transactions on Graphics 38, 2019,
section 3.2.
"""

from __future__ import annotations

import torch
from torch import Tensor

from morphoskel.compiled import run_blocks
from morphoskel.errors import InputError

ROWS = 128
"""Rows of the matrix of distances that a thread searches at a time."""


@torch.no_grad()
def nearest_in_features(features: Tensor, k: int) -> Tensor:
    """Find the points of each cloud whose features are most alike.

    Parameters
    ----------
    features
        ``(B, N, C)`` float, finite. Distances are Euclidean, and computed in at least float32, also under autocast.
    k
        Neighbours of each point, 1 to N, of which the point itself is one.

    Returns
    -------
    Tensor
        ``(B, N, k)`` int64 indices, all different within a row, nearest first. On a CPU, of equally far points those of
        smallest index are taken; so a point with `k` or more duplicates may be missing from its own row.

    Raises
    ------
    InputError
        If `k` is out of range; on a CPU also if features are not finite.

    Notes
    -----
    No gradients pass. Squared distances are computed as ``|a|^2 + |b|^2 - 2ab`` from features less the mean of their
    cloud; their error is some units in the last place of the squared radius of the cloud, so points that are closer
    together than about a thousandth of that radius may change places.
    """
    points = features.shape[1]
    if not 1 <= k <= points:
        raise InputError(
            f"k: expected 1 to {points}, the number of points of a cloud, got {k}; ask for fewer neighbours or give"
            " more points"
        )
    if features.dtype not in (torch.float32, torch.float64):
        features = features.float()
    with torch.autocast(features.device.type, enabled=False):
        centred = features - features.mean(dim=1, keepdim=True)
        squares = centred.square().sum(dim=-1, keepdim=True).transpose(1, 2)
        if features.device.type == "cpu":
            return torch.stack([_nearest_of_cloud(*cloud, k) for cloud in zip(centred, squares, strict=True)])
        return nearest_by_sorting(centred, squares, k)


def nearest_by_sorting(features: Tensor, squares: Tensor, k: int) -> Tensor:
    """Find neighbours with the operations of the tensor library, as is done on a GPU.

    Parameters
    ----------
    features
        ``(B, N, C)`` float.
    squares
        ``(B, 1, N)``, the squared lengths of the features.
    k
        1 to N.

    Returns
    -------
    Tensor
        ``(B, N, k)`` int64; equally far points come in any order.
    """
    distances = torch.baddbmm(squares, features, features.transpose(1, 2), alpha=-2)  # less |a|^2, which a row shares
    return distances.topk(k, dim=-1, largest=False).indices


def _nearest_of_cloud(features: Tensor, squares: Tensor, k: int) -> Tensor:
    from morphoskel.networks.feature_neighbour_kernels import select_smallest

    distances = torch.addmm(squares, features, features.t(), alpha=-2).numpy()
    chosen = torch.empty(len(features), k, dtype=torch.int64)
    rows = chosen.numpy()

    def select(start: int, stop: int) -> bool:
        found: bool = select_smallest(distances, rows, start, stop)
        return found

    if not all(run_blocks(select, len(features), block=ROWS, threads=torch.get_num_threads())):
        raise InputError(
            "features: expected finite numbers whose squares are finite, too; check the clouds for NaN, or lower the"
            " learning rate if the training diverged"
        )
    return chosen
