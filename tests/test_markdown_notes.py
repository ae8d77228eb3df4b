import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.reporting.markdown import render_markdown
from morphoskel.reporting.matrix import metric_matrices
from morphoskel.reporting.page.markdown_notes import read_markdown_notes
from morphoskel.reporting.table import MEASURED_COLUMNS, assemble

LINE = st.text(st.characters(codec="utf-8", categories=["L", "N", "P", "S", "Zs"]), min_size=1).map(
    lambda text: " ".join(text.split())
).filter(bool)  # fmt: skip


def matrices():
    measured = pd.DataFrame([("1. A", "8", "oa", 5.0, 0.0, 1, 0)], columns=list(MEASURED_COLUMNS))
    published = pd.DataFrame(columns=["method", "group", "metric", "value"])
    return metric_matrices(assemble(measured, published, dataset="d", seeds=[], protocol="correct"))


MATRICES = matrices()


@settings(deadline=None)
@given(LINE, st.lists(LINE, max_size=3))
def test_what_was_written_is_read_back(caption, footnotes):
    for tables in (MATRICES, []):
        assert read_markdown_notes(render_markdown(tables, caption, footnotes)) == (caption, tuple(footnotes))


@pytest.mark.parametrize(("text", "caption"), [("", ""), ("Only.\n", "Only."), ("A.\n\n| 1. |\n", "A.")])
def test_without_footnotes(text, caption):
    assert read_markdown_notes(text) == (caption, ())
