"""A result table as a LaTeX float that needs the package booktabs and nothing else."""

import re
from collections.abc import Sequence

from morphoskel.reporting.matrix import Line, MetricMatrix

ABSENT = "--"

SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    **{character: f"\\{character}" for character in "&%$#_{}"},
    "–": "--",
    "—": "---",
    "−": "$-$",
    "×": r"$\times$",
    "±": r"$\pm$",
    "≤": r"$\leq$",
    "≥": r"$\geq$",
    "→": r"$\to$",
}
"""Characters that LaTeX reads as commands, or lacks in its default encoding, and what shows them as they are."""


def render_latex(matrices: Sequence[MetricMatrix], caption: str, footnotes: Sequence[str]) -> str:
    """Return the text of a LaTeX file: one float with the caption, one tabular a metric, and the footnotes."""
    lines = [
        r"% Needs \usepackage{booktabs}.",
        r"\begin{table*}[p]",
        r"\centering",
        rf"\caption{{{escape(caption)}}}",
        r"\scriptsize",
        r"\setlength{\tabcolsep}{3pt}",
    ]
    for matrix in matrices:
        lines.extend(_tabular(matrix))
    if footnotes:
        lines.append(r"\begin{enumerate}")
        lines.extend(rf"\item {escape(note)}" for note in footnotes)
        lines.append(r"\end{enumerate}")
    lines.append(r"\end{table*}")
    return "\n".join(lines) + "\n"


def escape(text: str) -> str:
    """Return `text` such that LaTeX shows it as it is, on one line."""
    return " ".join("".join(SPECIAL.get(character, character) for character in text).split())


def _tabular(matrix: MetricMatrix) -> list[str]:
    """Return the lines of one metric's tabular."""
    columns = len(matrix.groups)
    lines = [
        "",
        rf"\medskip\textbf{{{escape(matrix.heading)}}}\par\smallskip",
        rf"\begin{{tabular}}{{ll{'r' * columns}}}",
        r"\toprule",
        _row(["Method", "", *map(escape, matrix.groups)]),
    ]
    for block in matrix.blocks:
        lines.append(r"\midrule")
        for position, line in enumerate(block.lines):
            lines.append(_row([escape(block.method) if position == 0 else "", line.label, *_cells(line)]))
    return [*lines, r"\bottomrule", r"\end{tabular}"]


def _cells(line: Line) -> list[str]:
    """Return the texts of a line, with minus signs rather than hyphens."""
    texts = [ABSENT if text is None else re.sub(r"-(?=\d)", "$-$", escape(text)) for text in line.cells]
    return [rf"\textbf{{{text}}}" if best else text for text, best in zip(texts, line.best, strict=True)]


def _row(cells: Sequence[str]) -> str:
    """Return one row of a tabular."""
    return f"{' & '.join(cells)} \\\\"
