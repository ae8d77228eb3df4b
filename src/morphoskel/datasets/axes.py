"""Turn a data set so that its shapes stand like those of another one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from morphoskel.errors import DatasetError
from morphoskel.shapes import FloatArray

AS_THEY_ARE = ("x", "y", "z")
"""Axes of a data set that is not turned."""


def axes_matrix(axes: Sequence[str]) -> FloatArray:
    """Return the matrix that exchanges axes.

    Parameters
    ----------
    axes
        Which axes become x, y and z, each maybe with a minus, for example ``("x", "z", "-y")``.

    Returns
    -------
    ndarray
        ``(3, 3)`` float64, orthogonal; rows of coordinates are multiplied with it from the left: ``points @ matrix``.

    Raises
    ------
    DatasetError
        If they are not three different axes, or would mirror shapes.
    """
    names = [axis.removeprefix("-") for axis in axes]
    if sorted(names) != sorted(AS_THEY_ARE):
        raise DatasetError(f"axes: expected x, y and z in any order, each maybe with a minus, got {', '.join(axes)}")
    matrix = np.zeros((3, 3))
    for column, (axis, name) in enumerate(zip(axes, names, strict=True)):
        matrix[AS_THEY_ARE.index(name), column] = -1.0 if axis.startswith("-") else 1.0
    if np.linalg.det(matrix) < 0:
        raise DatasetError(f"axes: {', '.join(axes)} would mirror the shapes; change the sign of one of them")
    return matrix
