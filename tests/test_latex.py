import pytest

from morphoskel.reporting.latex import escape, render_latex
from morphoskel.reporting.matrix import Line, MethodBlock, MetricMatrix
from morphoskel.reporting.metrics import find_metric

MATRICES = [
    MetricMatrix(
        find_metric("oa"),
        ("8", "a&b"),
        (
            MethodBlock(
                "X_1",
                (
                    Line("paper", ("50.0", None), (False, False)),
                    Line("ours", ("40.0", "not run"), (True, False)),
                    Line("difference", ("-10.0", None), (False, False)),
                ),
            ),
        ),
    )
]


def test_golden():
    assert render_latex(MATRICES, "Title, 50 %", ["First.", "Second_one."]) == (
        "% Needs \\usepackage{booktabs}.\n"
        "\\begin{table*}[p]\n"
        "\\centering\n"
        "\\caption{Title, 50 \\%}\n"
        "\\scriptsize\n"
        "\\setlength{\\tabcolsep}{3pt}\n"
        "\n"
        "\\medskip\\textbf{Overall accuracy (\\%, higher is better)}\\par\\smallskip\n"
        "\\begin{tabular}{llrr}\n"
        "\\toprule\n"
        "Method &  & 8 & a\\&b \\\\\n"
        "\\midrule\n"
        "X\\_1 & paper & 50.0 & -- \\\\\n"
        " & ours & \\textbf{40.0} & not run \\\\\n"
        " & difference & $-$10.0 & -- \\\\\n"
        "\\bottomrule\n"
        "\\end{tabular}\n"
        "\\begin{enumerate}\n"
        "\\item First.\n"
        "\\item Second\\_one.\n"
        "\\end{enumerate}\n"
        "\\end{table*}\n"
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("100 % & $x_1$ #{}", r"100 \% \& \$x\_1\$ \#\{\}"),
        ("~^\\", r"\textasciitilde{}\textasciicircum{}\textbackslash{}"),
        ("a < b | c ≥ d – e", r"a \textless{} b \textbar{} c $\geq$ d -- e"),
        ("two\n\nparagraphs", "two paragraphs"),
    ],
)
def test_special_characters(text, expected):
    assert escape(text) == expected


def test_numbers_inside_a_cell_have_minus_signs_too():
    line = Line("ours", ("0.4 (-0.2 to 1.0)", "-1.0 ± 2.0"), (False, True))
    text = render_latex([MetricMatrix(find_metric("oa"), ("8", "16"), (MethodBlock("A", (line,)),))], "Title", [])
    assert r"A & ours & 0.4 ($-$0.2 to 1.0) & \textbf{$-$1.0 $\pm$ 2.0} \\" in text


def test_without_footnotes_there_is_no_empty_list():
    assert "enumerate" not in render_latex(MATRICES, "Title", [])
