"""The paper's two tables of reconstruction errors: skeleton methods compared, and surface reconstructions compared."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import averages
from morphoskel.evaluation.protocol import EvaluationProtocol
from morphoskel.evaluation.sphere_metrics import (
    SphereDistances,
    cd_recon,
    hd_recon,
    mean_point_to_sphere,
    mean_sphere_to_point,
)
from morphoskel.reporting.comparison import (
    compose_footnotes,
    measured_frame,
    measured_rows,
    origin_footnote,
    weight_footnote,
    withhold_averages,
)
from morphoskel.reporting.names import skeleton_name, surface_name
from morphoskel.reporting.published import derive_averages, published_shape_counts, read_published
from morphoskel.reporting.table import ResultTable, assemble

if TYPE_CHECKING:
    import pandas as pd

MS3D, REFERENCE = skeleton_name("ms3d"), skeleton_name("point2skeleton")

DISTANCE_COLUMNS = tuple(field.name for field in fields(SphereDistances))

SHAPE_COLUMNS = ("id", "category", "surface", "method", "status", "reason", *DISTANCE_COLUMNS)
"""Columns of the per-shape rows."""

METRICS: dict[str, Callable[[SphereDistances, EvaluationProtocol], float]] = {
    "cd_recon": cd_recon,
    "hd_recon": lambda distances, _: hd_recon(distances),
    "cd_recon_points": lambda distances, _: mean_point_to_sphere(distances),
    "cd_recon_spheres": mean_sphere_to_point,
}
"""What is computed of each shape. The two terms stand alone as well, since one of them depends on the protocol."""

LISTED_FAILURES = 10
"""Failed shapes named in a footnote; the others are only counted."""

RELEASED_VALUES = (
    "The paper's averages of MS3D, BPA, Alpha and Poisson agree with its released evaluation (protocol released here): "
    "a mean over n shapes is divided by n + 1, which lowers it by 7 % for 13 shapes and by a third for 2, and the "
    "second Chamfer term by the number of surface points instead of spheres. The protocol correct does neither."
)


def skeleton_reconstruction(
    shapes: pd.DataFrame, published_folder: Path, *, dataset: str, seeds: Sequence[int], protocol: EvaluationProtocol
) -> ResultTable:
    """Build the table that compares skeleton methods: L1, DPC, P2S, MS3D and any other that was run.

    Parameters
    ----------
    shapes
        Columns :data:`SHAPE_COLUMNS`, one row a shape, surface and method. `surface` and `method` are the names of
        the configuration, `surface` empty if the method needs none; `status` is ``ok`` or ``failed``, and the
        numbers of a failed row do not matter. Rows on another surface than Poisson do not enter.
    published_folder
        The folder ``config/paper``.
    dataset, seeds, protocol
        How the rows came to be, and how to average them.

    Returns
    -------
    ResultTable
        The metrics CD-Recon, HD-Recon, CD-MAT, HD-MAT and the two terms of CD-Recon.

    Raises
    ------
    InputError
        If a column is missing, a row is illegal or appears twice, or a published table cannot be read.
    """
    _check(shapes)
    surfaces = shapes["surface"].fillna("").map(surface_name)
    named = shapes.assign(method=shapes["method"].map(skeleton_name))[surfaces.isin([surface_name("poisson"), ""])]
    return _build(named, "skeleton_reconstruction", published_folder, dataset, seeds, protocol)


def surface_reconstruction(
    shapes: pd.DataFrame, published_folder: Path, *, dataset: str, seeds: Sequence[int], protocol: EvaluationProtocol
) -> ResultTable:
    """Build the table that compares surface reconstructions for MS3D: BPA, Alpha, Poisson, and P2S for reference.

    Parameters, result and errors are those of :func:`skeleton_reconstruction`, but the rows of every surface enter.
    """
    _check(shapes)
    methods = shapes["method"].map(skeleton_name)
    surfaces = shapes["surface"].fillna("").map(surface_name)
    named = shapes.assign(method=surfaces.where(methods == MS3D, methods))[methods.isin([MS3D, REFERENCE])]
    return _build(named, "surface_reconstruction_ablation", published_folder, dataset, seeds, protocol)


def _build(
    shapes: pd.DataFrame,
    table: str,
    published_folder: Path,
    dataset: str,
    seeds: Sequence[int],
    protocol: EvaluationProtocol,
) -> ResultTable:
    """Average the rows of each method and set them beside the paper's table."""
    twice = shapes[shapes.duplicated(["id", "method"])]
    if len(twice):
        row = twice.iloc[0]
        raise InputError(f"shape {row['id']}: more than one row for {row['method']}; expected one a shape and method")
    rows: list[dict[str, object]] = []
    categories: dict[str, list[str]] = {}
    for method, of_method in shapes.groupby("method", sort=False):
        name = str(method)
        categories[name] = [str(category) for category in of_method["category"]]
        distances = [_distances(row) for row in of_method.to_dict("records")]
        for metric, measure in METRICS.items():
            values = [math.nan if of_shape is None else measure(of_shape, protocol) for of_shape in distances]
            rows.extend(measured_rows(name, metric, averages(values, categories[name], protocol)))

    counts = published_shape_counts(published_folder)
    published = derive_averages(read_published(published_folder, table), counts)
    published, withheld = withhold_averages(published, categories)
    frame = assemble(measured_frame(rows), published, dataset=dataset, seeds=seeds, protocol=protocol)
    weights = "" if withheld else weight_footnote(categories, counts)
    footnotes = [origin_footnote(dataset, counts), RELEASED_VALUES, withheld, weights, *_failures(shapes)]
    return ResultTable(frame, compose_footnotes(footnotes, published))


