import contextlib
import hashlib
import shutil
import subprocess
import zipfile

import pytest

from morphoskel.checksums import LIST, checked_file, intact, intact_archive, write_checksums
from morphoskel.errors import StorageError


@pytest.fixture
def folder(tmp_path):
    shard = tmp_path / "shard"
    shard.mkdir()
    (shard / "a.npy").write_bytes(bytes(range(256)))
    (shard / "b c.ply").write_bytes(b"ply")
    write_checksums(shard)
    return shard


def turn_a_bit(path, position=-1):
    content = bytearray(path.read_bytes())
    content[position] ^= 1
    path.write_bytes(content)


def test_what_was_written_is_handed_out(folder):
    for name in ("a.npy", "b c.ply"):
        assert intact(folder / name) == folder / name


@pytest.mark.skipif(shutil.which("sha256sum") is None, reason="no sha256sum here")
def test_sha256sum_reads_the_lists(folder, tmp_path):
    with checked_file(tmp_path / "rows.csv") as partial:
        partial.write_text("id\n")
    for where, name in ((folder, LIST), (tmp_path, "rows.csv.sha256")):
        assert subprocess.run(["sha256sum", "--strict", "--check", name], cwd=where).returncode == 0


def test_a_turned_bit_a_lost_end_and_an_empty_file_are_refused(folder):
    path = folder / "a.npy"
    whole = path.read_bytes()
    for damaged in (whole[:100] + b"\0" + whole[101:], whole[:-1], b""):
        path.write_bytes(damaged)
        with pytest.raises(StorageError, match=f"{path}: is damaged .* remove {folder} and run again"):
            intact(path)
    intact(folder / "b c.ply")


def test_a_missing_or_a_foreign_file_is_refused(folder):
    (folder / "a.npy").unlink()
    (folder / "new.npy").write_bytes(b"")
    with pytest.raises(StorageError, match=r"a\.npy: cannot be read"):
        intact(folder / "a.npy")
    with pytest.raises(StorageError, match="does not know the file"):
        intact(folder / "new.npy")


@pytest.mark.parametrize("content", [b"", b"\xff\x00\n", b"a.npy\n"])
def test_a_damaged_list_vouches_for_nothing(folder, content):
    (folder / LIST).write_bytes(content)
    with pytest.raises(StorageError, match="is damaged"):
        intact(folder / "a.npy")


def test_files_that_no_job_wrote_are_taken_as_they_are(tmp_path):
    (tmp_path / "mine.csv").write_text("id\n")
    assert intact(tmp_path / "mine.csv").read_text() == "id\n"


def test_a_file_of_its_own_is_checked_by_the_sum_beside_it(tmp_path):
    path = tmp_path / "deep" / "rows.csv"
    with checked_file(path) as partial:
        partial.write_text("id,value\na,1.5\n")
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    assert path.with_name("rows.csv.sha256").read_text() == f"{digest}  rows.csv\n"
    path.write_text("id,value\na,1.6\n")
    with pytest.raises(StorageError, match=f"{path}: is damaged .* remove {path} and run again"):
        intact(path)


def test_a_failed_write_leaves_file_and_sum_as_they_were(tmp_path):
    path = tmp_path / "rows.csv"
    with checked_file(path) as partial:
        partial.write_text("old")
    with contextlib.suppress(RuntimeError), checked_file(path) as partial:
        partial.write_text("half")
        raise RuntimeError
    assert intact(path).read_text() == "old"
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["rows.csv", "rows.csv.sha256"]


def test_members_of_an_archive_are_checked(tmp_path):
    path = tmp_path / "network.pt"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("weights", bytes(1000))
    assert intact_archive(path) == path
    turn_a_bit(path, 500)
    with pytest.raises(StorageError, match=r"is damaged \(checksum of weights\)"):
        intact_archive(path)
    path.write_bytes(path.read_bytes()[:600])
    with pytest.raises(StorageError, match="is damaged"):
        intact_archive(path)
    with pytest.raises(FileNotFoundError):
        intact_archive(tmp_path / "absent.pt")
