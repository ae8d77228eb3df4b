"""How well a trained network tells the parts of clouds: intersection over union, by shape."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.checksums import checked_file
from morphoskel.csv_frame import write_csv_frame
from morphoskel.errors import InputError
from morphoskel.progress import track
from morphoskel.shapes import FloatArray, IntArray

if TYPE_CHECKING:
    import pandas as pd

    from morphoskel.datasets.cloud_set import CloudSet
    from morphoskel.networks.part_segmentation import PartSegmentationNetwork
    from morphoskel.sampling.labelled_points import LabelRequest


def part_ious(predicted: IntArray, truth: IntArray, parts: Sequence[int] | IntArray) -> FloatArray:
    """Return the intersection over union of each part of a shape's category.

    Parameters
    ----------
    predicted, truth
        ``(N,)`` int64, the part of each point. Points whose true part is -1 are left out.
    parts
        Labels of the parts, P of them, whether the shape has them or not.

    Returns
    -------
    ndarray
        ``(P,)`` float64: the number of points that are of the part and predicted so, divided by the number of those
        that are either; 1 for a part that is neither there nor predicted.

    Raises
    ------
    ValueError
        If the arrays do not have one and the same length.
    """
    if predicted.ndim != 1 or predicted.shape != truth.shape:
        raise ValueError(f"expected predicted and true parts of the same points, got {predicted.shape}, {truth.shape}")
    known = truth >= 0
    labels = np.asarray(parts)[:, None]
    found, there = predicted[known] == labels, truth[known] == labels
    either = np.sum(found | there, axis=1)
    both = np.sum(found & there, axis=1)
    return np.where(either == 0, 1.0, both / np.maximum(either, 1))


def shape_iou(predicted: IntArray, truth: IntArray, parts: Sequence[int] | IntArray) -> float:
    """Return the mean of :func:`part_ious` over the parts of the category; at least one."""
    return float(part_ious(predicted, truth, parts).mean())


def evaluate_segmentation(network: PartSegmentationNetwork, clouds: CloudSet) -> pd.DataFrame:
    """Segment clouds and compare the parts with the true ones.

    Parameters
    ----------
    network
        In evaluation mode.
    clouds
        With parts. All their points enter the network; those that repeat others are not judged.

    Returns
    -------
    pandas.DataFrame
        One row a shape: id, category, status (always ``ok``), iou, the mean over the parts of its category, and
        accuracy, the share of the points that are right, both in [0, 1].

    Raises
    ------
    InputError
        If the clouds have no parts, or the network knows other categories or parts.
    """
    import pandas as pd

    from morphoskel.networks.part_segmentation import predict_parts

    if clouds.parts is None or clouds.part_classes is None:
        raise InputError("the clouds have no parts; expected those of a data set with parts")
    clouds.check_classes(network.class_names)
    if not np.array_equal(network.part_classes, clouds.part_classes):
        raise InputError(
            f"expected a network of parts whose categories are {', '.join(map(str, clouds.part_classes))}, got one of "
            f"{', '.join(map(str, network.part_classes))}; train one on this data set"
        )
    predicted = predict_parts(network, clouds.points, clouds.labels)
    of_category = [np.flatnonzero(clouds.part_classes == label) for label in range(len(clouds.class_names))]
    shapes = list(zip(predicted, clouds.parts, clouds.labels, strict=True))
    return pd.DataFrame(
        {
            "id": clouds.ids,
            "category": clouds.categories,
            "status": "ok",
            "iou": [shape_iou(found, truth, of_category[label]) for found, truth, label in shapes],
            "accuracy": [float(np.mean((found == truth)[truth >= 0])) for found, truth, _ in shapes],
        }
    )


def evaluate_segmentation_files(
    strategy: str,
    clouds: Path,
    networks: Sequence[Path],
    training_clouds: Sequence[Path],
    samples: Sequence[Path],
    output: Path,
    *,
    completed: bool,
    label_sets: int,
) -> None:
    """Write the rows of all networks of a strategy to a CSV file.

    Parameters
    ----------
    strategy
        Name of what chose the labelled points, for the rows.
    clouds
        File of the clouds to segment.
    networks
        Files ``.../{ratio}/{number}/network.pt``, of which the number is that of the training.
    training_clouds
        Files of the clouds that they learned from.
    samples
        Folders with the points chosen of each of those; none if all points are labelled.
    output
        The file to write: strategy, ratio, seed (the number of the training), the columns of
        :func:`evaluate_segmentation`, and labels, the mean number of different labelled points of a training shape.
    completed, label_sets
        See :class:`~morphoskel.sampling.labelled_points.LabelRequest`.

    Raises
    ------
    InputError
        If files are missing or do not belong together.
    """
    import pandas as pd

    from morphoskel.datasets.cloud_set import read_cloud_set
    from morphoskel.networks.part_segmentation import load_segmentation
    from morphoskel.sampling.labelled_points import LabelRequest

    if samples and len(samples) != len(training_clouds):
        raise InputError(
            f"expected a folder of chosen points for each of {len(training_clouds)} files of clouds, got {len(samples)}"
        )
    shapes = read_cloud_set(clouds)
    trained = [(read.lengths, read.points.shape[1]) for read in map(read_cloud_set, training_clouds)]
    frames = []
    for path in track(networks, f"segment, {strategy}", unit="network"):
        ratio, number = _ratio_and_number(path)
        request = LabelRequest(ratio, number, label_sets, completed)
        labels = _mean_labels(trained, samples, request)
        try:
            frame = evaluate_segmentation(load_segmentation(path), shapes)
        except InputError as error:
            raise InputError(f"{path}, on {clouds}: {error}") from error
        case = pd.DataFrame({"strategy": strategy, "ratio": ratio, "seed": number}, index=frame.index)
        frames.append(pd.concat([case, frame], axis="columns").assign(labels=labels))
    with checked_file(output) as partial:
        write_csv_frame(pd.concat(frames, ignore_index=True), partial)


def _mean_labels(trained: Sequence[tuple[IntArray, int]], samples: Sequence[Path], request: LabelRequest) -> float:
    """Return the mean number of different labelled points, in any of the sets, of the shapes that have some."""
    counts = np.concatenate(
        [_labels(*of_file, folder, request) for of_file, folder in zip(trained, samples, strict=True)]
        if samples
        else [lengths for lengths, _ in trained]
    )
    if not counts.any():
        raise InputError(f"{', '.join(map(str, samples))}: nothing was chosen of any shape; choose points first")
    return float(counts[counts > 0].mean())


def _labels(lengths: IntArray, points: int, folder: Path, request: LabelRequest) -> IntArray:
    """Return the number of different labelled points of each shape of one file, ``(S,)``."""
    from morphoskel.sampling.labelled_points import labelled_mask, read_label_sets

    draws = read_label_sets(folder, request)
    try:
        masks = [labelled_mask(indices, lengths, points) for indices in draws]
    except InputError as error:
        raise InputError(f"{folder}: {error}") from error
    counts: IntArray = np.sum(np.any(masks, axis=0), axis=1, dtype=np.int64)
    return counts


def _ratio_and_number(network: Path) -> tuple[int, int]:
    try:
        return int(network.parent.parent.name), int(network.parent.name)
    except ValueError as error:
        raise InputError(f"{network}: expected its folders to be named by ratio and number of the training") from error
