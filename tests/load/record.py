"""Put the numbers of a finished load test into the documentation."""

import json
import shutil

import pandas as pd

BEGIN, END = "<!-- numbers: begin -->", "<!-- numbers: end -->"
"""What lies between these lines of ``docs/load.md`` is written by this module alone."""


def record(load, reference, page):
    """Copy the summary and the memory by the minute to `reference`, and write both into `page`."""
    reference.mkdir(parents=True, exist_ok=True)
    shutil.copy(load.folder / "summary.json", reference)
    memory = pd.read_csv(load.folder / "memory.csv", keep_default_na=False)
    by_minute(memory).to_csv(reference / "memory.csv", index=False, float_format="%.1f")
    write_page(reference, page)


def by_minute(memory):
    """Return the median and the largest memory of each role and stage in each minute of each attempt."""
    memory = memory.assign(minute=(memory["seconds"] // 60).astype(int))
    groups = memory.groupby(["attempt", "minute", "role", "stage"], as_index=False)
    return groups.agg(jobs=("jobs", "max"), median_mb=("megabytes", "median"), largest_mb=("megabytes", "max"))


def write_page(reference, page):
    """Replace what lies between the marks of `page`."""
    text = page.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    summary = json.loads((reference / "summary.json").read_text(encoding="utf-8"))
    page.write_text(f"{before}{BEGIN}\n{render(summary)}\n{END}{after}", encoding="utf-8")


def render(summary):
    """Return the summary as Markdown."""
    machine, attempts = summary["machine"], summary["attempts"]
    seconds = sum(attempt["seconds"] for attempt in attempts)
    lines = [
        f"{summary['shapes']:,} shapes in {summary['jobs']:,} jobs of up to {summary['shard_size']} shapes took "
        f"{seconds / 60:.0f} minutes on {machine['cores']} cores ({machine['processor']}), "
        f"{summary['date'][:10]}, commit {(summary['commit'] or 'unknown')[:10]}.",
        "",
        "Shapes: " + ", ".join(f"{count:,} {state}" for state, count in summary["states"].items()) + ".",
        "",
        "| attempt | ended by | exit code | minutes | jobs finished by then | seconds to end | processes left |",
        "|--:|:--|--:|--:|--:|--:|--:|",
        *(
            f"| {each['attempt']} | {each['ended']} | {each['exit_code']} | {each['seconds'] / 60:.1f} "
            f"| {each['jobs']:,} | {each['seconds_to_end']:.1f} | {each['survivors']} |"
            for each in attempts
        ),
        "",
        "| resident memory of | looks | median MB | largest MB | growth, MB in 1,000 shapes | bound |",
        "|:--|--:|--:|--:|--:|--:|",
        *(
            f"| {row['series']} | {row['looks']:,} | {row['median_mb']:.0f} | {row['largest_mb']:.0f} "
            f"| {_slope(row['mb_in_1000_shapes'])} | {row['bound']:g} |"
            for row in summary["memory"]
        ),
        "",
        "Every demand was met." if not summary["missed"] else "Missed: " + "; ".join(summary["missed"]) + ".",
    ]
    return "\n".join(lines)


def _slope(value):
    return "too few looks" if value is None else f"{value:.2f}"
