import pytest
from markupsafe import Markup

from morphoskel.reporting.page.inline_markup import inline_html, plain_text


@pytest.mark.parametrize(
    ("text", "html", "plain"),
    [
        ("Plain\n  over lines.", "Plain over lines.", "Plain over lines."),
        ("*one* and **two** of ``a*b*``", "<em>one</em> and <strong>two</strong> of <code>a*b*</code>",
         "one and two of a*b*"),
        ("2 * 3 * 4, *MorphoSkel3D: a & b*", "2 * 3 * 4, <em>MorphoSkel3D: a &amp; b</em>",
         "2 * 3 * 4, MorphoSkel3D: a & b"),
        ("<script> ``<b>``", "&lt;script&gt; <code>&lt;b&gt;</code>", "<script> <b>"),
        ("", "", ""),
    ],
)  # fmt: skip
def test_markup_becomes_html_and_all_else_text(text, html, plain):
    assert inline_html(text) == html
    assert isinstance(inline_html(text), Markup)
    assert plain_text(text) == plain
