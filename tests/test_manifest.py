import hashlib
import random
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from morphoskel.datasets.manifest import (
    Entry,
    ShapeRecord,
    build_manifest,
    checksum,
    read_manifest,
    write_manifest,
)
from morphoskel.errors import DatasetError

NAMES = st.from_regex(r"[A-Za-z0-9_][A-Za-z0-9._+-]{0,8}[a-z0-9]", fullmatch=True)


@pytest.fixture
def entries(tmp_path):
    result = []
    for split, count in (("train", 5), ("test", 3)):
        for index in range(count):
            path = tmp_path / f"{split}_{index}.txt"
            path.write_text(f"content of {split} {index}")
            result.append(Entry(f"{split}_{index}", "Chair", split, path))
    return result


def test_sorted_sharded_and_pinned(entries):
    records = build_manifest(entries, shard_size=2)
    assert [record.id for record in records] == [f"test_{i}" for i in range(3)] + [f"train_{i}" for i in range(5)]
    assert [record.shard for record in records] == [0, 0, 1, 0, 0, 1, 1, 2]
    assert records[0].sha256 == hashlib.sha256(b"content of test 0").hexdigest()
    assert records[0].path == entries[5].path


def test_the_order_of_the_entries_does_not_matter(entries):
    shuffled = entries.copy()
    random.Random(1).shuffle(shuffled)
    assert shuffled != entries
    assert build_manifest(shuffled, shard_size=2) == build_manifest(entries, shard_size=2)


def test_splits_come_before_ids(entries):
    later = Entry("a", "Chair", "train", entries[0].path)
    earlier = Entry("b", "Chair", "test", entries[1].path)
    assert [record.id for record in build_manifest([later, earlier], shard_size=1)] == ["b", "a"]


def test_a_progress_bar_changes_nothing(entries, capsys, monkeypatch):
    monkeypatch.setattr("morphoskel.progress.shows_bars", lambda: True)
    assert build_manifest(entries, shard_size=2, progress=True) == build_manifest(entries, shard_size=2)
    assert "checksums" in capsys.readouterr().err


def test_companions_are_part_of_the_checksum(tmp_path, entries):
    labels = tmp_path / "labels.seg"
    labels.write_text("1 2 3")
    labelled = Entry("a", "Chair", "train", entries[0].path, (labels,))
    (record,) = build_manifest([labelled], shard_size=1)
    assert record.sha256 == hashlib.sha256(entries[0].path.read_bytes() + b"1 2 3").hexdigest()
    labels.write_text("1 2 4")
    assert build_manifest([labelled], shard_size=1)[0].sha256 != record.sha256


def test_large_files_are_streamed(tmp_path):
    path = tmp_path / "large"
    path.write_bytes(b"x" * (3 * 2**20 + 1))
    assert checksum(path) == hashlib.sha256(path.read_bytes()).hexdigest()


@given(
    st.lists(
        st.builds(
            ShapeRecord,
            id=NAMES,
            category=st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs"))),
            split=st.sampled_from(["train", "val", "test"]),
            shard=st.integers(0, 10**6),
            path=st.builds(Path, st.sampled_from(["a.ply", "/data/a, b/c.ply", 'with "quotes".ply', "ä.ply"])),
            sha256=st.from_regex(r"[0-9a-f]{64}", fullmatch=True),
        ),
        max_size=5,
    )
)
def test_round_trip(tmp_path_factory, records):
    path = tmp_path_factory.mktemp("manifest") / "manifest.csv"
    write_manifest(path, records)
    assert read_manifest(path) == records
    first = path.read_bytes()
    write_manifest(path, iter(records))
    assert path.read_bytes() == first
    assert b"\r" not in first
    assert first.startswith(b"id,category,split,shard,path,sha256\n")


def test_one_split_or_shard(tmp_path, entries):
    records = build_manifest(entries, shard_size=2)
    path = tmp_path / "sub" / "manifest.csv"
    write_manifest(path, records)
    assert read_manifest(path, split="train") == records[3:]
    assert read_manifest(path, split="train", shard=1) == records[5:7]
    assert [record.shard for record in read_manifest(path, shard=2)] == [2]
    with pytest.raises(DatasetError, match=r"no shape of split 'train', shard 3; it holds test \(shards 0 to 1\), tr"):
        read_manifest(path, split="train", shard=3)


@pytest.mark.parametrize("name", ["", "a/b", "..", ".hidden", "a b", "ä", "-rf", "a.", "x" * 201, "a\n", "b.partial"])
def test_unsafe_names(entries, name):
    with pytest.raises(DatasetError, match="unsafe as a file name"):
        build_manifest([Entry(name, "Chair", "train", entries[0].path)], shard_size=1)
    with pytest.raises(DatasetError, match="unsafe as a file name"):
        build_manifest([Entry("a", "Chair", name, entries[0].path)], shard_size=1)


def test_bad_entries(tmp_path, entries):
    with pytest.raises(DatasetError, match="holds no shape"):
        build_manifest([], shard_size=1)
    with pytest.raises(DatasetError, match="shard_size: expected at least 1"):
        build_manifest(entries, shard_size=0)
    with pytest.raises(DatasetError, match=r"id 'test_0' occurs twice: .*\(split test\) and .*\(split train\)"):
        build_manifest([*entries, Entry("test_0", "Chair", "train", entries[1].path)], shard_size=1)
    absent = Entry("a", "Chair", "train", tmp_path / "absent.ply")
    with pytest.raises(DatasetError, match=r"absent\.ply: file is missing, 1 missing in all"):
        build_manifest([*entries, absent], shard_size=1)
    no_labels = Entry("a", "Chair", "train", entries[0].path, (tmp_path / "absent.seg",))
    with pytest.raises(DatasetError, match=r"absent\.seg: file is missing"):
        build_manifest([no_labels], shard_size=1)
    with pytest.raises(DatasetError, match="cannot be read"):
        checksum(tmp_path / "absent.ply")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", r"manifest\.csv:1: expected the columns"),
        (b"id,path\n", r"manifest\.csv:1: expected the columns"),
        (b"id,category,split,shard,path,sha256\na,b,train,0,p\n", r"manifest\.csv:2: expected"),
        (b"id,category,split,shard,path,sha256\na,b,train,-1,p," + b"0" * 64 + b"\n", r"manifest\.csv:2: expected"),
        (b"id,category,split,shard,path,sha256\na,b,train,0,p,123\n", r"manifest\.csv:2: expected"),
        (b"\xff\xfe", "cannot be read as a manifest"),
    ],
)
def test_damaged_manifests(tmp_path, content, message):
    path = tmp_path / "manifest.csv"
    path.write_bytes(content)
    with pytest.raises(DatasetError, match=message):
        read_manifest(path)


def test_a_missing_manifest(tmp_path):
    with pytest.raises(DatasetError, match="build the manifest first"):
        read_manifest(tmp_path / "absent.csv")
