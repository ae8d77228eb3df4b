"""What becomes of a shard when workers die, native code crashes, files are damaged or the disk is full."""

import importlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from faults_in_files import DAMAGE, mounted
from injection import environment, fault
from small_chain import READS, list_clouds, settings_of, skeletons, small_sections, write_clouds

from morphoskel.chain.status import read_status
from morphoskel.chain.task import Task
from morphoskel.checksums import intact
from morphoskel.datasets.manifest import read_manifest
from morphoskel.errors import StorageError
from morphoskel.stages import STAGES

pytestmark = pytest.mark.timeout(3600)  # on a busy machine a chain waits for its turn

SHAPES = {stage: f"shape{number}" for number, stage in enumerate(STAGES)}
"""The shape that is hit at each stage; one fault a shape, so that one run shows all stages."""

SUFFIX = {"occupancy": ".npz", "udf": ".npy", "dilation": ".npy"}
SUFFIXES = {".ply", *SUFFIX.values()}


@pytest.fixture(scope="module")
def clouds(tmp_path_factory):
    root = tmp_path_factory.mktemp("clouds")
    write_clouds(root, len(STAGES))
    return root


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory, clouds):
    folder = prepared(tmp_path_factory.mktemp("undisturbed"), clouds)
    assert job(folder).returncode == 0
    return folder


def prepared(folder, clouds):
    """Write what a job needs to know."""
    sections = small_sections(clouds)
    assert {record.id for record in list_clouds(folder, sections, 8)} == set(SHAPES.values())
    (folder / "sections.json").write_text(json.dumps(sections))
    return folder


def job(folder, *stages, faults=()):
    """Run stages, all if none is named, and return how the process ended."""
    command = [sys.executable, str(Path(__file__).with_name("chain_job.py")), str(folder), *(stages or STAGES)]
    return subprocess.run(command, env=environment(folder, list(faults)), capture_output=True, text=True)


def status(folder, stage):
    return {row.id: row for row in read_status(folder / stage / "0")}


@pytest.mark.faults
def test_a_worker_killed_at_any_stage_changes_nothing(undisturbed, tmp_path, clouds):
    """Each is killed when its file is half written; the next attempt must not take that for the whole."""
    folder = prepared(tmp_path, clouds)
    faults = [fault(f"chain.{stage}", "run", "kill", shape=shape, marker=folder / f"{stage}.happened")
              for stage, shape in SHAPES.items()]  # fmt: skip
    done = job(folder, faults=faults)
    assert done.returncode == 0, done.stderr
    assert len(list(folder.glob("*.happened"))) == len(STAGES)
    assert skeletons(folder) == skeletons(undisturbed)
    assert all(status(folder, stage)[shape].attempts == 2 for stage, shape in SHAPES.items())
    assert not list(folder.rglob("*.partial"))


@pytest.mark.faults
def test_a_native_crash_loses_one_shape_and_says_where(undisturbed, tmp_path, clouds):
    folder = prepared(tmp_path, clouds)
    done = job(folder, faults=[fault(f"chain.{stage}", "run", "segfault", shape=s) for stage, s in SHAPES.items()])
    assert done.returncode == 0, done.stderr
    assert skeletons(folder) == {}  # each shape crashed at one stage
    assert not [stage for stage, shape in SHAPES.items() if file_of(folder, stage, shape).exists()]
    for stage, shape in SHAPES.items():
        row = status(folder, "select_skeleton")[shape]
        assert (row.status, row.stage, row.log) == ("failed", stage, f"logs/{stage}/0.log")
        assert "SIGSEGV" in row.reason
        survivors = [other for other in STAGES[STAGES.index(stage) + 1 :]]
        assert all(status(folder, stage)[SHAPES[other]].status == "ok" for other in survivors)
    log = (folder / "job.log").read_text()
    assert log.count("crashed:\nFatal Python error: Segmentation fault") == len(STAGES)


def written_by(folder, stage):
    """Return what a stage wrote for each shape."""
    return {path.name: path.read_bytes() for path in (folder / stage / "0").iterdir() if path.suffix in SUFFIXES}


def file_of(folder, stage, shape):
    return folder / stage / "0" / f"{shape}{SUFFIX.get(stage, '.ply')}"


