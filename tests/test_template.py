import jinja2
import pytest

from morphoskel.reporting.page.template import duration_text, fill_template, size_text


def test_a_gap_without_a_value_is_an_error():
    with pytest.raises(jinja2.UndefinedError, match="viewer"):
        fill_template("shapes.html.jinja", sections={"shapes": "Shapes"})


def test_values_are_escaped():
    page = fill_template("shapes.html.jinja", sections={"shapes": "<i> & co"}, viewer=None)
    assert '<h2 id="shapes">&lt;i&gt; &amp; co</h2>' in page


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0, "0.0 s"), (9.94, "9.9 s"), (9.96, "10 s"), (59.4, "59 s"), (59.6, "1 min 0 s"), (200, "3 min 20 s"),
     (3599.6, "1 h 0 min"), (7530, "2 h 6 min"), (4_000_000, "1,111 h 7 min")],
)  # fmt: skip
def test_durations_to_two_units(seconds, text):
    assert duration_text(seconds) == text


@pytest.mark.parametrize(
    ("count", "text"), [(812, "812 bytes"), (19_400, "19 kB"), (999_499, "999 kB"), (3_440_000, "3.4 MB")]
)
def test_sizes(count, text):
    assert size_text(count) == text
