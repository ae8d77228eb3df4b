"""What planned jobs will take, scaled from what measured ones took."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from morphoskel.errors import InputError
from morphoskel.planning.extent import Extent
from morphoskel.planning.jobs import Job
from morphoskel.planning.measurements import Measured
from morphoskel.planning.work import WORK, Work, fingerprint


@dataclass
class Row:
    """All planned jobs of a rule and kind that are estimated from one measurement, or from none.

    Parameters
    ----------
    rule, kind
        As in :class:`~morphoskel.planning.measurements.Measured`.
    basis
        What was measured, or why nothing can be said.
    unit
        Of the amount of work; empty where nothing was measured.
    measured
        Whether there is a measurement.
    jobs
        How many.
    amount
        Of work in them.
    held, worked
        Core-seconds, see :class:`~morphoskel.planning.measurements.Measured`; 0 where nothing was measured.
    gpu_jobs
        Jobs that ask for a graphics card.
    size, files
        Bytes and files that stay; ``None`` where nothing was measured.
    removed
        Bytes that are removed after use.
    """

    rule: str
    kind: str
    basis: str
    unit: str
    measured: bool
    jobs: int = 0
    amount: float = 0.0
    held: float = 0.0
    worked: float = 0.0
    gpu_jobs: int = 0
    size: float | None = None
    files: float | None = None
    removed: float = 0.0


@dataclass
class Estimate:
    """The rows, and the seconds of each job: if its cores wait as they did when it was measured, and if they never do.

    Parameters
    ----------
    rows
        In the order of the plan.
    seconds
        ``(longest, shortest)`` of each job; 0 of those that were not measured.
    """

    rows: list[Row] = field(default_factory=list)
    seconds: list[tuple[float, float]] = field(default_factory=list)


def estimate(jobs: Sequence[Job], extent: Extent, measurements: Sequence[Measured]) -> Estimate:
    """Scale measurements to planned jobs.

    Parameters
    ----------
    jobs
        As planned.
    extent
        The configuration that they were planned with.
    measurements
        Of one or several runs; of several that fit, the first one counts.

    Returns
    -------
    Estimate
        With a row for each rule and kind. A job counts as measured only if a measured job of its rule and kind had the
        same settings; nothing is put in its place otherwise.
    """
    result, rows = Estimate(), dict[tuple[str, str, str], Row]()
    for job in jobs:
        work = WORK.get(job.rule)
        found, reason = _find(job, work, extent, measurements)
        kind = job.wildcards.get(work.by, "") if work else ""
        basis = _describe(found, work) if found and work else reason
        unit = work.unit if found and work else ""
        row = rows.setdefault((job.rule, kind, basis), Row(job.rule, kind, basis, unit, found is not None))
        row.jobs += 1
        row.gpu_jobs += job.gpus > 0
        held = worked = 0.0
        if found and work:
            amount = work.amount(extent, job.wildcards)
            held, worked = found.held * amount / found.amount, found.worked * amount / found.amount
            row.amount += amount
            _add_files(row, job, work, found, extent)
        row.held += held
        row.worked += worked
        result.seconds.append((held / job.threads, worked / job.threads))
    result.rows = list(rows.values())
    return result


def _find(job: Job, work: Work | None, extent: Extent, measurements: Sequence[Measured]) -> tuple[Measured | None, str]:
    """Return the measurement that a job is scaled from, or why there is none."""
    if work is None:
        return None, "no measure of its cost"
    kind = job.wildcards.get(work.by, "")
    of_rule = [each for each in measurements if (each.rule, each.kind) == (job.rule, kind)]
    if not of_rule:
        return None, "not measured"
    try:
        work.amount(extent, job.wildcards)
    except InputError as error:
        return None, str(error)
    wanted = fingerprint(work, extent, job.wildcards)
    fitting = [each for each in of_rule if each.settings == wanted]
    if not fitting:
        return None, f"measured with other settings only ({', '.join(sorted({each.source for each in of_rule}))})"
    return fitting[0], ""


def _describe(found: Measured, work: Work) -> str:
    return f"{found.source}: {found.jobs} job{'s' * (found.jobs > 1)}, {amount_text(found.amount)} {work.unit}"


def amount_text(amount: float) -> str:
    """Return an amount of work as text of three digits, or of all of them if they are few."""
    return f"{amount:,.0f}" if amount < 1e6 else f"{amount:.3g}"


def _add_files(row: Row, job: Job, work: Work, found: Measured, extent: Extent) -> None:
    if not found.files:
        return
    by_shape = extent.shapes(job.wildcards) / found.shapes
    if not work.intermediate:
        row.size = (row.size or 0.0) + found.size * by_shape
        row.files = (row.files or 0.0) + found.files * by_shape
        return
    size = found.size * work.amount(extent, job.wildcards) / found.written_amount
    if extent.config["keep_intermediates"]:
        row.size = (row.size or 0.0) + size
        row.files = (row.files or 0.0) + found.files * by_shape
    else:
        row.size, row.files, row.removed = row.size or 0.0, row.files or 0.0, row.removed + size
