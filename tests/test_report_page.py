import re
from itertools import pairwise

import pytest
from page_structure import PageStructure
from small_run import PROVENANCE, result_frame
from test_viewer import SCENES

from morphoskel.reporting.page.configuration import Configuration
from morphoskel.reporting.page.data_checksums import DataSplit
from morphoskel.reporting.page.embedded_figures import EmbeddedFigure, FigureSource
from morphoskel.reporting.page.failures import FailureGroup, Failures
from morphoskel.reporting.page.report_page import SECTIONS, ReportContent, render_report
from morphoskel.reporting.page.reported_tables import read_reported_table
from morphoskel.reporting.page.stage_times import StageTime
from morphoskel.reporting.table import write_table


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tables")
    write_table(result_frame(), folder / "prior", "A <caption> & more.", ["A <note>."])
    return ReportContent(
        run="<run>",
        tables=[read_reported_table(folder / "prior.csv")],
        figures=[EmbeddedFigure(FigureSource("one", "A & b", "*Seen*.", folder), "data:image/webp;base64,AA", 30, 20)],
        scenes=SCENES,
        configuration=Configuration({"seed": 7}, "seed: 7\nkey: <value>\n"),
        provenance=PROVENANCE,
        splits=[DataSplit("solids", "test", 1234, 2, "ab" * 32), DataSplit("solids", "train", 1, 1, "cd" * 32)],
        failures=Failures(9, 4, 1, (FailureGroup("udf", "x < 3", ("poisson",), 4, ("a", "b", "c")),)),
        times=[StageTime("udf", 1200, 60.0, 20.0, 40.0, 1234.5), StageTime("dpc", 1, 15.0, 15.0, float("nan"), 10.0)],
    )


@pytest.fixture(scope="module")
def page(content):
    return render_report(content)


@pytest.fixture(scope="module")
def elements(page):
    structure = PageStructure(page)
    assert structure.open == []
    return structure.found


def of(elements, wanted):
    return [attributes for tag, attributes in elements if tag == wanted]


def test_the_page_is_well_formed_and_asks_for_nothing(page, elements):
    addresses = [value for _, attributes in elements for name, value in attributes.items() if name in ("src", "href")]
    assert addresses
    assert all(address.startswith(("data:", "#")) for address in addresses)
    [policy] = [meta["content"] for meta in of(elements, "meta") if "http-equiv" in meta]
    assert "default-src 'none'" in policy
    assert not re.search(r"@import|url\((?!data:)", page[: page.index("morphoskel-viewer")])


def test_every_address_within_the_page_leads_somewhere_and_ids_are_unique(elements):
    ids = [attributes["id"] for _, attributes in elements if "id" in attributes]
    assert len(set(ids)) == len(ids)
    inside = [link["href"][1:] for link in of(elements, "a") if link["href"].startswith("#")]
    labels = [word for _, attributes in elements for word in attributes.get("aria-labelledby", "").split()]
    assert set(inside) | set(labels) <= set(ids)
    assert set(SECTIONS) <= set(inside)


def test_landmarks_and_headings_are_in_order(elements):
    tags = [tag for tag, _ in elements]
    assert [tags.count(tag) for tag in ("h1", "main", "header", "nav", "footer")] == [1, 1, 1, 1, 1]
    levels = [int(tag[1]) for tag in tags if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))
    headings = [attributes["id"] for tag, attributes in elements if tag == "h2"]
    assert headings == ["result", *SECTIONS]


def test_every_table_has_a_caption_and_every_picture_says_what_it_shows(elements):
    tags = [tag for tag, _ in elements]
    assert tags.count("table") == tags.count("caption") == 3 + 5
    [picture] = of(elements, "img")
    assert picture["alt"] == "A & b: Seen."
    assert (picture["width"], picture["height"], picture["loading"]) == ("30", "20", "lazy")
    assert all("scope" in header for header in of(elements, "th"))


def test_text_is_escaped_everywhere(page):
    for words in ("<run>", "<caption> &", "<note>", "<value>", "x < 3"):
        assert words not in page
    for words in ("&lt;run&gt;", "A &lt;caption&gt; &amp; more.", "A &lt;note&gt;.", "key: &lt;value&gt;", "x &lt; 3"):
        assert words in page


def test_numbers_of_shapes_failures_and_times(page):
    for words in ("solids (1,235 shapes)", "4 of 9 shapes", "a, b, c, …", "1 min 15 s", "width: 25.0%", "1,234 MB",
                  "20 %", "1,201"):  # fmt: skip
        assert words in page, words


def test_equal_contents_make_equal_pages(content, page):
    assert render_report(content) == page
