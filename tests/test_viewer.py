import hashlib
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from conftest import REPOSITORY

from morphoskel.errors import InputError
from morphoskel.reporting.scene import Layer, Scene
from morphoskel.reporting.viewer import viewer_html, viewer_page

ASSETS = REPOSITORY / "src" / "morphoskel" / "reporting" / "assets"
SCENES = [Scene(name, [Layer("points", "points", np.eye(3))]) for name in ("a & b", "c")]
VOID = {"meta", "link", "input", "br"}


class Structure(HTMLParser):
    """Records elements and their nesting, and the data of scripts."""

    def __init__(self, text):
        super().__init__()
        self.open, self.found, self.scripts = [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.found.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            self.scripts.append(data)


def test_a_page_is_one_well_formed_file_that_asks_for_nothing():
    page = viewer_page(SCENES, "<Title> & more")
    structure = Structure(page)
    assert structure.open == []
    assert "<title>&lt;Title&gt; &amp; more</title>" in page
    tags = [tag for tag, _ in structure.found]
    assert {tag: tags.count(tag) for tag in ("html", "title", "h1", "section", "canvas", "style", "script")} == {
        "html": 1, "title": 1, "h1": 1, "section": 1, "canvas": 1, "style": 1, "script": 2
    }  # fmt: skip
    references = [value for _, attributes in structure.found for name, value in attributes.items()
                  if name in ("src", "href")]  # fmt: skip
    assert references == ["data:,"]
    assert not re.search(r"@import|url\((?!data:)", page[: page.index("<script")])


def test_the_scenes_are_in_the_section():
    data, _ = Structure(viewer_html(SCENES)).scripts
    assert [scene["name"] for scene in json.loads(data)["scenes"]] == ["a & b", "c"]


def test_a_section_can_leave_style_and_script_to_another():
    full, bare = viewer_html(SCENES), viewer_html(SCENES, label='"x" <y>', with_assets=False)
    assert len(full) > 100_000 > len(bare)
    assert [tag for tag, _ in Structure(bare).found if tag in ("style", "script")] == ["script"]
    labels = [attributes["aria-label"] for _, attributes in Structure(bare).found if "aria-label" in attributes]
    assert labels == ['"x" <y>'] * 2


def test_the_canvas_is_reached_by_keyboard_and_says_what_it_is():
    [canvas] = [attributes for tag, attributes in Structure(viewer_html(SCENES)).found if tag == "canvas"]
    assert canvas["tabindex"] == "0"
    assert canvas["aria-label"]


@pytest.mark.parametrize(
    ("scenes", "message"),
    [([], "at least one scene"), (SCENES[:1] * 2, "scenes need names of their own, got a & b, a")],
)
def test_scenes_need_names_of_their_own(scenes, message):
    with pytest.raises(InputError, match=message):
        viewer_html(scenes)


def test_the_bundle_is_made_of_the_sources_beside_it_with_the_pinned_three():
    sources = sorted(path for path in ASSETS.glob("viewer*.js") if path.name != "viewer.min.js")
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()[:16]
    bundle = (ASSETS / "viewer.min.js").read_text(encoding="utf-8")
    [three] = re.findall(r"^THREE := (.+)$", (REPOSITORY / "Makefile").read_text(), re.MULTILINE)
    assert f"made by make viewer of sources {digest}" in bundle, "the sources changed: run `make viewer`"
    assert f"three.js {three}" in bundle
    assert "MIT License" in (ASSETS / "three.LICENSE").read_text()


def test_the_bundle_cannot_end_the_element_that_holds_it():
    bundle = (ASSETS / "viewer.min.js").read_text(encoding="utf-8").lower()
    assert "</script" not in bundle
    assert "<!--" not in bundle
