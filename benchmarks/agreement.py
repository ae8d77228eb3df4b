"""Check that two computations found the same skeleton in the same candidates.

They may differ for three reasons, each of which is checked where it is claimed:
tie - neighbours exactly as far as the k-th, of which the published search keeps whichever it meets first;
stray - a single ray of the published inside test miscounted, so that a point or one of its neighbours is not the same;
rank - the residues agree, but points of the other kinds moved the last place of the 1024.
"""

from dataclasses import dataclass

import numpy as np

from benchmarks.computations import KEPT, K

TOLERANCE = 1e-6
"""Of a distance; residues are differences of two."""


@dataclass(frozen=True)
class Agreement:
    """How two answers compare; `unexplained` is 0 if they agree."""

    only_released: int
    only_ours: int
    largest_udf_difference: float
    kept_by_both: int
    tie: int
    stray: int
    rank: int
    unexplained: int


def compare(released, ours) -> Agreement:
    """Compare two answers, each with ``inner``, ``udf``, ``residues`` and ``kept``."""
    keys = [np.ascontiguousarray(answer["inner"]).view("V12").ravel() for answer in (released, ours)]
    _, first, second = np.intersect1d(*keys, assume_unique=False, return_indices=True)
    strays = np.vstack(
        [np.delete(answer["inner"], rows, axis=0) for answer, rows in ((released, first), (ours, second))]
    )
    residues = np.column_stack([released["residues"][first], ours["residues"][second]])
    kept = np.column_stack([np.isin(first, released["kept"]), np.isin(second, ours["kept"])])
    differ = np.flatnonzero(kept[:, 0] != kept[:, 1])
    causes = {"tie": 0, "stray": 0, "rank": 0, "unexplained": 0}
    for row in differ:
        causes[_cause(ours, int(second[row]), residues[row], strays)] += 1
    strangers = KEPT - int(kept[:, 0].sum()) if len(released["kept"]) == KEPT else 0  # kept, but not inside
    causes["stray"] += strangers
    movers = causes["tie"] + causes["stray"]
    if causes["rank"] > _places_to_move(residues, movers):
        causes["unexplained"] += causes.pop("rank")
        causes["rank"] = 0
    return Agreement(
        len(released["inner"]) - len(first),
        len(ours["inner"]) - len(second),
        float(np.abs(released["udf"][first] - ours["udf"][second]).max()),
        int(kept.all(axis=1).sum()),
        **causes,
    )


def _cause(ours, row, residues, strays):
    """Say why a point is kept by one computation only."""
    if abs(residues[0] - residues[1]) <= 2 * TOLERANCE:
        return "rank"
    offsets = ours["inner"] - ours["inner"][row]
    squares = offsets[:, 0] ** 2 + offsets[:, 1] ** 2 + offsets[:, 2] ** 2
    radius = np.partition(squares, K - 1)[K - 1]
    if (squares <= radius).sum() > K:
        return "tie"
    near = ((strays - ours["inner"][row]) ** 2).sum(axis=1) <= radius * (1 + 1e-5)
    return "stray" if near.any() else "unexplained"


def _places_to_move(residues, movers):
    """Return how many points of equal residue may change sides: one for each mover, and all that tie for last."""
    last = [np.partition(column, min(KEPT, len(column)) - 1)[min(KEPT, len(column)) - 1] for column in residues.T]
    level = np.abs(residues - last).min(axis=1) <= 2 * TOLERANCE
    return 2 * movers + int(level.sum())
