"""A result table as Markdown that GitHub renders."""

from collections.abc import Sequence

from morphoskel.reporting.matrix import Line, MetricMatrix

ABSENT = "–"


def render_markdown(matrices: Sequence[MetricMatrix], caption: str, footnotes: Sequence[str]) -> str:
    """Return the text of a Markdown file: the caption, one table a metric, and the footnotes as a list."""
    parts = [escape(caption)]
    for matrix in matrices:
        parts.extend((f"### {escape(matrix.heading)}", _table(matrix)))
    if footnotes:
        parts.append("\n".join(f"{number}. {escape(note)}" for number, note in enumerate(footnotes, start=1)))
    return "\n\n".join(parts) + "\n"


def escape(text: str) -> str:
    """Return `text` such that Markdown shows it as it is, on one line."""
    escaped = "".join(f"\\{character}" if character in "\\`*_[]<>#|~" else character for character in text)
    return " ".join(escaped.split())


def _table(matrix: MetricMatrix) -> str:
    """Return one metric's table."""
    rows = [_row(["Method", "", *map(escape, matrix.groups)]), _row([":--", ":--", *["--:"] * len(matrix.groups)])]
    for block in matrix.blocks:
        for position, line in enumerate(block.lines):
            rows.append(_row([escape(block.method) if position == 0 else "", line.label, *_cells(line)]))
    return "\n".join(rows)


def _cells(line: Line) -> list[str]:
    """Return the texts of a line."""
    texts = [ABSENT if text is None else text for text in line.cells]
    return [f"**{text}**" if best else text for text, best in zip(texts, line.best, strict=True)]


def _row(cells: Sequence[str]) -> str:
    """Return one row of a Markdown table."""
    return f"| {' | '.join(cells)} |"
