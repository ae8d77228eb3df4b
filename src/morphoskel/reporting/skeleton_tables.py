"""The paper's two tables of reconstruction errors: skeleton methods compared, and surface reconstructions compared."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import averages
from morphoskel.evaluation.protocol import EvaluationProtocol
from morphoskel.evaluation.skeletons import AS_IS, DENSE
from morphoskel.reporting.comparison import (
    compose_footnotes,
    measured_frame,
    measured_rows,
    origin_footnote,
    weight_footnote,
    withhold_averages,
)
from morphoskel.reporting.names import method_name, skeleton_name, surface_name
from morphoskel.reporting.published import derive_averages, published_shape_counts, read_published
from morphoskel.reporting.shape_values import DISTANCE_COLUMNS, AxisOrigin, metric_values
from morphoskel.reporting.table import ResultTable, assemble

if TYPE_CHECKING:
    import pandas as pd

MS3D, REFERENCE = "ms3d", "point2skeleton"

SHAPE_COLUMNS = ("id", "category", "surface", "method", "balls", "status", "reason", *DISTANCE_COLUMNS)
"""Columns of the per-shape rows; further ones are `seconds` and :data:`AXIS_COLUMNS`."""

COMPUTED_AXIS = (
    "MAT*: distances to medial axes that this run computed from the closed surfaces (repaired Poisson by default), "
    "not to the reference axes of the paper. They compare our rows with each other, never with the paper's CD-MAT and "
    "HD-MAT."
)

TIMES = (
    "Time a shape: all stages from the cloud to the skeleton, each timed in the process of the shape, while others ran "
    "beside it; training is not in it. The paper names no times here."
)

LISTED_FAILURES = 10
"""Failed shapes named in a footnote; the others are only counted."""

RELEASED_VALUES = (
    "The paper's averages of MS3D, BPA, Alpha and Poisson agree with its released evaluation (protocol released here): "
    "a mean over n shapes is divided by n + 1, which lowers it by 7 % for 13 shapes and by a third for 2, and the "
    "second Chamfer term by the number of surface points instead of spheres, which lowers it for fewer spheres than "
    "points and raises it for more, such as the dense balls of P2S. The protocol correct does neither."
)


def skeleton_reconstruction(
    shapes: pd.DataFrame,
    published_folder: Path,
    *,
    dataset: str,
    seeds: Sequence[int],
    protocol: EvaluationProtocol,
    axis: AxisOrigin = "computed",
) -> ResultTable:
    """Build the table that compares skeleton methods, each with its own balls and with equal numbers of them.

    Parameters
    ----------
    shapes
        Columns :data:`SHAPE_COLUMNS`, one row a shape, surface, method and kind of balls. `surface` and `method` are
        the names of the configuration, `surface` ``cloud`` or empty if the method needs none; `status` is ``ok`` or
        ``failed``, and the numbers of a failed row do not matter. Rows on other surfaces than plain and repaired
        Poisson do not enter.
    published_folder
        The folder ``config/paper``.
    dataset, seeds, protocol
        How the rows came to be, and how to average them.
    axis
        Where the reference axes come from. Only given ones stand beside the paper's.

    Returns
    -------
    ResultTable
        The metrics CD-Recon, HD-Recon, CD-MAT, HD-MAT, the two terms of CD-Recon, and seconds.

    Raises
    ------
    InputError
        If a column is missing, a row is illegal or appears twice, or a published table cannot be read.
    """
    _check(shapes)
    chosen = shapes[shapes["surface"].fillna("").isin(["poisson", "repaired_poisson", "cloud", ""])]
    chosen = chosen.sort_values("balls", key=_order_of_balls, kind="stable")
    labels = [
        method_name(str(method), str(surface), str(balls))
        for method, surface, balls in zip(chosen["method"], chosen["surface"].fillna(""), chosen["balls"], strict=True)
    ]
    named = chosen.assign(label=labels)
    return _build(named, "skeleton_reconstruction", published_folder, dataset, seeds, protocol, axis)


def surface_reconstruction(
    shapes: pd.DataFrame,
    published_folder: Path,
    *,
    dataset: str,
    seeds: Sequence[int],
    protocol: EvaluationProtocol,
    axis: AxisOrigin = "computed",
) -> ResultTable:
    """Build the table that compares surface reconstructions for MS3D, with P2S (dense balls) for reference.

    Parameters, result and errors are those of :func:`skeleton_reconstruction`, but the rows of MS3D on every surface
    enter, and only its own balls.
    """
    _check(shapes)
    own = (shapes["method"] == MS3D) & (shapes["balls"] == AS_IS)
    reference = (shapes["method"] == REFERENCE) & (shapes["balls"] == DENSE)
    surfaces = shapes["surface"].fillna("").map(surface_name)
    named = shapes.assign(label=surfaces.where(own, skeleton_name(REFERENCE)))[own | reference]
    return _build(named, "surface_reconstruction_ablation", published_folder, dataset, seeds, protocol, axis)


def _order_of_balls(kinds: pd.Series[str]) -> pd.Series[int]:
    """Sort the methods' own balls first, then dense ones, then equal counts."""
    order = {AS_IS: 0, DENSE: 1}
    return kinds.map(lambda kind: order[kind] if kind in order else 1 + int(kind))


