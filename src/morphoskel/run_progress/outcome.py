"""What came of a run: where its results are, or what failed and how to go on."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePath

SHOWN = ("report", "tables", "figures")
"""Folders of a run that hold what people look at."""

MOST_FAILURES = 20
"""Jobs that are named; the others are counted."""


@dataclass(frozen=True)
class Job:
    """A job of the workflow.

    Parameters
    ----------
    rule
        Its name.
    wildcards
        Their values, in the rule's order.
    outputs, logs
        Paths, relative to the repository.
    """

    rule: str
    wildcards: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    logs: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.rule} ({', '.join(self.wildcards)})" if self.wildcards else self.rule


def describe_results(finished: Iterable[Job]) -> list[str]:
    """Return lines that tell where report, tables and figures are that jobs have made; none if they made none.

    Files that differ in their suffix alone share a line, and figures in a folder are counted.
    """
    found: dict[str, dict[PurePath, list[str]]] = {kind: {} for kind in SHOWN}
    for path in (PurePath(output) for job in finished for output in job.outputs):
        kind = path.parent.name
        if path.parts[0] == "results" and kind in SHOWN and path.suffix != ".json":
            found[kind].setdefault(path.with_suffix(""), []).append(path.suffix.removeprefix("."))
    lines = [f"report  {path}.{suffix}" for path, suffixes in found["report"].items() for suffix in suffixes]
    lines += [f"table   {path}.{_alternatives(suffixes)}" for path, suffixes in sorted(found["tables"].items())]
    for folder in dict.fromkeys(path.parent for path in found["figures"]):
        count = sum(path.parent == folder for path in found["figures"])
        lines.append(f"{'figure ' if count == 1 else 'figures'} {folder}/ ({count})")
    return lines


def describe_failures(failed: Sequence[Job], done: int, total: int, command: str) -> list[str]:
    """Return lines that name the jobs that failed and their logs, and tell how to go on; none if all is done.

    Parameters
    ----------
    failed
        Jobs that failed and were not made up for by another attempt.
    done, total
        Numbers of jobs.
    command
        What the user started the run with; may be empty.
    """
    if done >= total and not failed:
        return []
    lines = [f"{done} of {total} jobs are done" + (f", {len(failed)} failed:" if failed else ".")]
    lines += [f"  {job}: {', '.join(job.logs) or 'no log'}" for job in failed[:MOST_FAILURES]]
    if len(failed) > MOST_FAILURES:
        lines.append(f"  and {len(failed) - MOST_FAILURES} more")
    again = f"`{command}`" if command else "The same command"
    return [*lines, f"{again} goes on where this run stopped; what is finished is kept."]


def _alternatives(suffixes: Sequence[str]) -> str:
    return suffixes[0] if len(suffixes) == 1 else f"{{{','.join(sorted(suffixes))}}}"
