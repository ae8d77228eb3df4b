"""The report in a headless Chromium with WebGL in software."""

import csv
import re

import numpy as np
import pytest
from browser import SOFTWARE_WEBGL, Browser, find_browser
from report_of_size import large_page, small_page
from test_viewer_in_browser import CANVAS, differing

from morphoskel.reporting.metrics import METRICS
from morphoskel.reporting.report_files import MOST_BYTES

pytestmark = pytest.mark.skipif(
    find_browser() is None,
    reason="chromium or chromedriver is absent; apt-get install --no-install-recommends chromium chromium-driver",
)

SECONDS = 3.0
"""In which a page of any size opens."""

READ_TABLES = """
const cells = [];
for (const section of document.querySelectorAll(".result-table"))
  for (const table of section.querySelectorAll("table.values")) {
    const groups = [...table.tHead.rows[0].cells].slice(2).map((cell) => cell.textContent);
    for (const body of table.tBodies)
      for (const row of body.rows) {
        const values = [...row.cells].slice(-groups.length);
        values.forEach((cell, column) => cells.push([
          section.querySelector("h3").id.slice(6), table.dataset.metric, body.rows[0].cells[0].textContent,
          row.cells[row.cells.length - groups.length - 1].textContent, groups[column],
          cell.querySelector("strong")?.textContent ?? cell.textContent, Boolean(cell.querySelector("strong")),
        ]));
      }
  }
return cells;
"""

SCROLLED = """
const table = document.querySelectorAll("#table-surface_reconstruction ~ details table")[1];
const box = table.parentNode;
const [method, , , , value] = table.tBodies[0].rows[0].cells;
const left = (element) => element.getBoundingClientRect().left;
const before = [left(method), left(value)];
box.scrollLeft = 60;
return [box.scrollWidth > box.clientWidth, box.scrollLeft, left(method) - before[0], left(value) - before[1]];
"""

CONTROLS = """
const labelled = (each) => document.getElementById(each.getAttribute("aria-labelledby"))?.textContent;
const name = (each) => each.ariaLabel || each.textContent.trim() || each.labels?.[0]?.textContent.trim() ||
  labelled(each) || each.querySelector("img")?.alt || each.outerHTML.slice(0, 200);
const controls = [...document.querySelectorAll("a, button, summary, select, input, [tabindex='0']")];
return controls.filter((each) => each.checkVisibility()).map(name);
"""

