from pathlib import Path

import pytest

from morphoskel.config import compose
from morphoskel.config.workflow_path import check_clone_path, check_workflow_path
from morphoskel.errors import ConfigError


@pytest.mark.parametrize("name", ["two words", "it's", "$(touch evil)", "*?[a]", "Möbel, 椅子", "-rf", "%s", "~"])
def test_most_names_are_legal(name):
    assert check_workflow_path(Path(name)) == Path(name)
    check_clone_path(Path("/home") / name)


@pytest.mark.parametrize("name", ["{split}", "a{", "}", "<results>", "line\nbreak"])
def test_what_snakemake_replaces_is_refused(name):
    for check in (check_workflow_path, check_clone_path):
        with pytest.raises(ValueError, match="Snakemake cannot handle the character"):
            check(Path(name))


def test_the_error_names_the_key():
    with pytest.raises(ConfigError, match=r"dataset\.root: Snakemake cannot handle the character '\{'"):
        compose(["dataset=folder", "dataset.root='my {split}'"])


def test_a_clone_under_a_colon():
    assert check_workflow_path(Path("a:b")) == Path("a:b")
    with pytest.raises(ConfigError, match=r"/home/a:b: .* make a clone elsewhere"):
        check_clone_path(Path("/home/a:b"))
