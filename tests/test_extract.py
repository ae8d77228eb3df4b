import io
import stat
import tarfile
import zipfile

import pytest

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
        ("data/link", tarfile.LNKTYPE, "../evil"),
        ("data/device", tarfile.CHRTYPE, ""),
    ],
)
def test_links_to_elsewhere_and_devices_in_a_tar(tmp_path, link):
    folder = tmp_path / "folder"
    folder.mkdir()
    write_tar(folder / "archive", FILES, [link])
    with pytest.raises(DatasetError, match="do not trust this archive"):
        extract(folder / "archive", folder / "target")
    assert [path.name for path in folder.iterdir()] == ["archive"]


def test_links_inside_a_tar(tmp_path):
    write_tar(tmp_path / "archive", FILES, [("data/link", tarfile.SYMTYPE, "sub/b.txt")])
    extract(tmp_path / "archive", tmp_path / "target")
    assert (tmp_path / "target/link").read_bytes() == b"b" * 1000


def test_links_in_a_zip(tmp_path):
    with zipfile.ZipFile(tmp_path / "archive", "w") as archive:
        member = zipfile.ZipInfo("link")
        member.external_attr = (stat.S_IFLNK | 0o777) << 16
        archive.writestr(member, "/etc/passwd")
    with pytest.raises(DatasetError, match="'link' is a link"):
        extract(tmp_path / "archive", tmp_path / "target")
    assert not (tmp_path / "target").exists()


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
