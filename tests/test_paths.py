from pathlib import Path

from morphoskel.reporting.paths import as_paths


def test_every_string_in_lists_and_mappings_becomes_a_path():
    files = {"one": "a/b.csv", "many": ["c", ["d"]], "named": {"x": "e"}, "none": None, "empty": []}
    assert as_paths(files) == {
        "one": Path("a/b.csv"),
        "many": [Path("c"), [Path("d")]],
        "named": {"x": Path("e")},
        "none": None,
        "empty": [],
    }
