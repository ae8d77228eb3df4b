"""The page itself: all sections of a report, as one HTML file that needs nothing from the network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from morphoskel.reporting.page.assets import SCRIPT, STYLE, read_asset
from morphoskel.reporting.page.configuration import Configuration
from morphoskel.reporting.page.data_checksums import DataSplit
from morphoskel.reporting.page.embedded_figures import EmbeddedFigure
from morphoskel.reporting.page.failures import Failures
from morphoskel.reporting.page.inline_markup import inline_html, plain_text
from morphoskel.reporting.page.provenance_rows import commit_text, date_text, provenance_rows
from morphoskel.reporting.page.reported_tables import ReportedTable, shown_cells
from morphoskel.reporting.page.stage_times import StageTime
from morphoskel.reporting.page.summary import summarise
from morphoskel.reporting.page.template import fill_template
from morphoskel.reporting.scene import Scene
from morphoskel.reporting.viewer import viewer_html

SHAPES_LABEL = "Shapes of the run in 3D"

SECTIONS = {
    "tables": "Tables",
    "figures": "Figures",
    "shapes": "Shapes in 3D",
    "configuration": "Configuration",
    "provenance": "Provenance",
    "failures": "Failures",
    "time": "Time",
}
"""Address and heading of each section, in order."""


@dataclass(frozen=True, eq=False)
class ReportContent:
    """What a report shows.

    Parameters
    ----------
    run
        Name of the run.
    tables, figures, scenes
        In the order of the page; each may be empty.
    configuration, splits, failures, times
        How the run was set up and how it fared.
    provenance
        As :func:`morphoskel.run_provenance.read_provenance` returns it.
    """

    run: str
    tables: Sequence[ReportedTable]
    figures: Sequence[EmbeddedFigure]
    scenes: Sequence[Scene]
    configuration: Configuration
    provenance: Mapping[str, Any]
    splits: Sequence[DataSplit]
    failures: Failures
    times: Sequence[StageTime]


def render_report(content: ReportContent) -> str:
    """Return the report as HTML. Equal contents give equal text."""
    # Markup tells the template that these are HTML already; all else is escaped.
    viewer = Markup(viewer_html(content.scenes, label=SHAPES_LABEL)) if content.scenes else None
    return fill_template(
        "page.html.jinja",
        content=content,
        sections=SECTIONS,
        style=Markup(read_asset(STYLE)),
        script=Markup(read_asset(SCRIPT)),
        viewer=viewer,
        facts=_facts(content),
        summary=summarise({table.name: table.frame for table in content.tables}),
        provenance_rows=provenance_rows(content.provenance, content.configuration),
        seconds=sum(time.seconds for time in content.times),
        shown_cells=shown_cells,
        inline_html=inline_html,
        plain_text=plain_text,
    )


def _facts(content: ReportContent) -> list[tuple[str, str]]:
    """Return what a reader wants to know first: name and value."""
    shapes = {split.dataset: 0 for split in content.splits}
    for split in content.splits:
        shapes[split.dataset] += split.shapes
    failures = content.failures
    return [
        ("Run", content.run),
        ("Date", date_text(content.provenance["date"])),
        ("Data", ", ".join(f"{name} ({count:,} shapes)" for name, count in shapes.items()) or "none"),
        ("Seed", str(content.configuration.find("seed"))),
        ("Commit", commit_text(content.provenance, 10)),
        ("Failures", f"{failures.failed:,} of {failures.shapes:,} shapes"),
    ]
