"""Means of per-shape values: one for each category, and the two averages over them that the paper does not tell apart.

A shape that failed has the value NaN. It is left out of the means and counted, so that no table hides it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.errors import InputError
from morphoskel.evaluation.protocol import EvaluationProtocol, check_protocol

MEAN_OVER_CATEGORIES = "Mean over categories"
"""Every category counts the same (macro average)."""

MEAN_OVER_SHAPES = "Mean over shapes"
"""Every shape counts the same, so large categories weigh more (micro average)."""

AVERAGES = (MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES)
"""The averages in the order in which tables show them."""


@dataclass(frozen=True)
class Average:
    """A mean with what one must know to judge it.

    Parameters
    ----------
    value
        The mean, NaN if it is not defined.
    std
        Standard deviation over the shapes (divisor n - 1); NaN for fewer than two shapes and for a mean over
        categories, which is no mean over shapes.
    n, n_failed
        Numbers of shapes that entered the mean, and that failed.
    """

    value: float
    std: float
    n: int
    n_failed: int


def mean_over_shapes(values: npt.ArrayLike, protocol: EvaluationProtocol) -> Average:
    """Average over shapes.

    Parameters
    ----------
    values
        ``(S,)`` float64, one a shape, in any unit; NaN if the shape failed.
    protocol
        ``correct`` divides the sum by the number n of shapes that did not fail, ``released`` by n + 1.

    Returns
    -------
    Average
        Independent of the order of the shapes, to the last bit.

    Raises
    ------
    InputError
        If `values` is not one-dimensional, is empty, or holds an infinite value.
    """
    check_protocol(protocol)
    numbers = _check_values(values)
    known = np.sort(numbers[~np.isnan(numbers)])
    n = len(known)
    divisor = n + 1 if protocol == "released" else n
    return Average(
        value=math.fsum(known) / divisor if n else math.nan,
        std=float(known.std(ddof=1)) if n > 1 else math.nan,
        n=n,
        n_failed=len(numbers) - n,
    )


def mean_over_categories(values: npt.ArrayLike, categories: Sequence[str], protocol: EvaluationProtocol) -> Average:
    """Average the means of the categories.

    Parameters
    ----------
    values
        As for :func:`mean_over_shapes`.
    categories
        The category of each shape.
    protocol
        How the mean of each category is taken; the categories themselves are always divided by their number.

    Returns
    -------
    Average
        Its value is NaN if every shape of some category failed: leaving that category out would compare averages
        over different sets.

    Raises
    ------
    InputError
        If `values` is illegal, or `categories` is not as long.
    """
    return _combine(_by_category(values, categories, protocol))


def averages(values: npt.ArrayLike, categories: Sequence[str], protocol: EvaluationProtocol) -> dict[str, Average]:
    """Average over the shapes of each category, over the categories, and over all shapes.

    Parameters and errors are those of :func:`mean_over_categories`.

    Returns
    -------
    dict
        The categories in order of appearance, then :data:`MEAN_OVER_CATEGORIES` and :data:`MEAN_OVER_SHAPES`.
    """
    by_category = _by_category(values, categories, protocol)
    for name in AVERAGES:
        if name in by_category:
            raise InputError(f"categories: {name!r} is the name of an average; rename the category")
    return {
        **by_category,
        MEAN_OVER_CATEGORIES: _combine(by_category),
        MEAN_OVER_SHAPES: mean_over_shapes(values, protocol),
    }


def _by_category(values: npt.ArrayLike, categories: Sequence[str], protocol: EvaluationProtocol) -> dict[str, Average]:
    """Average over the shapes of each category."""
    numbers = _check_values(values)
    if len(categories) != len(numbers):
        raise InputError(f"categories: expected {len(numbers)}, one a value, got {len(categories)}")
    names = np.asarray(categories, dtype=object)
    return {name: mean_over_shapes(numbers[names == name], protocol) for name in dict.fromkeys(categories)}


def _combine(by_category: dict[str, Average]) -> Average:
    """Average the means of the categories."""
    means = by_category.values()
    return Average(
        value=math.fsum(mean.value for mean in means) / len(means),
        std=math.nan,
        n=sum(mean.n for mean in means),
        n_failed=sum(mean.n_failed for mean in means),
    )


def _check_values(values: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return `values` as a non-empty vector without infinite values, or say why it is none."""
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.ndim != 1 or len(numbers) == 0:
        raise InputError(f"values: expected shape (S,) with S >= 1, one value a shape, got {numbers.shape}")
    infinite = np.flatnonzero(np.isinf(numbers))
    if len(infinite):
        raise InputError(f"values: shape number {infinite[0]} has an infinite value; mark a failed shape with NaN")
    return numbers
