"""What the reader of the table of part segmentation must know, as footnotes that apply to the rows it has."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.sampling_footnotes import DIFFERENCES, LFS, MARGIN, PRIOR_CONTROLS
from morphoskel.sampling.samplers import LEARNED

if TYPE_CHECKING:
    import pandas as pd

PUBLISHED_SHAPES = {
    **{"Airplane": 341, "Bag": 14, "Cap": 11, "Car": 158, "Chair": 704, "Earphone": 14, "Guitar": 159, "Knife": 80},
    **{"Lamp": 286, "Laptop": 83, "Motorbike": 51, "Mug": 38, "Pistol": 44, "Rocket": 12, "Skateboard": 31},
    "Table": 848,
}
"""Test shapes of ShapeNetPart in each category, which are those of the paper: they reproduce each of its means."""

INTERSECTION_OVER_UNION = (
    "Intersection over union: of a shape, the mean over all parts of its category, where a part that is neither there "
    "nor predicted counts 1. Every point of a test cloud is predicted; points that only repeat others to fill up a "
    "cloud are not counted. The mean over categories is ours alone; the paper prints none."
)
ROWS = (
    "Ratio: points of a training cloud for one with a label. The best values are marked among the rows of one ratio, "
    "which differ in nothing but their labelled points."
)
LABELS = (
    "Points with a label: a point that was chosen twice counts once; training shapes of which nothing could be chosen "
    "are left out. In the CSV file, n is the number of trainings there."
)
DEVIATIONS = "Standard deviations are in the CSV file, over trainings of the segmentation network (divisor n - 1)."


def segmentation_footnotes(
    frame: pd.DataFrame, shapes: pd.DataFrame, dataset: str, decisions: Sequence[str], transferred_from: str
) -> list[str]:
    """Return the footnotes of the table of part segmentation, without those on the paper's values.

    Parameters
    ----------
    frame
        The result table.
    shapes
        The per-shape rows that it was made of.
    dataset
        Name of the data set.
    decisions
        Sentences: how what the paper leaves open was decided.
    transferred_from
        The data set that learned samplers were trained on; empty if it need not be told.
    """
    strategies = set(shapes["strategy"])
    metrics = set(frame.loc[frame["n"] > 0, "metric"])
    notes = [
        _lines(dataset),
        INTERSECTION_OVER_UNION,
        ROWS,
        f"What the paper leaves open was decided as follows. {' '.join(decisions)}" if decisions else "",
        f"Learned samplers: trained on {transferred_from}." if transferred_from and strategies & set(LEARNED) else "",
        LABELS if "labels" in metrics else "",
        DEVIATIONS if shapes["seed"].nunique() > 1 else "",
        MARGIN if "miou_interval" in metrics else "",
        DIFFERENCES if "miou_difference" in metrics else "",
        LFS if "lfs" in strategies else "",
        *(note for prior, note in PRIOR_CONTROLS.items() if prior in strategies),
        _failures(frame),
    ]
    return [note for note in notes if note]


def _lines(dataset: str) -> str:
    """Say what the lines of the table are."""
    return (
        f"Lines: paper, as printed for the {sum(PUBLISHED_SHAPES.values())} test shapes of ShapeNetPart; ours, on the "
        f"data set {dataset}; difference, ours minus paper, which compares like with like only on the same shapes. "
        "Categories are matched by name."
    )


def _failures(frame: pd.DataFrame) -> str:
    """Count the test shapes without a value in each row."""
    failed = frame[(frame["metric"] == "miou") & (frame["group"] == MEAN_OVER_SHAPES) & (frame["n_failed"] > 0)]
    counted = [
        f"{row['method']} {row['n_failed']} of {row['n'] + row['n_failed']}" for row in failed.to_dict("records")
    ]
    return f"Test shapes that failed, which are left out of the means: {'; '.join(counted)}." if counted else ""
