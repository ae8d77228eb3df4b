"""The rows of the table of part segmentation: what they are called, and in which order they stand."""

from morphoskel.errors import InputError
from morphoskel.reporting.sampling_names import ALL_POINTS, SAMPLER_NAMES

FULL = "full"
"""Full supervision: every point of a training shape has its label."""

STRATEGY_NAMES = {
    FULL: "PointNet (all labels)",
    **{sampler: name for sampler, name in SAMPLER_NAMES.items() if sampler != ALL_POINTS},
}
"""Ways to choose the labelled points, in the order of the rows, with the paper's names where it has them."""

COMPARISONS = (("ms3d", "fps"), ("ms3d", "random"), ("ms3d", "uniform"), ("lfs", "fps"))
"""Strategies whose means are subtracted; the paper prints the first two in one table."""

_RATIO = ", ratio "


def row_name(strategy: str, ratio: str) -> str:
    """Return the name of a row.

    Parameters
    ----------
    strategy
        One of :data:`STRATEGY_NAMES`.
    ratio
        Points of a cloud for each one with a label; full supervision, which has one only, does not show it.

    Raises
    ------
    InputError
        If there is no such strategy.
    """
    if strategy not in STRATEGY_NAMES:
        raise InputError(f"there is no strategy {strategy!r}; known are {', '.join(STRATEGY_NAMES)}")
    return STRATEGY_NAMES[strategy] + ("" if strategy == FULL else f"{_RATIO}{ratio}")


def difference_name(first: str, second: str, ratio: str) -> str:
    """Return the name of the row that subtracts the second strategy from the first."""
    return f"{STRATEGY_NAMES[first]} minus {STRATEGY_NAMES[second]}{_RATIO}{ratio}"


def split_row(row: str) -> tuple[str, str]:
    """Return the two parts of a row's name: that of its strategy or difference, and the ratio; empty without one."""
    name, _, ratio = row.partition(_RATIO)
    return name, ratio


def row_order(row: str) -> tuple[int, int]:
    """Return where a row stands: full supervision first, then ratio by ratio, since rows are compared at the same."""
    name, ratio = split_row(row)
    names = [*STRATEGY_NAMES.values(), *(f"{STRATEGY_NAMES[a]} minus {STRATEGY_NAMES[b]}" for a, b in COMPARISONS)]
    return int(ratio or 1), names.index(name) if name in names else len(names)
