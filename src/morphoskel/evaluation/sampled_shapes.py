"""Judge the points that a sampler chose: whether shapes are still recognised and still find their like."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from morphoskel.checksums import checked_file
from morphoskel.csv_frame import write_csv_frame
from morphoskel.evaluation.classification import classify
from morphoskel.evaluation.retrieval import average_precisions
from morphoskel.progress import track
from morphoskel.sampling.choice import FIXED, Choice

if TYPE_CHECKING:
    import pandas as pd

    from morphoskel.datasets.cloud_set import CloudSet
    from morphoskel.networks.pointnet_classifier import PointNetClassifier
    from morphoskel.sampling.choose_for_split import Key

ALL_POINTS = "all_points"
"""Stands for a sampler that leaves every point where it is."""

Values = dict[str, npt.NDArray[np.float64]]


def every_point(clouds: CloudSet) -> dict[Key, Choice]:
    """Return the choice of all points of each cloud."""
    shapes, available = clouds.points.shape[:2]
    indices = np.broadcast_to(np.arange(available, dtype=np.int32), (1, shapes, available))
    return {(1, 0, FIXED): Choice(indices, np.full((1, shapes), available, dtype=np.int32))}


def evaluate_choices(
    sampler: str,
    choices: Mapping[Key, Choice],
    clouds: CloudSet,
    classifiers: Mapping[str, PointNetClassifier],
    reasons: npt.NDArray[np.str_] | None = None,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Classify the chosen points and retrieve shapes by their descriptors.

    Parameters
    ----------
    sampler
        Name, for the rows.
    choices
        By ratio, number of the training and kind.
    clouds
        That the points were chosen of.
    classifiers
        By name; in evaluation mode.
    reasons
        ``(S,)`` text: why nothing was chosen of a shape.

    Returns
    -------
    tuple of pandas.DataFrame
        One row a shape, with means over the draws: sampler, ratio, seed (the number of the training), choice,
        classifier, id, category, status, reason, correct, average_precision, average_precision_excluded, distinct.
        And one row a draw: sampler, ratio, seed, choice, classifier, draw, oa, map, map_excluded, all in [0, 1].
        Shapes of which nothing was chosen neither query nor are retrieved.

    Raises
    ------
    InputError
        If a classifier knows other classes.
    """
    import pandas as pd

    for classifier in classifiers.values():
        clouds.check_classes(classifier.class_names)
    cases = [(key, name) for key in choices for name in classifiers]
    of_shapes, of_draws = [], []
    for (ratio, number, kind), name in track(cases, f"evaluate {sampler}", unit="evaluation"):
        choice = choices[ratio, number, kind]
        case = {"sampler": sampler, "ratio": ratio, "seed": number, "choice": kind, "classifier": name}
        draws = list(_judge(choice, clouds, classifiers[name]))
        of_draws += [{**case, "draw": draw, **_means(values)} for draw, values in enumerate(draws)]
        of_shapes.append(_shape_rows(case, choice, draws, clouds, reasons))
    return pd.concat(of_shapes, ignore_index=True), pd.DataFrame(of_draws)


def evaluate_files(
    sampler: str,
    clouds: Path,
    samples: Path | None,
    priors: Path | None,
    classifiers: Mapping[str, Path],
    outputs: tuple[Path, Path],
) -> None:
    """Write the rows of :func:`evaluate_choices` to two CSV files.

    Parameters
    ----------
    sampler
        Name, for the rows.
    clouds
        File of a split's clouds.
    samples
        Folder of chosen points; ``None`` for all points.
    priors
        File of local feature sizes, which knows why shapes failed.
    classifiers
        Files by name.
    outputs
        The files to write, of the shapes and of the draws.
    """
    from morphoskel.datasets.cloud_set import read_cloud_set
    from morphoskel.networks.pointnet_classifier import load_classifier
    from morphoskel.sampling.choose_for_split import read_choices
    from morphoskel.sampling.prior_set import read_prior_set

    shapes = read_cloud_set(clouds)
    frames = evaluate_choices(
        sampler,
        read_choices(samples) if samples else every_point(shapes),
        shapes,
        {name: load_classifier(path) for name, path in classifiers.items()},
        read_prior_set(priors, shapes).reasons if priors else None,
    )
    for frame, path in zip(frames, outputs, strict=True):
        with checked_file(path) as partial:
            write_csv_frame(frame, partial)


def _judge(choice: Choice, clouds: CloudSet, classifier: PointNetClassifier) -> Iterator[Values]:
    """Yield the values of all shapes, one draw after the other; NaN for shapes of which nothing was chosen."""
    for indices in choice.indices:
        known = indices[:, 0] >= 0
        chosen = np.take_along_axis(clouds.points[known], indices[known, :, None].astype(np.int64), axis=1)
        labels = clouds.labels[known]
        predicted, descriptors = classify(classifier, chosen)
        measured = {
            "correct": (predicted == labels).astype(np.float64),
            "average_precision": average_precisions(descriptors, labels, include_query=True),
            "average_precision_excluded": average_precisions(descriptors, labels, include_query=False),
        }
        values: Values = {name: np.full(len(clouds), np.nan) for name in measured}
        for name, column in measured.items():
            values[name][known] = column
        yield values


def _means(values: Values) -> dict[str, float]:
    columns = {"oa": "correct", "map": "average_precision", "map_excluded": "average_precision_excluded"}
    return {name: _mean_of_known(values[column]) for name, column in columns.items()}


def _mean_of_known(values: npt.NDArray[np.float64]) -> float:
    known = values[~np.isnan(values)]
    return float(known.mean()) if len(known) else float("nan")


def _shape_rows(
    case: Mapping[str, Any], choice: Choice, draws: list[Values], clouds: CloudSet, reasons: npt.NDArray[np.str_] | None
) -> pd.DataFrame:
    import pandas as pd

    failed = choice.indices[0, :, 0] < 0
    why = np.where(failed, "nothing was chosen" if reasons is None else reasons, "")
    return pd.DataFrame(
        {
            **{name: np.full(len(clouds), value) for name, value in case.items()},
            "id": clouds.ids,
            "category": clouds.categories,
            "status": np.where(failed, "failed", "ok"),
            "reason": why,
            **{name: np.mean([values[name] for values in draws], axis=0) for name in draws[0]},
            "distinct": np.where(failed, np.nan, choice.distinct.mean(axis=0)),
        }
    )