def _build(
    shapes: pd.DataFrame,
    table: str,
    published_folder: Path,
    dataset: str,
    seeds: Sequence[int],
    protocol: EvaluationProtocol,
    axis: AxisOrigin,
) -> ResultTable:
    """Average the rows of each label and set them beside the paper's table."""
    twice = shapes[shapes.duplicated(["id", "label"])]
    if len(twice):
        row = twice.iloc[0]
        raise InputError(f"shape {row['id']}: more than one row for {row['label']}; expected one a shape and row")
    rows: list[dict[str, object]] = []
    categories: dict[str, list[str]] = {}
    for label, of_label in shapes.groupby("label", sort=False):
        name = str(label)
        categories[name] = [str(category) for category in of_label["category"]]
        for metric, values in metric_values(of_label.to_dict("records"), protocol, axis).items():
            rows.extend(measured_rows(name, metric, averages(values, categories[name], protocol)))

    counts = published_shape_counts(published_folder)
    published = derive_averages(read_published(published_folder, table), counts)
    published, withheld = withhold_averages(published, categories)
    frame = assemble(measured_frame(rows), published, dataset=dataset, seeds=seeds, protocol=protocol)
    weights = "" if withheld else weight_footnote(categories, counts)
    metrics = {str(row["metric"]) for row in rows}
    footnotes = [
        origin_footnote(dataset, counts),
        RELEASED_VALUES,
        COMPUTED_AXIS if "cd_mat_computed" in metrics else "",
        TIMES if "seconds" in metrics else "",
        withheld,
        weights,
        *_failures(shapes),
    ]
    return ResultTable(frame, compose_footnotes(footnotes, published))


def _failures(shapes: pd.DataFrame) -> list[str]:
    """Name the failed shapes of each method, up to a number."""
    footnotes = []
    for label, rows in shapes[shapes["status"] == "failed"].groupby("label", sort=False):
        named = [
            f"{shape} ({str(reason).splitlines()[0] if str(reason) else 'no reason recorded'})"
            for shape, reason in zip(rows["id"], rows["reason"].fillna(""), strict=True)
        ]
        more = f" and {len(named) - LISTED_FAILURES} more" if len(named) > LISTED_FAILURES else ""
        total = int((shapes["label"] == label).sum())
        footnotes.append(
            f"{label}: {len(named)} of {total} shapes failed and are left out of its means: "
            f"{'; '.join(named[:LISTED_FAILURES])}{more}."
        )
    return footnotes


BALLS = rf"{AS_IS}|{DENSE}|[0-9]+"


def _check(shapes: pd.DataFrame) -> None:
    """Raise unless the per-shape rows have their columns, names and a legal status."""
    missing = [column for column in SHAPE_COLUMNS if column not in shapes.columns]
    if missing:
        raise InputError(f"per-shape rows: the columns {', '.join(missing)} are missing")
    without_surface = shapes["surface"].isna() | (shapes["surface"] == "")
    problems = {
        "id, category and method must not be empty": shapes[["id", "category", "method"]].isna().any(axis=1),
        "expected the status ok or failed": ~shapes["status"].isin(["ok", "failed"]),
        "MS3D works on a surface; name it": without_surface & (shapes["method"] == MS3D),
        "expected balls to be 'as is', 'dense' or a number": ~shapes["balls"].astype(str).str.fullmatch(BALLS),
    }
    for problem, concerned in problems.items():
        if concerned.any():
            row = shapes[concerned].iloc[0]
            raise InputError(f"shape {row['id']}, method {row['method']}, status {row['status']}: {problem}")
