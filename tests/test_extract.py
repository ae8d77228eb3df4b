import copy
import gzip
import io
import os
import stat
import tarfile
import zipfile

import pytest

from morphoskel.datasets.archive_limits import ArchiveLimits
from morphoskel.datasets.extract import extract
from morphoskel.errors import DatasetError

FILES = {"data/a.txt": b"a" * 1000, "data/sub/b.txt": b"b" * 1000}


def write_zip(path, files):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)


def write_tar(path, files, links=()):
    with tarfile.open(path, "w:gz") as archive:
        for name, content in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
        for name, kind, goal in links:
            member = tarfile.TarInfo(name)
            member.type, member.linkname = kind, goal
            archive.addfile(member)


@pytest.fixture(params=[write_zip, write_tar], ids=["zip", "tar"])
def write(request):
    return request.param


def everything(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_only_folder_becomes_the_target(tmp_path, write):
    write(tmp_path / "archive", FILES)
    extract(tmp_path / "archive", tmp_path / "target")
    assert everything(tmp_path / "target") == {"a.txt": b"a" * 1000, "sub/b.txt": b"b" * 1000}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["archive", "target"]


def test_several_children_stay_where_they_are(tmp_path, write):
    files = {"data/a.txt": b"a", "b.txt": b"b"}
    write(tmp_path / "archive", files)
    extract(tmp_path / "archive", tmp_path / "deep" / "target")
    assert everything(tmp_path / "deep" / "target") == files


def test_a_folder_in_a_folder_of_the_same_name(tmp_path, write):
    write(tmp_path / "archive", {"data/data/a.txt": b"a", "data/.unpacked/b.txt": b"b"})
    extract(tmp_path / "archive", tmp_path / "target")
    assert everything(tmp_path / "target") == {"data/a.txt": b"a", ".unpacked/b.txt": b"b"}


def test_what_exists_is_not_replaced(tmp_path, write):
    write(tmp_path / "archive", FILES)
    (tmp_path / "target").mkdir()
    extract(tmp_path / "archive", tmp_path / "target")  # empty, so nothing is lost
    (tmp_path / "target/a.txt").write_bytes(b"mine")
    with pytest.raises(DatasetError, match="target: exists already"):
        extract(tmp_path / "archive", tmp_path / "target")
    assert (tmp_path / "target/a.txt").read_bytes() == b"mine"


@pytest.mark.parametrize(
    "name", ["../evil", "data/../../evil", "/evil", "C:/evil", "C:evil", "\\evil", "data\\..\\..\\evil"]
)
def test_members_that_leave_the_target(tmp_path, write, name):
    folder = tmp_path / "folder"
    folder.mkdir()
    write(folder / "archive", FILES | {name: b"evil"})
    with pytest.raises(DatasetError, match="outside of the target folder"):
        extract(folder / "archive", folder / "target")
    assert not (tmp_path / "evil").exists()
    assert [path.name for path in folder.iterdir()] == ["archive"]


@pytest.mark.parametrize(
    "link",
    [
        ("data/link", tarfile.SYMTYPE, "../../evil"),
        ("data/link", tarfile.SYMTYPE, "/etc/passwd"),
        ("data/link", tarfile.SYMTYPE, "sub/b.txt"),
        ("data/link", tarfile.LNKTYPE, "../evil"),
        ("data/link", tarfile.LNKTYPE, "data/a.txt"),
        ("data/device", tarfile.CHRTYPE, ""),
        ("data/device", tarfile.BLKTYPE, ""),
        ("data/queue", tarfile.FIFOTYPE, ""),
    ],
)
def test_links_and_devices_in_a_tar(tmp_path, link):
    folder = tmp_path / "folder"
    folder.mkdir()
    write_tar(folder / "archive", FILES, [link])
    with pytest.raises(DatasetError, match="a link or a device; do not trust this archive"):
        extract(folder / "archive", folder / "target")
    assert [path.name for path in folder.iterdir()] == ["archive"]


@pytest.mark.parametrize("kind", [stat.S_IFLNK, stat.S_IFCHR, stat.S_IFBLK, stat.S_IFIFO, stat.S_IFSOCK])
def test_links_and_devices_in_a_zip(tmp_path, kind):
    with zipfile.ZipFile(tmp_path / "archive", "w") as archive:
        member = zipfile.ZipInfo("link")
        member.external_attr = (kind | 0o777) << 16
        archive.writestr(member, "/etc/passwd")
    with pytest.raises(DatasetError, match="'link' is neither a file nor a folder"):
        extract(tmp_path / "archive", tmp_path / "target")
    assert not (tmp_path / "target").exists()


def test_a_file_through_a_link_of_the_same_archive(tmp_path):
    """The link is refused before anything can be written through it."""
    (tmp_path / "outside").mkdir()
    with tarfile.open(tmp_path / "archive", "w") as archive:
        link = tarfile.TarInfo("data")
        link.type, link.linkname = tarfile.SYMTYPE, str(tmp_path / "outside")
        archive.addfile(link)
        archive.addfile(tarfile.TarInfo("data/evil"), io.BytesIO())
    with pytest.raises(DatasetError, match="'data' is neither"):
        extract(tmp_path / "archive", tmp_path / "target")
    assert list((tmp_path / "outside").iterdir()) == []


def test_owners_and_permissions_are_not_taken_over(tmp_path):
    with tarfile.open(tmp_path / "archive", "w") as archive:
        member = tarfile.TarInfo("program")
        member.mode, member.uid = 0o6777, 12345
        archive.addfile(member, io.BytesIO())
    extract(tmp_path / "archive", tmp_path / "target")
    found = (tmp_path / "target/program").stat()
    assert found.st_mode & 0o7111 == 0
    assert found.st_uid == os.getuid()


@pytest.mark.parametrize(
    "names",
    [
        ("data/A.txt", "data/a.txt"),
        ("Data/a.txt", "data/b.txt"),
        ("\u00e9.txt", "e\u0301.txt"),
        ("a", "a/b"),
        ("a/b", "a"),
        ("a", "./a"),
    ],
)
def test_members_that_would_take_the_same_place(tmp_path, write, names):
    write(tmp_path / "archive", dict.fromkeys(names, b"content"))
    with pytest.raises(DatasetError, match="would take the same place"):
        extract(tmp_path / "archive", tmp_path / "target")
    assert not (tmp_path / "target").exists()


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_member_that_comes_twice(tmp_path):
    with zipfile.ZipFile(tmp_path / "archive", "w") as archive:
        for content in ("one", "two"):
            archive.writestr("a.txt", content)
    with pytest.raises(DatasetError, match="would take the same place"):
        extract(tmp_path / "archive", tmp_path / "target")


SMALL = ArchiveLimits(members=20, growth=3, floor=10_000)


def test_more_bytes_than_declared_or_allowed(tmp_path, write):
    write(tmp_path / "archive", {"zeros": bytes(3_000_000)})
    with pytest.raises(DatasetError, match="would become more than 10000 bytes"):
        extract(tmp_path / "archive", tmp_path / "target", limits=SMALL)
    assert not (tmp_path / "target").exists()
    extract(tmp_path / "archive", tmp_path / "target")


def test_the_usual_limits(tmp_path, write):
    """Seventy megabytes of zeros in seventy kilobytes."""
    write(tmp_path / "archive", {f"zeros{number}": bytes(7_000_000) for number in range(10)})
    assert (tmp_path / "archive").stat().st_size < 200_000
    with pytest.raises(DatasetError, match="would become more than 67108864 bytes"):
        extract(tmp_path / "archive", tmp_path / "target")
    assert [path.name for path in tmp_path.iterdir()] == ["archive"]


def test_a_zip_that_declares_less_than_it_holds(tmp_path):
    with zipfile.ZipFile(tmp_path / "archive", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("zeros", bytes(1_000_000))
        archive.infolist()[0].file_size = 10  # in the listing, which is written last
    with pytest.raises(DatasetError, match=r"cannot be unpacked .*CRC"):
        extract(tmp_path / "archive", tmp_path / "target", limits=SMALL)
    assert [path.name for path in tmp_path.iterdir()] == ["archive"]


def test_a_zip_that_declares_more_than_it_holds(tmp_path):
    with zipfile.ZipFile(tmp_path / "archive", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("few", b"few")
        archive.infolist()[0].file_size = 10
    with pytest.raises(DatasetError, match="cannot be unpacked"):
        extract(tmp_path / "archive", tmp_path / "target")


def test_members_of_a_zip_that_share_their_bytes(tmp_path):
    """The listing of such a bomb names the same data again and again."""
    with zipfile.ZipFile(tmp_path / "archive", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("zeros0", bytes(6_000))
        first = archive.infolist()[0]
        for number in range(1, 5):
            again = copy.copy(first)
            again.filename = again.orig_filename = f"zeros{number}"
            archive.filelist.append(again)
            archive.NameToInfo[again.filename] = again
    with pytest.raises(DatasetError, match=r"archive: (would become more than|cannot be unpacked)"):
        extract(tmp_path / "archive", tmp_path / "target", limits=SMALL)
    assert not (tmp_path / "target").exists()


def test_too_many_members(tmp_path, write):
    write(tmp_path / "archive", {f"{number}.txt": b"" for number in range(21)})
    with pytest.raises(DatasetError, match="more than 20 members"):
        extract(tmp_path / "archive", tmp_path / "target", limits=ArchiveLimits(members=20))
    write(tmp_path / "archive", {"/".join("abcdefghijklmnopqrstuvwxyz"): b""})
    with pytest.raises(DatasetError, match="more than 20 members"):
        extract(tmp_path / "archive", tmp_path / "target", limits=ArchiveLimits(members=20))


def test_the_listing_of_a_zip_is_bounded_before_it_is_read(tmp_path, monkeypatch):
    write_zip(tmp_path / "archive", {f"{number}.txt": b"" for number in range(300)})
    monkeypatch.setattr(zipfile, "ZipFile", None)
    with pytest.raises(DatasetError, match="lists too many members"):
        extract(tmp_path / "archive", tmp_path / "target", limits=SMALL)


def test_the_listing_of_a_large_zip(tmp_path, monkeypatch):
    """Beyond 65,535 members the length of the listing is in another record."""
    with zipfile.ZipFile(tmp_path / "archive", "w") as archive:
        for number in range(66_000):
            archive.filelist.append(zipfile.ZipInfo(f"{number}.txt"))
            archive.filelist[-1].header_offset = archive.filelist[-1].CRC = 0
        archive._didModify = True
    monkeypatch.setattr(zipfile, "ZipFile", None)
    with pytest.raises(DatasetError, match="lists too many members"):
        extract(tmp_path / "archive", tmp_path / "target", limits=ArchiveLimits(members=10_000))


def test_a_zip_whose_end_is_hidden_in_its_end(tmp_path):
    """The record that tells the length of the listing holds its own signature once more."""
    write_zip(tmp_path / "archive", {f"{number}.txt": b"" for number in range(300)})
    raw = bytearray((tmp_path / "archive").read_bytes())
    raw[-6:-2] = b"PK\x05\x06"
    (tmp_path / "archive").write_bytes(raw)
    with pytest.raises(DatasetError, match="lists too many members"):
        extract(tmp_path / "archive", tmp_path / "target", limits=SMALL)


def test_a_tar_whose_header_would_fill_the_memory(tmp_path):
    """The standard library reads an extended header as a whole, before the member that it describes is known."""
    header = tarfile.TarInfo("long")
    header.type, header.size = tarfile.XHDTYPE, 1 << 40
    with gzip.open(tmp_path / "archive", "wb") as stream:
        stream.write(header.tobuf() + bytes(100_000))
    with pytest.raises(DatasetError, match=r"cannot be unpacked|expected a zip"):
        extract(tmp_path / "archive", tmp_path / "target")


def test_a_sparse_tar_is_bounded_by_what_it_becomes(tmp_path):
    with tarfile.open(tmp_path / "archive", "w", format=tarfile.PAX_FORMAT) as archive:
        member = tarfile.TarInfo("sparse")
        member.pax_headers = {"GNU.sparse.map": "0,0", "GNU.sparse.size": str(1 << 40)}
        archive.addfile(member)
    with pytest.raises(DatasetError, match="would become more than"):
        extract(tmp_path / "archive", tmp_path / "target")


def test_a_tar_that_leads_back_to_its_beginning(tmp_path):
    """A negative size would send the reader to an earlier header, again and again."""
    with tarfile.open(tmp_path / "archive", "w", format=tarfile.GNU_FORMAT) as archive:
        archive.addfile(tarfile.TarInfo("first"))
    raw = bytearray((tmp_path / "archive").read_bytes())
    raw[124:136] = tarfile.itn(-1024, 12, tarfile.GNU_FORMAT)
    raw[148:156] = b"        "
    raw[148:156] = f"{sum(raw[:512]):06o}\0 ".encode()
    (tmp_path / "archive").write_bytes(raw)
    with pytest.raises(DatasetError):
        extract(tmp_path / "archive", tmp_path / "target")


@pytest.mark.parametrize("compression", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_compressions_whose_blocks_have_no_bound(tmp_path, compression):
    with zipfile.ZipFile(tmp_path / "archive", "w", compression) as archive:
        archive.writestr("zeros", bytes(1000))
    with pytest.raises(DatasetError, match="neither stored nor deflated"):
        extract(tmp_path / "archive", tmp_path / "target")


def test_a_zip_with_a_password(tmp_path):
    write_zip(tmp_path / "archive", {"a": b"a"})
    raw = bytearray((tmp_path / "archive").read_bytes())
    for at in (6, raw.index(b"PK\x01\x02") + 8):
        raw[at] |= 1
    (tmp_path / "archive").write_bytes(raw)
    with pytest.raises(DatasetError, match="password"):
        extract(tmp_path / "archive", tmp_path / "target")


def test_damaged_archives(tmp_path, write):
    archive = tmp_path / "archive"
    write(archive, FILES)
    content = archive.read_bytes()
    middle = len(content) // 2
    flipped = content[: middle - 10] + bytes(255 - byte for byte in content[middle - 10 : middle]) + content[middle:]
    for damaged in (b"", b"<html>404</html>", content[:middle], content[:-9], flipped):
        archive.write_bytes(damaged)
        with pytest.raises(DatasetError, match=r"archive: (expected|cannot be unpacked).*fetch it again"):
            extract(archive, tmp_path / "target")
        assert [path.name for path in tmp_path.iterdir()] == ["archive"]


def test_a_tar_that_ends_between_two_members(tmp_path):
    plain = io.BytesIO()
    with tarfile.open(fileobj=plain, mode="w") as archive:
        for name, content in FILES.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
    (tmp_path / "archive").write_bytes(plain.getvalue()[: 512 + 1024])
    with pytest.raises(DatasetError, match="truncated"):
        extract(tmp_path / "archive", tmp_path / "target")
    (tmp_path / "archive").write_bytes(plain.getvalue())
    extract(tmp_path / "archive", tmp_path / "target")


def test_an_absent_archive(tmp_path):
    with pytest.raises(DatasetError, match="does not exist; fetch it first"):
        extract(tmp_path / "archive", tmp_path / "target")
