"""A result table as LaTeX floats that need the package booktabs and nothing else."""

import math
import re
from collections.abc import Sequence

from morphoskel.reporting.matrix import Line, MetricMatrix

ABSENT = "--"

PAGE_HEIGHT = 70
"""Lines of a table that fit on a page below the caption."""

PAGE_WIDTH = 150
"""Characters of a footnote that fit on a line."""

BEGIN = (r"\begin{table*}[p]", r"\centering")
SMALL = (r"\scriptsize", r"\setlength{\tabcolsep}{3pt}")
END = r"\end{table*}"

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
    """Return the text of a LaTeX file: a float with the caption, one tabular a matrix, and the footnotes.

    What does not fit on its page goes on in another float without a caption, which LaTeX keeps in order.
    """
    parts = [(_tabular(matrix), _height(matrix)) for matrix in matrices]
    if footnotes:
        items = [rf"\item {escape(note)}" for note in footnotes]
        rows = sum(math.ceil(len(item) / PAGE_WIDTH) for item in items)
        parts.append(([r"\begin{enumerate}", *items, r"\end{enumerate}"], rows))
    lines = [r"% Needs \usepackage{booktabs}.", *BEGIN, rf"\caption{{{escape(caption)}}}", *SMALL]
    used = 0.0
    for part, height in parts:
        if used > 0 and used + height > PAGE_HEIGHT:
            lines.extend((END, "", *BEGIN, *SMALL))
            used = 0.0
        lines.extend(part)
        used += height
    lines.append(END)
    return "\n".join(lines) + "\n"


def escape(text: str) -> str:
    """Return `text` such that LaTeX shows it as it is, on one line."""
    return " ".join("".join(SPECIAL.get(character, character) for character in text).split())


def _height(matrix: MetricMatrix) -> float:
    """Return the height of a metric's tabular, in lines: those it has, the rules between methods, and its heading."""
    return 4 + sum(len(block.lines) + 0.5 for block in matrix.blocks)


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
