"""What the reader of a sampling table must know, as footnotes that apply to the rows it has."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from morphoskel.reporting.sampling_names import PRIOR_TABLE, SAMPLER_NAMES
from morphoskel.reporting.sampling_rows import SETTING
from morphoskel.sampling.choice import ARGMAX, COMPLETED, DRAWN
from morphoskel.sampling.samplers import GENERATORS, LEARNED, PRIORS

if TYPE_CHECKING:
    import pandas as pd

Key = tuple[str, str, str]
"""Sampler, choice and classifier of a row."""

LISTED_FAILURES = 10
"""Failed shapes named in a footnote; the others are only counted."""

OTHER_CLASSIFIER = (
    "Paper, FPS, S-NET, SampleNet: these rows come from another task network, trained with rotation and jitter and "
    "without point dropout; SA and MS3D come from one trained with it, which bears few points much better. So the "
    "paper's gap between them is not the samplers' alone. Ours share one task network, trained with point dropout."
)
BEST_ON_TEST = (
    "Paper, SA and MS3D: the best of 250 noisy evaluations on the test shapes themselves. Ours: the epoch is chosen on "
    "validation shapes that are no test shapes."
)
NO_PUBLISHED_RETRIEVAL = "Paper, MetaSampler: no mean average precision was published."
MARGIN = (
    "±: half the width of the 95 % interval from a bootstrap over the test shapes. How much another training would "
    "change is not in it."
)
LFS = "LFS-weighted FPS: farthest-point sampling weighted by the distance to the MS3D skeleton, without training."
PRIOR_CONTROLS = {
    "uniform": "Uniform prior: the sampler of SA and MS3D with the same weight for every point.",
    "shuffled": "Shuffled prior: the same sampler with the weights of MS3D dealt out to the points at random.",
}
CHOICES = {
    ARGMAX: "Arg-max: the most probable point of each output, without noise.",
    COMPLETED: "Completed: drawn, then farthest points of the cloud in place of repeated ones.",
}
TWIN = (
    "Classifier without point dropout: a twin of the task network that saw every training cloud whole. The best values "
    "are marked among the rows of one classifier."
)
DRAWS = "Standard deviation over draws: of the accuracy on all test shapes, pooled over trainings."
DISTINCT = "Distinct points: before S-NET, SampleNet and MetaSampler complete theirs."
DIFFERENCES = (
    "Differences: over the shapes of both rows, with a 95 % interval from a paired bootstrap over shapes. How much "
    "another training would change is not in it either."
)
P_VALUE = "McNemar's test: on the single predictions of one training each, so only without noise."


def sampling_footnotes(
    table: str, frame: pd.DataFrame, shapes: pd.DataFrame, draws: pd.DataFrame, rows: Sequence[Key], dataset: str
) -> list[str]:
    """Return the footnotes of a sampling table.

    Parameters
    ----------
    table
        Its name.
    frame
        The result table.
    shapes, draws
        The per-shape and per-draw rows that it was made of.
    rows
        Sampler, choice and classifier of the measured rows.
    dataset
        Name of the data set.
    """
    samplers, choices, classifiers = ({row[position] for row in rows} for position in range(3))
    metrics = set(frame.loc[frame["n"] > 0, "metric"])
    printed = set(frame.loc[frame["paper"].notna(), "method"])
    notes = [
        _lines(dataset),
        OTHER_CLASSIFIER if "FPS" in printed else "",
        BEST_ON_TEST,
        NO_PUBLISHED_RETRIEVAL if "metasampler" in samplers and "map" in metrics else "",
        _noise(rows, draws),
        *(note for choice, note in CHOICES.items() if choice in choices),
        LFS if "lfs" in samplers else "",
        *(note for prior, note in PRIOR_CONTROLS.items() if prior in samplers),
        TWIN if "plain" in classifiers else "",
        MARGIN if metrics & {"oa_interval", "map_interval"} else "",
        _deviations(rows, draws),
        DRAWS if "oa_draws" in metrics else "",
        DISTINCT if "distinct_points" in metrics and samplers & set(GENERATORS) else "",
        _retrieval(frame, shapes) if "map" in metrics else "",
        DIFFERENCES if table == PRIOR_TABLE and "oa_difference" in metrics else "",
        P_VALUE if "mcnemar_p" in metrics else "",
        *_failures(shapes[shapes["sampler"].isin(samplers)]),
    ]
    return [note for note in notes if note]


def _lines(dataset: str) -> str:
    """Say what the lines and columns of the table are."""
    return (
        "Columns: sampling ratio, points of the cloud for one chosen. Lines: paper, as printed for the 2468 test "
        f"shapes of ModelNet40; ours, on the data set {dataset}; difference, ours minus paper, which compares like "
        "with like only on the same shapes."
    )


def _noise(rows: Sequence[Key], draws: pd.DataFrame) -> str:
    """Say which rows are means over draws, and of how many."""
    drawn = {sampler for sampler, choice, _ in rows if choice == DRAWN}
    if not drawn:
        return ""
    counts = sorted(set(draws[draws["sampler"].isin(drawn) & (draws["choice"] == DRAWN)].groupby(SETTING).size()))
    numbers = " or ".join(map(str, counts)) or "an unrecorded number of"
    listed = ", ".join(name for sampler, name in SAMPLER_NAMES.items() if sampler in drawn)
    noise = " The noise of the learned samplers is on, as in the paper." if drawn & set(PRIORS) else ""
    return f"{listed}: means over {numbers} draws a shape.{noise}"


def _deviations(rows: Sequence[Key], draws: pd.DataFrame) -> str:
    """Say what the standard deviations of the CSV file are over."""
    learned = any(sampler in LEARNED for sampler, _, _ in rows)
    repeated = any(sampler not in LEARNED and choice == DRAWN for sampler, choice, _ in rows) and len(draws) > 0
    over = ["over trainings of the sampler, all with one task network" if learned else ""]
    over.append(f"over draws{' for random points' if learned else ''}" if repeated else "")
    if not any(over):
        return ""
    return f"Standard deviations are in the CSV file: {'; '.join(text for text in over if text)}."


def _retrieval(frame: pd.DataFrame, shapes: pd.DataFrame) -> str:
    """Say how the query counts, and which shapes have no value without it."""
    alone = (shapes["status"] == "ok") & shapes["average_precision_excluded"].isna()
    count = len(shapes.loc[alone, ["category", "id"]].drop_duplicates())
    counted = "Every shape is a query. As in the paper, it is itself ranked first and counts as found"
    if not (frame["metric"] == "map_excluded").any():
        return f"{counted}."
    left_out = f"; {count} shapes without another of their class have no value then" if count else ""
    return f"{counted}; the second table leaves it out of the ranking{left_out}."


def _failures(shapes: pd.DataFrame) -> list[str]:
    """Name the failed shapes of each sampler, up to a number."""
    notes = []
    for sampler, name in SAMPLER_NAMES.items():
        rows = shapes[shapes["sampler"] == sampler]
        failed = rows[rows["status"] == "failed"].drop_duplicates(["category", "id"])
        if not len(failed):
            continue
        named = [
            f"{shape} ({str(reason).splitlines()[0] if str(reason) else 'no reason recorded'})"
            for shape, reason in zip(failed["id"], failed["reason"].fillna(""), strict=True)
        ]
        more = f" and {len(named) - LISTED_FAILURES} more" if len(named) > LISTED_FAILURES else ""
        total = len(rows[["category", "id"]].drop_duplicates())
        notes.append(
            f"{name}: {len(named)} of {total} shapes failed and are left out of its means: "
            f"{'; '.join(named[:LISTED_FAILURES])}{more}."
        )
    return notes
