import shutil
from pathlib import Path

import pytest

from morphoskel import provenance
from morphoskel.provenance import code_digest, content_hash


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Put a copy of the package where the digest looks for it, free to be edited."""
    copy = tmp_path / "morphoskel"
    shutil.copytree(provenance.PACKAGE_FOLDER, copy, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(provenance, "PACKAGE_FOLDER", copy)
    return copy


def digest(*modules):
    forget()
    return code_digest(*modules)


def forget():
    for cached in (
        provenance._parse,
        provenance._tree_digest,
        provenance._imports,
        provenance._facts,
        provenance._file_list,
    ):
        cached.cache_clear()


@pytest.fixture(autouse=True)
def _forget():
    yield
    provenance._memory = None
    forget()


def edit(path: Path, old: str, new: str):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def test_a_docstring_and_a_comment_change_nothing(package):
    before = digest("chain.dilation")
    edit(package / "morphology" / "dilation.py", '"""Return the largest value', '"""Give the largest value')
    edit(package / "morphology" / "dilation.py", "    from morphoskel", "    # why\n    from morphoskel")
    assert digest("chain.dilation") == before


def test_an_imported_function_changes_what_runs_it(package):
    stages = ["chain.dilation", "chain.reconstruct", "chain.watertight", "chain.select_skeleton"]
    before = {stage: digest(stage) for stage in stages}
    edit(package / "morphology" / "dilation.py", "threads=threads", "threads=1")
    changed = {stage for stage in stages if digest(stage) != before[stage]}
    assert changed == {"chain.dilation"}


def test_an_import_inside_a_function_counts(package):
    before = digest("skeletonization")
    edit(package / "surface" / "watertight.py", "LARGEST_SEED = 2**31 - 1", "LARGEST_SEED = 2**30")
    assert digest("skeletonization") != before


def test_a_module_named_in_a_registry_counts(package):
    before = digest("chain.reconstruct")
    edit(package / "datasets" / "point2skeleton.py", "def counts", "def counts_")
    assert digest("chain.reconstruct") != before


def test_the_order_of_modules_does_not_matter():
    assert code_digest("chain.udf", "chain.shard") == code_digest("chain.shard", "chain.udf")


def test_an_unknown_module_is_an_error():
    with pytest.raises(ModuleNotFoundError, match=r"morphoskel\.chain\.nothing"):
        code_digest("chain.nothing")


def test_content_hash_ignores_the_order_of_keys():
    assert content_hash({"a": 1, "b": [2, {"c": None}]}) == content_hash({"b": [2, {"c": None}], "a": 1})
    assert content_hash({"a": 1}) != content_hash({"a": 2})


def test_remembered_digests_are_the_same_and_follow_edits(package, tmp_path):
    memory = tmp_path / "cache" / "digests.json"
    fresh = digest("chain.dilation")
    provenance.remember_digests(memory)
    assert digest("chain.dilation") == fresh
    provenance.remember_digests(memory)
    assert digest("chain.dilation") == fresh
    edit(package / "morphology" / "dilation.py", "threads=threads", "threads=1")
    assert digest("chain.dilation") != fresh
    assert list(memory.parent.glob("*.partial")) == []


def test_unchanged_files_are_not_parsed_again(package, tmp_path, monkeypatch):
    provenance.remember_digests(tmp_path / "digests.json")
    fresh = digest("chain.dilation")
    provenance.remember_digests(tmp_path / "digests.json")
    forget()
    monkeypatch.setattr(provenance, "_tree_digest", None)
    assert code_digest("chain.dilation") == fresh
    monkeypatch.undo()


@pytest.mark.parametrize("content", ["{", "[]", ""])
def test_a_damaged_memory_is_made_anew(package, tmp_path, content):
    (tmp_path / "digests.json").write_text(content)
    fresh = digest("chain.dilation")
    provenance.remember_digests(tmp_path / "digests.json")
    assert digest("chain.dilation") == fresh
