import base64
import re
import shutil
from pathlib import Path

import pytest
from conftest import REPOSITORY

from morphoskel.reporting.page import assets

HOME = REPOSITORY / "src" / "morphoskel" / "reporting"


def test_an_address_holds_its_content():
    start, _, content = assets.data_uri(b"\x00caf\xc3\xa9", "text/csv").partition(",")
    assert start == "data:text/csv;base64"
    assert base64.b64decode(content) == b"\x00caf\xc3\xa9"


def test_style_and_script_cannot_end_the_element_that_holds_them_and_ask_for_nothing():
    for name in (assets.STYLE, assets.SCRIPT):
        text = assets.read_asset(name)
        assert not re.search(r"</(script|style)|<!--", text, re.IGNORECASE)
        assert not re.search(r"https?:|@import|url\(|fetch\(|import\(", text)


@pytest.mark.parametrize(
    "name", ["assets/report.css", "assets/report.js", "assets/viewer.min.js", "page/templates/page.html.jinja"]
)
def test_the_digest_changes_with_every_part_of_the_page(tmp_path, monkeypatch, name):
    for folder in ("assets", "page/templates"):
        shutil.copytree(HOME / folder, tmp_path / folder)
    monkeypatch.setattr(assets, "files", lambda _: Path(tmp_path))
    before = assets.assets_digest()
    assert re.fullmatch(r"[0-9a-f]{12}", before)
    assert assets.assets_digest() == before
    changed = tmp_path / name
    changed.write_text(changed.read_text(encoding="utf-8") + "x", encoding="utf-8")
    assert assets.assets_digest() != before
