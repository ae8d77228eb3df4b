import pytest

from morphoskel.datasets.archive_limits import ArchiveLimits, UnpackingBudget
from morphoskel.errors import DatasetError


@pytest.fixture
def archive(tmp_path):
    path = tmp_path / "archive"
    path.write_bytes(bytes(100))
    return path


def test_declared_and_written_bytes_are_bounded_each(archive, tmp_path):
    budget = UnpackingBudget(archive, tmp_path, ArchiveLimits(growth=3, floor=10))
    budget.announce(300)
    budget.write(200)
    budget.write(100)
    for more in (budget.announce, budget.write):
        with pytest.raises(DatasetError, match="more than 300 bytes, which is more than 3 times its size"):
            more(1)


def test_small_archives_may_grow_up_to_the_floor(archive, tmp_path):
    UnpackingBudget(archive, tmp_path, ArchiveLimits(growth=1, floor=500)).announce(500)


def test_the_room_on_the_disk(archive, tmp_path):
    budget = UnpackingBudget(archive, tmp_path, ArchiveLimits(growth=1 << 60))
    with pytest.raises(DatasetError, match="free on the disk; make room"):
        budget.announce(budget.free_bytes + 1)