def _distances(row: Mapping[Any, Any]) -> SphereDistances | None:
    """Return the distances of one row, ``None`` if its shape failed."""
    if row["status"] == "failed":
        return None
    numbers = {name: float(row[name]) for name in DISTANCE_COLUMNS}
    bad = [name for name, number in numbers.items() if not (math.isfinite(number) and number >= 0)]
    if bad or numbers["surface_points"] < 1 or numbers["spheres"] < 1:
        raise InputError(
            f"shape {row['id']}, {row['method']}: status is ok, but {', '.join(bad) or 'a count'} is not a legal "
            "number; expected counts of at least 1 and finite distances of at least 0"
        )
    return SphereDistances(
        surface_points=int(numbers["surface_points"]),
        spheres=int(numbers["spheres"]),
        point_to_sphere_sum=numbers["point_to_sphere_sum"],
        point_to_sphere_max=numbers["point_to_sphere_max"],
        sphere_to_point_sum=numbers["sphere_to_point_sum"],
        sphere_to_point_max=numbers["sphere_to_point_max"],
    )


def _failures(shapes: pd.DataFrame) -> list[str]:
    """Name the failed shapes of each method, up to a number."""
    footnotes = []
    for method, rows in shapes[shapes["status"] == "failed"].groupby("method", sort=False):
        named = [
            f"{shape} ({str(reason).splitlines()[0] if str(reason) else 'no reason recorded'})"
            for shape, reason in zip(rows["id"], rows["reason"].fillna(""), strict=True)
        ]
        more = f" and {len(named) - LISTED_FAILURES} more" if len(named) > LISTED_FAILURES else ""
        total = int((shapes["method"] == method).sum())
        footnotes.append(
            f"{method}: {len(named)} of {total} shapes failed and are left out of its means: "
            f"{'; '.join(named[:LISTED_FAILURES])}{more}."
        )
    return footnotes


def _check(shapes: pd.DataFrame) -> None:
    """Raise unless the per-shape rows have their columns, names and a legal status."""
    missing = [column for column in SHAPE_COLUMNS if column not in shapes.columns]
    if missing:
        raise InputError(f"per-shape rows: the columns {', '.join(missing)} are missing")
    without_surface = shapes["surface"].isna() | (shapes["surface"] == "")
    problems = {
        "id, category and method must not be empty": shapes[["id", "category", "method"]].isna().any(axis=1),
        "expected the status ok or failed": ~shapes["status"].isin(["ok", "failed"]),
        "MS3D works on a surface; name it": without_surface & (shapes["method"].map(skeleton_name) == MS3D),
    }
    for problem, concerned in problems.items():
        if concerned.any():
            row = shapes[concerned].iloc[0]
            raise InputError(f"shape {row['id']}, method {row['method']}, status {row['status']}: {problem}")
