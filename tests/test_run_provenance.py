import getpass
import json
import re
import socket
import subprocess
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from morphoskel.errors import InputError
from morphoskel.run_provenance import (
    KEYS,
    collect_provenance,
    dependency_versions,
    git_state,
    read_provenance,
    write_provenance,
)


def git(folder, *words):
    names = ("-c", "user.name=A", "-c", "user.email=a@b", "-c", "commit.gpgsign=false")
    subprocess.run(["git", *names, "-C", str(folder), *words], check=True, capture_output=True)


def test_what_is_collected_is_of_now_and_here():
    values = collect_provenance()
    assert tuple(values) == KEYS
    assert abs(datetime.now(UTC) - datetime.fromisoformat(values["date"])) < timedelta(minutes=1)
    assert values["machine"]["cores"] >= 1
    assert values["machine"]["memory"] is None or values["machine"]["memory"] > 2**28
    assert json.loads(json.dumps(values)) == values


def test_neither_user_nor_host_nor_folders_are_told():
    text = json.dumps(collect_provenance())
    assert str(Path.home()) not in text
    assert str(Path.cwd()) not in text
    words = set(re.findall(r"[\w.-]+", text))
    assert not {socket.gethostname(), getpass.getuser()} & words


def test_versions_of_direct_dependencies():
    import numpy

    versions = dependency_versions()
    if versions:  # none if the package runs from its sources
        assert versions["numpy"] == numpy.__version__
        assert "pytest" not in versions


def test_commit_and_edits_of_a_clone(tmp_path):
    assert git_state(tmp_path) == (None, None)
    git(tmp_path, "init")
    (tmp_path / "sources").mkdir()
    (tmp_path / "sources" / "a.py").write_text("1\n")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-m", "first")
    commit, dirty = git_state(tmp_path / "sources")
    assert re.fullmatch("[0-9a-f]{40}", commit)
    assert dirty is False
    (tmp_path / "new.txt").write_text("unknown to Git\n")
    assert git_state(tmp_path / "sources") == (commit, False)
    (tmp_path / "sources" / "a.py").write_text("2\n")
    assert git_state(tmp_path / "sources") == (commit, True)
    (tmp_path / "installed").mkdir()  # as a package in an environment within some other clone
    (tmp_path / "installed" / "b.py").write_text("3\n")
    assert git_state(tmp_path / "installed") == (None, None)


def test_the_file_is_read_back(tmp_path):
    write_provenance(tmp_path / "results" / "provenance.json")
    values = read_provenance(tmp_path / "results" / "provenance.json")
    assert {**values, "date": ""} == {**collect_provenance(), "date": ""}


@pytest.mark.parametrize("text", ["", "[]", '{"date": ""}'])
def test_other_files_are_refused(tmp_path, text):
    (tmp_path / "provenance.json").write_text(text)
    with pytest.raises(InputError, match=r"provenance\.json: expected"):
        read_provenance(tmp_path / "provenance.json")
