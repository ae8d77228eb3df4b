import re

from morphoskel.reporting.markdown import escape, render_markdown
from morphoskel.reporting.matrix import Line, MethodBlock, MetricMatrix
from morphoskel.reporting.metrics import find_metric

MATRICES = [
    MetricMatrix(
        find_metric("oa"),
        ("8", "a|b"),
        (
            MethodBlock(
                "X_1",
                (
                    Line("paper", ("50.0", None), (False, False)),
                    Line("ours", ("60.0", "not run"), (True, False)),
                    Line("difference", ("+10.0", None), (False, False)),
                ),
            ),
        ),
    )
]


def test_golden():
    assert render_markdown(MATRICES, "Title, 50 *", ["First.", "Second_one."]) == (
        "Title, 50 \\*\n"
        "\n"
        "### Overall accuracy (%, higher is better)\n"
        "\n"
        "| Method |  | 8 | a\\|b |\n"
        "| :-- | :-- | --: | --: |\n"
        "| X\\_1 | paper | 50.0 | – |\n"
        "|  | ours | **60.0** | not run |\n"
        "|  | difference | +10.0 | – |\n"
        "\n"
        "1. First.\n"
        "2. Second\\_one.\n"
    )


def test_every_row_has_as_many_cells_as_the_header():
    rows = [row for row in render_markdown(MATRICES, "Title", []).splitlines() if row.startswith("|")]
    assert {len(re.findall(r"(?<!\\)\|", row)) for row in rows} == {5}


def test_line_breaks_cannot_break_a_table():
    assert escape("two\nlines <b>") == "two lines \\<b\\>"
