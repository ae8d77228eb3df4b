import json
import os
import re
import stat
import subprocess
import sys

import pytest
from coloured import SKELETON
from solids import sphere_cloud

from morphoskel.cli import main
from morphoskel.formats import write_cloud_ply, write_skeleton_ply


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_skeleton_ply(tmp_path / "a.ply", SKELETON)
    for name in "bcde":
        write_cloud_ply(tmp_path / f"{name}.ply", sphere_cloud(20))
    return tmp_path


def scenes(page):
    data = re.search(r'<script type="application/json" class="mv-data">(.*?)</script>', page.read_text(), re.DOTALL)
    return json.loads(data.group(1))["scenes"]


def test_one_page_is_written(folder, capfd):
    assert main(["view", "a.ply", "b.ply", "--no-open", "-o", "out/page.html", "--up", "z"]) == 0
    assert [(scene["name"], scene["up"]) for scene in scenes(folder / "out" / "page.html")] == [("a", "z"), ("b", "z")]
    assert "<title>a, b</title>" in (folder / "out" / "page.html").read_text()
    assert "wrote out/page.html (" in capfd.readouterr().err


def test_the_page_is_named_after_the_first_file(folder):
    assert main(["view", "--no-open", *(f"{name}.ply" for name in "abcde")]) == 0
    assert "<title>a, b, c and 2 more</title>" in (folder / "a.html").read_text()


def test_all_files_in_one_scene_under_a_title(folder):
    assert main(["view", "--no-open", "--together", "--title", "Both", "a.ply", "b.ply"]) == 0
    [scene] = scenes(folder / "a.html")
    assert [layer["name"] for layer in scene["layers"]] == ["a.ply", "a.ply, sheets", "a.ply, curves", "b.ply"]
    assert "<title>Both</title>" in (folder / "a.html").read_text()


def test_the_page_is_opened_in_the_browser(folder):
    browser = folder / "browser"
    browser.write_text(f'#!/bin/sh\necho "$1" > {folder}/opened\n')
    browser.chmod(browser.stat().st_mode | stat.S_IXUSR)
    environment = {**os.environ, "BROWSER": f"{browser} %s"}
    subprocess.run([sys.executable, "-m", "morphoskel.cli", "view", "a.ply"], env=environment, check=True)
    assert (folder / "opened").read_text().strip() == (folder / "a.html").as_uri()


def test_without_a_browser_the_reader_is_told(folder, monkeypatch, capfd):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    assert main(["view", "a.ply"]) == 0
    assert "open the page yourself" in capfd.readouterr().err
    assert (folder / "a.html").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["gone.ply"], "gone.ply: cannot be read"),
        (["a.ply", "-o", "page.pdf"], "page.pdf: the page needs the suffix .html"),
        (["."], "is a folder"),
    ],
)
def test_errors_are_one_clear_line(folder, words, message, capfd):
    before = sorted(folder.iterdir())
    assert main(["view", "--no-open", *words]) == 1
    error = capfd.readouterr().err
    assert message in error
    assert "Traceback" not in error
    assert sorted(folder.iterdir()) == before


def test_help_shows_examples(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["view", "--help"])
    assert ended.value.code == 0
    assert "examples:" in capsys.readouterr().out
