"""Result tables as the page shows them, from the files of a run."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.reporting.matrix import FAILED, NOT_RUN, Line, MetricMatrix, metric_matrices
from morphoskel.reporting.metrics import METRICS
from morphoskel.reporting.page.assets import data_uri
from morphoskel.reporting.page.markdown_notes import read_markdown_notes
from morphoskel.reporting.table import read_table

if TYPE_CHECKING:
    import pandas as pd


ABSENT = "–"
"""What stands where there is nothing to show."""


@dataclass(frozen=True)
class ShownCell:
    """A cell as the page shows it.

    Parameters
    ----------
    text
        With minus signs rather than hyphens.
    kind
        ``best``, ``not-run``, ``failed``, ``absent``, or empty for any other value.
    """

    text: str
    kind: str


@dataclass(frozen=True, eq=False)
class ReportedTable:
    """A result table.

    Parameters
    ----------
    name
        Of its files.
    caption, footnotes
        Plain text.
    frame
        As returned by :func:`morphoskel.reporting.table.read_table`.
    matrices
        Its layout.
    csv
        The file that readers can take away.
    """

    name: str
    caption: str
    footnotes: tuple[str, ...]
    frame: pd.DataFrame
    matrices: tuple[MetricMatrix, ...]
    csv: bytes

    @property
    def title(self) -> str:
        """Its name for readers."""
        return self.name.replace("_", " ").capitalize()

    @property
    def address(self) -> str:
        """Address that holds the CSV file."""
        return data_uri(self.csv, "text/csv;charset=utf-8")

    @property
    def counts(self) -> dict[str, int]:
        """Number of cells that were computed, that failed, and that were not run."""
        cells = self.frame[[not METRICS[metric].part_of for metric in self.frame["metric"]]]
        computed = cells["value"].notna()
        tried = cells["n"] + cells["n_failed"] > 0
        return {
            "computed": int(computed.sum()),
            "failed": int((tried & ~computed).sum()),
            "not run": int((~tried & ~computed).sum()),
        }


def shown_cells(line: Line) -> list[ShownCell]:
    """Return the cells of a line of a method."""
    return [_shown(text, best) for text, best in zip(line.cells, line.best, strict=True)]


def read_reported_table(path: Path) -> ReportedTable:
    """Read a table from its CSV file, and its caption and footnotes from the Markdown file beside that.

    Parameters
    ----------
    path
        The CSV file that :func:`morphoskel.reporting.table.write_table` wrote.

    Raises
    ------
    InputError
        If one of the files is absent, or the CSV file is no result table.
    """
    frame = read_table(path)
    notes = path.with_suffix(".md")
    if not notes.is_file():
        raise InputError(f"{notes}: no such file; expected the Markdown file beside {path.name}. Make the table again")
    caption, footnotes = read_markdown_notes(notes.read_text(encoding="utf-8"))
    return ReportedTable(path.stem, caption, footnotes, frame, tuple(metric_matrices(frame)), path.read_bytes())


def _shown(text: str | None, best: bool) -> ShownCell:
    if text is None:
        return ShownCell(ABSENT, "absent")
    kind = {NOT_RUN: "not-run", FAILED: "failed"}.get(text, "best" if best else "")
    return ShownCell(re.sub(r"-(?=\d)", "−", text), kind)
