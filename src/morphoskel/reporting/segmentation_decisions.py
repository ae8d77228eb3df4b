"""What the experiment on part segmentation decided where the paper leaves it open, as sentences for the caption."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any


def describe_decisions(
    task: Mapping[str, Any], splits: tuple[Sequence[str], str | None], axes: Sequence[str] | None
) -> list[str]:
    """Return one sentence for each open decision.

    Parameters
    ----------
    task
        The section ``tasks.segmentation`` as plain values.
    splits
        The splits to train on, and the one that chooses the epoch, if there is one.
    axes
        Which axes of the data set's files become x, y and z; ``None`` if they are taken as they are.
    """
    network = task["network"]
    return [
        _inputs(network["training_input"], network["training_points"]),
        f"Tested on {task['points']} points of each cloud, drawn without replacement; clouds with fewer repeat theirs, "
        "and the repetitions do not count.",
        _transfer(axes),
        _labels(task["label_sets"]),
        _repetitions(task["completed"]),
        "Only the parts of a shape's own category can be predicted."
        if network["restrict_to_category"]
        else "Any of the parts of all categories can be predicted.",
        "The network is told the category of each shape."
        if network["know_category"]
        else "The network is not told the category of a shape.",
        _epoch(task, *splits),
        *_full_supervision(task["full_supervision"]),
        "Farthest points start with the first point of the cloud.",
    ]


def _inputs(training_input: str, training_points: int | None) -> str:
    if training_input == "labelled":
        most = "" if training_points is None else f", at most {training_points} a step,"
        return f"In training the labelled points alone{most} enter the network."
    cloud = (
        "the whole cloud enters"
        if training_points is None
        else f"{training_points} points of a cloud, three quarters of them with labels, drawn anew in every step, enter"
    )
    return f"In training {cloud} the network, and the loss counts the labelled points alone."


def _transfer(axes: Sequence[str] | None) -> str:
    turned = (
        "" if not axes or list(axes) == ["x", "y", "z"] else f" The axes x, y, z are {', '.join(axes)} of the files."
    )
    return (
        "Learned samplers are those of the classification experiment, unchanged: they choose as many points of a "
        f"larger cloud as they were trained to.{turned}"
    )


def _labels(label_sets: int) -> str:
    if label_sets == 1:
        return "The labelled points of a shape are chosen once for each training."
    return f"The labelled points of a shape are chosen {label_sets} times for each training; the epochs take turns."


def _repetitions(completed: bool) -> str:
    if completed:
        return "Farthest points take the place of points that a sampler chose twice."
    return "A point that a sampler chose twice is one label; the table counts them."


def _epoch(task: Mapping[str, Any], training: Sequence[str], validation: str | None) -> str:
    shapes = (
        f"the shapes of the split {validation}"
        if validation
        else f"the {100 * task['validation_share']:g} % of the training shapes that are held out"
    )
    points = "the labelled points" if task["validation_labels"] == "labelled" else "all points"
    return f"Trained on {' and '.join(training)}; the epoch is that of the smallest loss on {points} of {shapes}."


def _full_supervision(changes: Mapping[str, int | None]) -> list[str]:
    words = {
        "epochs": "{} epochs",
        "decay_epochs": "{} epochs between decays of the learning rate",
        "training_points": "{} points of a cloud a step",
    }
    changed = [words[name].format(value) for name, value in changes.items() if value is not None]
    return [f"Trained otherwise: the row with all labels, with {', '.join(changed)}."] if changed else []
