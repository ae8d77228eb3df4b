import hashlib
import subprocess
from pathlib import Path

from morphoskel.datasets.manifest import ShapeRecord, write_manifest
from morphoskel.reporting.page.data_checksums import DataSplit, describe_manifest

RECORDS = [
    ShapeRecord(name, category, split, 0, Path(f"{name}.ply"), hashlib.sha256(name.encode()).hexdigest())
    for name, category, split in (("a", "Chair", "test"), ("b", "Mug", "test"), ("c", "Mug", "train"))
]


def test_splits_with_numbers_and_a_checksum_that_the_shell_gives_too(tmp_path):
    write_manifest(tmp_path / "solids.csv", RECORDS)
    test, train = describe_manifest(tmp_path / "solids.csv")
    command = "grep ,test, solids.csv | cut -d, -f6 | sha256sum"
    printed = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert test == DataSplit("solids", "test", 2, 2, printed.split()[0])
    assert (train.split, train.shapes, train.categories) == ("train", 1, 1)


def test_the_checksum_changes_with_any_shape(tmp_path):
    changed = [*RECORDS[:1], ShapeRecord("b", "Mug", "test", 0, Path("b.ply"), "0" * 64), *RECORDS[2:]]
    for name, records in (("one", RECORDS), ("other", changed)):
        write_manifest(tmp_path / f"{name}.csv", records)
    one, other = (describe_manifest(tmp_path / f"{name}.csv") for name in ("one", "other"))
    assert one[0].sha256 != other[0].sha256
    assert one[1].sha256 == other[1].sha256
