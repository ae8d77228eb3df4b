"""From the distances of one shape to its values for each metric of the skeleton tables."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from typing import Any, Literal

from morphoskel.errors import InputError
from morphoskel.evaluation.protocol import EvaluationProtocol
from morphoskel.evaluation.sphere_metrics import (
    SphereDistances,
    cd_recon,
    hd_recon,
    mean_point_to_sphere,
    mean_sphere_to_point,
)

DISTANCE_COLUMNS = tuple(field.name for field in fields(SphereDistances))
AXIS_COLUMNS = tuple(f"axis_{name}" for name in DISTANCE_COLUMNS)

AxisOrigin = Literal["given", "computed"]
"""Where reference axes come from: files of the user, or this run."""

Measure = Callable[[SphereDistances, EvaluationProtocol], float]

METRICS: dict[str, Measure] = {
    "cd_recon": cd_recon,
    "hd_recon": lambda distances, _: hd_recon(distances),
    "cd_recon_points": lambda distances, _: mean_point_to_sphere(distances),
    "cd_recon_spheres": mean_sphere_to_point,
}
"""What is computed of each shape. The two terms stand alone as well, since one of them depends on the protocol."""

AXIS_METRICS: dict[str, Measure] = {"cd_mat": cd_recon, "hd_mat": lambda distances, _: hd_recon(distances)}
"""The same between the centres of the balls and the points of the reference axis."""


def metric_values(
    rows: Sequence[Mapping[Any, Any]], protocol: EvaluationProtocol, axis: AxisOrigin
) -> dict[str, list[float]]:
    """Return the value of every shape for each metric that was measured, NaN where it was not.

    Parameters
    ----------
    rows
        Per-shape rows with `status`, :data:`DISTANCE_COLUMNS`, and possibly `seconds` and :data:`AXIS_COLUMNS`.
    protocol
        How sums become means.
    axis
        Where the reference axes come from.

    Raises
    ------
    InputError
        If a row has an illegal number.
    """
    distances = [_distances(row, "") for row in rows]
    values = {name: [_value(measure, found, protocol) for found in distances] for name, measure in METRICS.items()}
    to_axis = [_distances(row, "axis_") for row in rows]
    if any(found is not None for found in to_axis):
        suffix = "" if axis == "given" else "_computed"
        for name, measure in AXIS_METRICS.items():
            values[name + suffix] = [_value(measure, found, protocol) for found in to_axis]
    seconds = [float(row.get("seconds", math.nan)) for row in rows]
    if not all(map(math.isnan, seconds)):
        values["seconds"] = seconds
    return values


def _value(measure: Measure, distances: SphereDistances | None, protocol: EvaluationProtocol) -> float:
    return math.nan if distances is None else measure(distances, protocol)


def _distances(row: Mapping[Any, Any], prefix: str) -> SphereDistances | None:
    """Return the distances of one row, ``None`` if its shape failed or, with the prefix, has no reference axis."""
    if row["status"] == "failed":
        return None
    numbers = {name: float(row.get(prefix + name, math.nan)) for name in DISTANCE_COLUMNS}
    if prefix and all(map(math.isnan, numbers.values())):
        return None
    bad = [prefix + name for name, number in numbers.items() if not (math.isfinite(number) and number >= 0)]
    if bad or numbers["surface_points"] < 1 or numbers["spheres"] < 1:
        raise InputError(
            f"shape {row['id']}, {row['label']}: status is ok, but {', '.join(bad) or 'a count'} is not a legal "
            "number; expected counts of at least 1 and finite distances of at least 0"
        )
    surface_points, spheres = (int(numbers.pop(name)) for name in ("surface_points", "spheres"))
    return SphereDistances(surface_points, spheres, **numbers)
