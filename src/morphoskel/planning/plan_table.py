"""An estimate as a table, and as plain values for a script."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from morphoskel.planning.estimate import Estimate, Row, amount_text
from morphoskel.planning.jobs import Job
from morphoskel.planning.schedule import wall_seconds

HEADER = ("rule", "jobs", "held", "worked", "GPU", "disk", "files", "measured -> planned")


def plan_values(jobs: Sequence[Job], plan: Estimate, at_once: Sequence[int]) -> dict[str, Any]:
    """Return everything that is known, in hours, bytes and numbers; ``None`` where nothing was measured."""
    measured = [row for row in plan.rows if row.measured]
    return {
        "rows": [_row_values(row) for row in plan.rows],
        "totals": {
            "jobs": len(jobs),
            "jobs_measured": sum(row.jobs for row in measured),
            "core_hours_held": sum(row.held for row in measured) / 3600,
            "core_hours_worked": sum(row.worked for row in measured) / 3600,
            "gpu_hours": _gpu_hours(plan.rows),
            "bytes": sum(row.size or 0.0 for row in measured),
            "files": sum(row.files or 0.0 for row in measured),
            "bytes_removed": sum(row.removed for row in measured),
        },
        "wall_hours": [
            {
                "at_once": number,
                "held": wall_seconds(jobs, [pair[0] for pair in plan.seconds], at_once=number) / 3600,
                "worked": wall_seconds(jobs, [pair[1] for pair in plan.seconds], at_once=number) / 3600,
            }
            for number in at_once
        ],
    }


def _row_values(row: Row) -> dict[str, Any]:
    return {
        "rule": row.rule,
        "kind": row.kind,
        "jobs": row.jobs,
        "core_hours_held": row.held / 3600 if row.measured else None,
        "core_hours_worked": row.worked / 3600 if row.measured else None,
        "gpu_hours": _gpu_hours([row]),
        "bytes": row.size,
        "files": row.files,
        "bytes_removed": row.removed,
        "measured": row.measured,
        "amount": row.amount if row.measured else None,
        "unit": row.unit,
        "basis": row.basis,
    }


def _gpu_hours(rows: Sequence[Row]) -> float | None:
    """Return 0 where no job asks for a graphics card, else ``None``: no run on one has been measured."""
    return None if any(row.gpu_jobs for row in rows) else 0.0


def render_plan(values: dict[str, Any]) -> str:
    """Return the values of :func:`plan_values` as text."""
    rows = sorted(values["rows"], key=lambda row: (not row["measured"], row["rule"], row["kind"]))
    totals = values["totals"]
    cells = [
        (
            f"{row['rule']} {row['kind']}".strip(), f"{row['jobs']:,}", _hours(row["core_hours_held"]),
            _hours(row["core_hours_worked"]), _hours(row["gpu_hours"]), _size(row["bytes"]), _count(row["files"]),
            f"{row['basis']} -> {amount_text(row['amount'])}" if row["measured"] else row["basis"],
        )
        for row in _drawn_together(rows)
    ]  # fmt: skip
    cells.append(
        ("sum of what is measured", f"{totals['jobs_measured']:,}", _hours(totals["core_hours_held"]),
         _hours(totals["core_hours_worked"]), _hours(totals["gpu_hours"]), _size(totals["bytes"]),
         _count(totals["files"]), "")
    )  # fmt: skip
    lines = _align([HEADER, *cells])
    lines.insert(-1, "")
    missing = totals["jobs"] - totals["jobs_measured"]
    lines += ["", f"{totals['jobs']:,} jobs in all. {missing:,} of them were not measured and are in no sum."]
    if totals["bytes_removed"]:
        lines.append(
            f"Beside, {_size(totals['bytes_removed'])} are written in all and removed as soon as they are read."
        )
    lines += ["", "jobs at once  wall hours, held  worked"]
    lines += [
        f"{wall['at_once']:>12,}  {_hours(wall['held']):>16}  {_hours(wall['worked']):>6}"
        for wall in values["wall_hours"]
    ]
    return "\n".join([*lines, "", LEGEND])


def _drawn_together(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the rows with one in the place of all figures, and of all tables, that were not measured."""
    result: dict[str, dict[str, Any]] = {}
    for row in rows:
        name = row["rule"].split("_")[0]
        together = not row["measured"] and name in ("figure", "table")
        key = f"{name}s" if together else f"{row['rule']} {row['kind']} {row['basis']}"
        if together and key in result:
            result[key]["jobs"] += row["jobs"]
        else:
            result[key] = {**row, "rule": key} if together else row
    return list(result.values())


LEGEND = """\
held    core-hours that jobs hold: their seconds times their cores. Too many if other work was on the machine.
worked  core-hours of the processor. Too few for short jobs, which Snakemake looks at now and then only.
disk and files are what stays. A row is the measured cost, divided by the amount of work that it was for and multiplied
by the planned amount; the start of jobs is in it. Wall hours know which job waits for which, but neither the queue of a
cluster nor the jobs that were not measured."""


def _align(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADER))]
    last = len(HEADER) - 1
    return [
        "  ".join(
            cell.ljust(width) if column in (0, last) else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _hours(value: float | None) -> str:
    if value is None:
        return "?"
    return "0" if value == 0 else f"{value:,.2f}"


def _size(value: float | None) -> str:
    if value is None:
        return "?"
    for unit, scale in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if value >= scale:
            return f"{value / scale:.1f} {unit}"
    return f"{value / 1e3:.1f} kB" if value else "0"


def _count(value: float | None) -> str:
    return "?" if value is None else f"{value:,.0f}"
