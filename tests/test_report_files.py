import getpass
import socket
from pathlib import Path

import pytest
import yaml
from page_structure import PageStructure
from passed_on import telling, text_in
from small_run import REASON, write_small_run

from morphoskel.errors import InputError
from morphoskel.reporting import report_files
from morphoskel.reporting.report_files import write_report
from morphoskel.run_provenance import write_provenance


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return write_small_run(tmp_path_factory.mktemp("run"))


@pytest.fixture(scope="module")
def page(run):
    path = run["run_folder"] / "report" / "index.html"
    write_report(path, **run)
    return path.read_text(encoding="utf-8")


def test_all_that_there_is_of_a_run_is_on_the_page(page):
    structure = PageStructure(page)
    ids = {attributes["id"] for _, attributes in structure.found if "id" in attributes}
    assert {"table-skeleton_reconstruction", "table-object_classification", "figure-gradient"} <= ids
    for words in ("run <em>small</em>", "25 March 2025, 12:34 UTC", "1 of 3 shapes failed", "solids, test",
                  "1 min 4 s", "A gradient", "Second | note.", "root: …/data"):  # fmt: skip
        assert words in page, words


def test_equal_runs_make_equal_pages(run, page, tmp_path):
    write_report(tmp_path / "again.html", **run)
    assert (tmp_path / "again.html").read_text(encoding="utf-8") == page


def test_neither_folders_nor_user_nor_host_are_told(run, page):
    text = page[page.index("<body>") : page.index('class="morphoskel-viewer"')] + page[page.rindex("</script>") :]
    assert str(run["run_folder"].parents[1]) not in text
    assert "/home" not in text
    assert REASON.replace("/home/ada/data", "…") in text
    for name in (socket.gethostname(), getpass.getuser()):
        assert f" {name} " not in text


def test_nothing_that_is_passed_on_tells_a_secret(tmp_path, monkeypatch):
    """Absolute paths, what an address holds beside its path, and the environment; also in what the page embeds."""
    monkeypatch.setenv("MORPHOSKEL_TOKEN", "secret-of-environment")
    run = write_small_run(tmp_path)
    values = yaml.safe_load(run["config"].read_text())
    values["dataset"]["url"] = "https://ada:secret-name@example.org/a.zip?key=secret-query"
    run["config"].write_text(yaml.safe_dump(values))
    write_provenance(run["run_folder"] / "report" / "provenance.json")
    write_report(run["run_folder"] / "report" / "index.html", **run)
    page = text_in(run["run_folder"] / "report" / "index.html")
    assert "root: …/data" in page
    assert "example.org/a.zip?…" in page
    secrets = [str(tmp_path), str(Path.home()), "/home/ada", "secret"]
    for name in ("report", "tables", "figures"):
        assert telling(run["run_folder"] / name, secrets) == []


def test_a_run_without_tables_figures_and_shapes_has_a_page(run, tmp_path):
    empty = {**run, "run_folder": tmp_path / "empty", "tables": [], "figures": [], "scenes": None, "manifests": []}
    write_report(tmp_path / "index.html", **empty)
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    for words in ("no table", "no figure", "no shape to show", "nothing to compare", "No stage", "no benchmark"):
        assert words in text, words
    assert PageStructure(text).open == []


def test_a_page_that_is_too_large_is_not_written(run, tmp_path, monkeypatch):
    monkeypatch.setattr(report_files, "MOST_BYTES", 100_000)
    with pytest.raises(InputError, match="more than 100,000"):
        write_report(tmp_path / "index.html", **run)
    assert not (tmp_path / "index.html").exists()