@pytest.mark.parametrize("how", DAMAGE)
@pytest.mark.parametrize(("reader", "stage"), [(reader, stage) for reader in READS for stage in READS[reader]])
def test_every_stage_refuses_a_damaged_file(undisturbed, tmp_path, reader, stage, how):
    shutil.copytree(undisturbed / stage / "0", tmp_path / stage / "0")
    damaged = file_of(tmp_path, stage, "shape3")
    DAMAGE[how](damaged)
    [record] = [row for row in read_manifest(undisturbed / "manifest.csv") if row.id == "shape3"]
    inputs = {name: (tmp_path if name == stage else undisturbed) / name / "0" for name in READS[reader]}
    settings = settings_of(reader, json.loads((undisturbed / "sections.json").read_text()))
    run = importlib.import_module(f"morphoskel.chain.{reader}").run
    with pytest.raises(StorageError, match=f"{re.escape(str(damaged))}: is damaged .* remove {damaged.parent} and run"):
        run(Task(record, inputs, tmp_path, settings, 1))


@pytest.mark.parametrize("name", ["status.csv", "SHA256SUMS"])
@pytest.mark.parametrize("how", DAMAGE)
def test_a_damaged_record_of_a_shard_is_refused(undisturbed, tmp_path, name, how):
    folder = tmp_path / "0"
    shutil.copytree(undisturbed / "reconstruct" / "0", folder)
    DAMAGE[how](folder / name)
    with pytest.raises(StorageError, match=f"{re.escape(str(folder))}.* run again"):
        _ = [intact(folder / f"{row.id}.ply") for row in read_status(folder)]


@pytest.mark.faults
@pytest.mark.parametrize(("reader", "stage"), [("occupancy", "watertight"), ("dilation", "udf")])
def test_a_job_that_meets_a_damaged_file_fails_until_that_is_made_again(undisturbed, tmp_path, reader, stage):
    folder = tmp_path / "run"
    shutil.copytree(undisturbed, folder)
    damaged = file_of(folder, stage, "shape3")
    DAMAGE["flip"](damaged)
    shutil.rmtree(folder / reader)
    done = job(folder, reader)
    assert done.returncode != 0
    for said in (f"shape3 at {reader}: {damaged}: is damaged", f"remove {damaged.parent} and run again"):
        assert said in done.stderr
    assert not list((folder / reader).iterdir())
    shutil.rmtree(damaged.parent)
    assert job(folder, stage, reader).returncode == 0
    assert written_by(folder, reader) == written_by(undisturbed, reader)


@pytest.mark.faults
@pytest.mark.skipif(os.geteuid() != 0, reason="only root can mount a small disk to fill it")
@pytest.mark.parametrize("stage", STAGES)
def test_a_full_disk_fails_the_job_and_no_shape(undisturbed, tmp_path, stage):
    """A shape that cannot be written for want of space must not be recorded as one that has no skeleton."""
    folder = tmp_path / "run"
    shutil.copytree(undisturbed, folder)
    shutil.rmtree(folder / stage)
    with mounted(folder / stage, "12k"):
        done = job(folder, stage)
        left = list((folder / stage).iterdir())
    assert done.returncode != 0
    assert left == []
    assert f"at {stage}: a file in {folder / stage / '0'}.partial cannot be written" in done.stderr
    assert "has space left, then run again" in done.stderr
    assert job(folder, stage).returncode == 0
    assert written_by(folder, stage) == written_by(undisturbed, stage)


@pytest.mark.faults
@pytest.mark.parametrize("how", ["folder", "dangling", "cut"])
def test_an_unreadable_input_loses_one_shape_by_name(undisturbed, tmp_path, clouds, how):
    root = tmp_path / "clouds"
    shutil.copytree(clouds, root)
    folder = tmp_path / "run"
    folder.mkdir()
    prepared(folder, root)
    cloud = root / "shape2.ply"
    content = cloud.read_bytes()
    cloud.unlink()
    if how == "folder":
        cloud.mkdir()
    elif how == "dangling":
        cloud.symlink_to(tmp_path / "nowhere")
    else:
        cloud.write_bytes(content[:-100])
    assert job(folder, "reconstruct").returncode == 0
    rows = status(folder, "reconstruct")
    [failed] = [row for row in rows.values() if row.status == "failed"]
    assert failed.id == "shape2"
    assert str(cloud) in failed.reason
    assert len(list((folder / "reconstruct" / "0").glob("*.ply"))) == len(STAGES) - 1
