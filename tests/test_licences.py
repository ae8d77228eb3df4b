import re
from importlib.metadata import PathDistribution

import pytest
from conftest import REPOSITORY

from morphoskel.errors import InputError
from morphoskel.licences import NOT_STATED, licence_of, licence_page, pinned

LOCK = (REPOSITORY / "requirements.lock").read_text().splitlines()
PAGE = (REPOSITORY / "docs" / "licences.md").read_text()
ROWS = PAGE.partition("|:--|:--|:--|\n")[2]


def rows():
    return [re.match(r"\| (\S+) \| (\S+) \| (.+) \|$", line).groups() for line in ROWS.splitlines()]


def test_the_page_lists_every_pinned_package_in_its_version():
    assert [row[:2] for row in rows()] == list(pinned(LOCK).items())


def test_every_package_states_its_licence():
    assert [row for row in rows() if row[2] == NOT_STATED] == []


def test_the_page_is_what_the_command_writes():
    """A package may be installed in another version where the tests run; then there is nothing to compare with."""
    try:
        assert licence_page(LOCK) == PAGE
    except InputError as error:
        pytest.skip(str(error))


def package(folder, metadata, licence=None):
    folder = folder / "a-1.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: a\nVersion: 1\n{metadata}")
    names = ["a-1.dist-info/METADATA,,"]
    if licence:
        (folder / "LICENSE").write_text(licence)
        names.append("a-1.dist-info/LICENSE,,")
    (folder / "RECORD").write_text("\n".join(names) + "\n")
    return PathDistribution(folder)


@pytest.mark.parametrize(
    ("metadata", "licence", "expected"),
    [
        ("License-Expression: MIT AND BSD-3-Clause\nLicense: no\n", None, "MIT AND BSD-3-Clause"),
        ("Classifier: License :: OSI Approved :: MIT License\nLicense: UNKNOWN\n", None, "MIT License"),
        ("Classifier: License :: DFSG approved\nLicense: BSD\n", None, "BSD"),
        ("License: one\n        two\n", "\n# The Licence\n\ntext\n", "The Licence"),
        ("", "", NOT_STATED),
    ],
)
def test_where_a_licence_is_found(tmp_path, metadata, licence, expected):
    assert licence_of(package(tmp_path, metadata, licence)) == expected


def test_another_version_is_an_error():
    with pytest.raises(InputError, match=r"numpy: expected version 0\.1"):
        licence_page(["numpy==0.1"])
