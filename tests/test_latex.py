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


def tall(methods):
    """One matrix of so many methods."""
    blocks = tuple(MethodBlock(f"M{number}", (Line("ours", ("1.0",), (False,)),)) for number in range(methods))
    return MetricMatrix(find_metric("oa"), ("8",), blocks)


def test_what_does_not_fit_on_a_page_goes_on_in_another_float():
    text = render_latex([tall(20), tall(20), tall(20)], "Title", ["First."])
    floats = text.split("\\begin{table*}[p]")[1:]
    assert [part.count("\\begin{tabular}") for part in floats] == [2, 1]
    assert all(part.rstrip().endswith("\\end{table*}") for part in floats)
    assert all("\\scriptsize" in part for part in floats)
    assert text.count("\\caption{Title}") == 1
    assert "\\item First." in floats[-1]
    assert text.count("\\toprule") == 3


def test_one_tabular_is_never_without_a_float_however_tall():
    text = render_latex([tall(200)], "Title", [])
    assert text.count("\\begin{table*}") == 1


def test_footnotes_that_do_not_fit_have_a_float_of_their_own():
    text = render_latex([tall(40)], "Title", ["word " * 400] * 3)
    assert text.count("\\begin{table*}") == 2
    assert text.index("\\bottomrule") < text.rindex("\\begin{table*}") < text.index("\\begin{enumerate}")
