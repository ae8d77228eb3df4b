"""Fixtures shared by the tests."""

import os
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def real_data() -> Path:
    """Return the folder with extracts of the real data sets, or skip."""
    folder = Path(os.environ.get("MORPHOSKEL_DATA", REPOSITORY.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"extracts of the real data sets are absent ({folder}); set MORPHOSKEL_DATA to run this test")
    return folder
