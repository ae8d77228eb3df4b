import re
import tomllib
from importlib.metadata import version

import yaml
from conftest import REPOSITORY

from morphoskel.lock import conda_lock, lock_lines

LOCK = (REPOSITORY / "requirements.lock").read_text().splitlines()


def pins():
    return dict(re.match(r"([A-Za-z0-9._-]+)==([^ ;]+)", line).groups() for line in LOCK if not line.startswith("#"))


def names(requirements):
    return {re.match(r"[A-Za-z0-9._-]+", line).group().lower().replace("_", "-") for line in requirements}


def test_everything_that_the_project_asks_for_is_pinned():
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]
    asked = names(project["dependencies"]) | names(project["optional-dependencies"]["dev"])
    assert asked <= names(pins())


def test_every_dependency_has_a_reason():
    text = (REPOSITORY / "pyproject.toml").read_text()
    block = text[text.index("dependencies = [") : text.index("[project.scripts]")]
    requirements = [line for line in block.splitlines() if line.strip().startswith('"')]
    assert len(requirements) > 20
    assert all("#" in line.split('",')[-1] for line in requirements)


def test_torch_is_locked_without_a_local_label():
    assert pins()["torch"] == "2.13.0"


def test_both_open3d_wheels_are_locked_for_their_platforms():
    lines = [line for line in LOCK if line.startswith("open3d")]
    assert len(lines) == 2
    assert all("platform_machine" in line for line in lines)
    assert pins()["open3d"] == pins()["open3d-cpu"]


def test_lines_follow_what_is_installed():
    assert f"numpy=={version('numpy')}" in lock_lines()


def test_conda_uses_the_same_lock():
    text = (REPOSITORY / "environment.yml").read_text()
    lines = [line for line in LOCK if not line.startswith("#")]
    assert text == conda_lock(lines)
    [pip] = [item for item in yaml.safe_load(text)["dependencies"] if isinstance(item, dict)]
    assert pip["pip"] == lines
