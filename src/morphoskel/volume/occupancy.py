"""Which candidates lie inside a surface, and where they are (paper, Eq. 3)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from morphoskel.errors import ShapeError
from morphoskel.volume.candidates import Candidates
from morphoskel.volume.surface_query import SurfaceQuery


def occupancy(query: SurfaceQuery, candidates: Candidates) -> npt.NDArray[np.bool_]:
    """Tell which candidates lie inside.

    Parameters
    ----------
    query
        The closed surface.
    candidates
        Points in its bounding box.

    Returns
    -------
    ndarray
        ``(len(candidates),)`` bool.

    Raises
    ------
    ShapeError
        If none lies inside.
    """
    mask = np.concatenate([query.occupancy(chunk) for chunk in candidates.chunks()])
    if not mask.any():
        raise ShapeError(
            f"none of the {len(candidates):,} candidates lies inside the surface; it may be too thin for them: "
            "raise skeleton.candidates.count, or check that the surface is closed"
        )
    return mask


def inner_points(candidates: Candidates, mask: npt.NDArray[np.bool_]) -> npt.NDArray[np.float32]:
    """Generate the candidates again and return those inside, ``(M, 3)`` float32 in spatial order."""
    start, inner = 0, []
    for chunk in candidates.chunks():
        inner.append(chunk[mask[start : start + len(chunk)]])
        start += len(chunk)
    return np.concatenate(inner)