CONTRASTS = """
const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
const channels = (colour) => {
  canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);
  return [...canvas.getImageData(0, 0, 1, 1).data];
};
const light = (rgb) => {
  const [r, g, b] = rgb.map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const behind = (element) => {
  for (let each = element; each; each = each.parentElement) {
    const colour = channels(getComputedStyle(each).backgroundColor);
    if (colour[3] === 255) return colour.slice(0, 3);
  }
  return [255, 255, 255];
};
const found = [];
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walker.nextNode()) {
  const element = walker.currentNode.parentElement;
  if (!walker.currentNode.textContent.trim() || !element.checkVisibility()) continue;
  if (element.closest(".unseen, script")) continue;
  const pair = [light(channels(getComputedStyle(element).color).slice(0, 3)), light(behind(element))];
  found.push([(Math.max(...pair) + 0.05) / (Math.min(...pair) + 0.05), walker.currentNode.textContent.trim()]);
}
return found;
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return small_page(tmp_path_factory.mktemp("report"))


@pytest.fixture(scope="module")
def browser():
    with Browser(*SOFTWARE_WEBGL) as browser:
        yield browser


@pytest.fixture
def report(browser, page):
    browser.complaints()
    browser.open(page)
    browser.run("localStorage.clear()")
    yield browser
    assert browser.complaints() == []


def order(report, selector="table.values"):
    """Return the methods, or rules, of the first table in the order of its rows."""
    return report.run(f"""const bodies = [...document.querySelector('{selector}').tBodies];
        const rows = bodies.length > 1 ? bodies.map((body) => body.rows[0]) : [...bodies[0].rows];
        return rows.map((row) => row.cells[0].textContent)""")


def press(report, selector, index):
    report.run("document.querySelectorAll(arguments[0])[arguments[1]].click()", selector, index)
    report.rest()


def test_nothing_is_asked_of_the_network_and_nothing_complained_of(report):
    names = report.run("return performance.getEntriesByType('resource').map((entry) => entry.name)")
    assert [name for name in names if not name.startswith("data:")] == []
    assert report.run("return document.title") == "MorphoSkel report of the run browser"


def test_the_shapes_are_drawn_and_turn(report):
    report.run("document.querySelector('.morphoskel-viewer').scrollIntoView({ behavior: 'instant', block: 'center' })")
    start = report.picture(CANVAS)
    assert differing(start, np.broadcast_to(start[9, 9], start.shape)) > 0.05
    report.drag(CANVAS, 120, 40)
    assert differing(start, report.picture(CANVAS)) > 0.02


def shown(value, metric):
    """Return a number as a table shows it, the naive way."""
    text = f"{value:.{METRICS[metric].decimals}f}"
    return text.lstrip("-") if float(text) == 0 else text.replace("-", "−")


def test_tables_match_their_files_cell_by_cell(report, page):
    found = {tuple(cell[:5]): tuple(cell[5:]) for cell in report.run(READ_TABLES)}
    expected = {}
    for table in ("skeleton_reconstruction", "surface_reconstruction"):
        with (page.parent / f"{table}.csv").open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        behind = {(row["method"], row["group"]): row for row in rows if row["metric"] == "oa_interval"}
        for row in rows:
            metric, key = row["metric"], (row["method"], row["group"])
            if METRICS[metric].part_of:
                continue
            ours = row["value"]
            if ours not in ("not run", "failed"):
                ours = shown(float(ours), metric)
                if metric == "oa" and key in behind:
                    ours += f" ± {float(behind[key]['value']):.1f}"
            lines = {"ours": ours}
            if row["paper"]:
                lines["paper"] = shown(float(row["paper"]), metric)
            if row["paper"] and row["value"] not in ("not run", "failed"):
                difference = shown(float(row["value"]) - float(row["paper"]), metric)
                lines["difference"] = difference if difference[0] == "−" or float(difference) == 0 else f"+{difference}"
            expected |= {(table, metric, row["method"], line, row["group"]): text for line, text in lines.items()}
    assert len(expected) > 500
    assert {key: text for key, (text, _) in found.items() if text != "–"} == expected
    best = {key[2:] for key, (_, is_best) in found.items() if is_best and key[:2] == ("skeleton_reconstruction", "oa")}
    assert best == {("MS3D", "ours", "8")}
    cells = report.run("return [...document.querySelectorAll('td')].map((cell) => [cell.className, cell.textContent])")
    assert {text for kind, text in cells if kind in ("not-run", "failed")} == {"not run", "failed"}


def test_a_table_is_sorted_by_our_values_with_the_lines_of_a_method_together(report):
    first = order(report)
    assert first == ["L1", "MS3D", "DPC"]
    press(report, "table.values .sort", 1)  # by the values of chairs, which L1 lacks
    assert order(report) == ["MS3D", "DPC", "L1"]
    header = "return document.querySelector('table.values thead').rows[0].cells[2].getAttribute('aria-sort')"
    assert report.run(header) == "ascending"
    press(report, "table.values .sort", 1)
    assert order(report) == ["DPC", "MS3D", "L1"]
    assert report.run(header) == "descending"
    press(report, "table.values .sort", 0)
    assert order(report) == ["DPC", "L1", "MS3D"]
    assert report.run(header) is None
    press(report, "table.values .sort", 0)
    press(report, "table.values .sort", 0)
    assert order(report) == first
    lines = "return [...document.querySelector('table.values').tBodies].map((body) => body.rows.length)"
    assert report.run(lines) == [2, 3, 1]


def test_times_are_sorted_as_numbers_and_their_sum_stays_below(report):
    times = "table:has(#rule-times)"
    assert order(report, times) == ["train", "udf", "dpc"]
    press(report, f"{times} .sort", 1)
    assert order(report, times) == ["train", "dpc", "udf"]
    assert report.run(f"return document.querySelector('{times}').lastElementChild.tagName") == "TFOOT"


def test_a_picture_is_enlarged_and_put_back(report):
    assert report.run("return document.querySelector('figure img').alt") == "Figure one: A caption of one."
    report.type(".enlarge", "\ue007")  # Enter
    assert report.run("return document.querySelector('dialog').open")
    assert report.run("return document.querySelector('dialog img').src === document.querySelector('figure img').src")
    before = report.run("return document.querySelector('dialog img').getBoundingClientRect().width")
    press(report, "dialog .page-button", 0)
    assert report.run("return document.querySelector('dialog img').getBoundingClientRect().width") != before
    report.type("dialog .page-button", "\ue00c")  # Escape
    assert not report.run("return document.querySelector('dialog').open")
    assert report.run("return document.activeElement.className") == "enlarge"


def test_tables_are_opened_and_closed_together(report):
    opened = "return [...document.querySelectorAll('.result-table details')].filter((each) => each.open).length"
    every = report.run("return document.querySelectorAll('.result-table details').length")
    button = "#tables ~ .page-button"
    assert 0 < report.run(opened) < every
    report.click(button)
    assert report.run(opened) == every
    report.click(button)
    assert report.run(opened) == 0


def test_light_and_dark_follow_the_preference_and_then_the_reader(report, page):
    paper = "return getComputedStyle(document.body).backgroundColor"
    switch = "header .page-button"
    light = report.run(paper)
    report.click(switch)
    dark = report.run(paper)
    assert dark != light
    assert report.run("return document.querySelector('header .page-button').ariaPressed") == "true"
    report.open(page)  # the choice is kept
    assert report.run(paper) == dark
    report.click(switch)
    assert report.run(paper) == light
    report.open(page, dark=True)
    assert report.run(paper) == dark
    report.click(switch)
    assert report.run(paper) == light
    assert report.run("return document.documentElement.dataset.theme") == "light"


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_all_text_stands_out_from_what_is_behind_it(report, page, dark):
    report.open(page, dark=dark)
    report.run("document.querySelectorAll('details').forEach((details) => (details.open = true))")
    contrasts = report.run(CONTRASTS)
    assert len(contrasts) > 500
    assert [pair for pair in contrasts if pair[0] < 4.5] == []


@pytest.mark.parametrize("width", [1280, 390, 320])
def test_only_tables_scroll_sideways_and_their_first_column_stays(report, page, width):
    report.open(page, width, 844)
    report.run("document.querySelectorAll('details').forEach((details) => (details.open = true))")
    report.rest()
    assert report.run("return document.documentElement.scrollWidth") <= width
    places = report.run(SCROLLED)
    wide, scrolled, method, value = places
    assert wide or width == 1280
    assert method == 0
    assert value == -scrolled


def test_every_control_is_reached_by_keyboard_and_says_its_name(report):
    names = report.run(CONTROLS)
    assert len(names) > 50
    assert [name for name in names if name.startswith("<")] == []
    report.type("body", "\ue004")  # Tab
    assert report.run("return document.activeElement.textContent") == "Skip to the results"
    assert report.run("return document.activeElement.getBoundingClientRect().top") >= 0
    outline = report.run("return getComputedStyle(document.activeElement).outlineStyle")
    assert outline == "solid"


def test_without_a_script_there_are_the_tables_and_no_control_that_does_nothing(browser, page, tmp_path):
    text = re.sub(r"<script>.*?</script>", "", page.read_text(encoding="utf-8"), count=1, flags=re.DOTALL)
    bare = tmp_path / "bare.html"
    bare.write_text(text, encoding="utf-8")
    browser.open(bare)
    assert browser.run("return document.querySelectorAll('.page-button, .sort, .enlarge, dialog').length") == 0
    assert len(browser.run(READ_TABLES)) > 500
    assert browser.complaints() == []


def test_a_page_as_large_as_the_bounds_let_it_be_opens_fast(browser, tmp_path):
    path = large_page(tmp_path)
    assert 4_000_000 < path.stat().st_size < MOST_BYTES
    # Processor time, so that other work on the machine does not count.
    browser.command("Performance.enable", timeDomain="threadTicks")
    browser.open(path)
    metrics = {metric["name"]: metric["value"] for metric in browser.command("Performance.getMetrics")["metrics"]}
    browser.command("Performance.disable")
    assert 0.05 < metrics["TaskDuration"] < SECONDS
    assert browser.run("return document.querySelector('.morphoskel-viewer').dataset.state") == "ready"
    assert browser.complaints() == []
